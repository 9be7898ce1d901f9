// SPDX-License-Identifier: Apache-2.0
#include "session/session.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/test_folder.h"
#include "scene/lens.h"
#include "session/motion.h"
#include "session/remembered.h"
#include "session/search.h"

namespace sconce {
namespace {

std::vector<GroupInfo> lamps(std::initializer_list<const char*> names) {
  std::vector<GroupInfo> groups;
  for (const char* name : names) groups.push_back({.name = name, .lumens = 1000});
  return groups;
}

TEST(Fader, TextAndBack) {
  const GroupInfo group = lamps({"a"})[0];
  for (const char* text : {"on", "off", "0.5", "2,2700K", "0.25,color:#ff8000", "on,#80ff40"})
    EXPECT_EQ(setting_text(with_setting({}, group, text)), text);
  EXPECT_EQ(setting_text(with_setting({}, group, "500lm")), "0.5");
  EXPECT_EQ(setting_text(with_setting({}, group, "+1ev"), 0.25), "0.5");
}

TEST(Fader, StopsEndInDarkness) {
  EXPECT_EQ(gain_of(kLowestStop), 0);
  EXPECT_EQ(gain_of(0), 1);
  EXPECT_EQ(stops_of(0), kLowestStop);
  EXPECT_NEAR(gain_of(stops_of(0.37)), 0.37, 1e-12);
}

TEST(Faders, SoloAndMuteHideWhatTheyShould) {
  const std::vector<GroupInfo> groups = lamps({"a", "b", "c"});
  Faders faders{.groups = std::vector<Fader>(3), .master = 0.5};
  faders.groups[1].solo = true, faders.groups[2].solo = faders.groups[2].mute = true;
  const MixSpec mix = make_mix(groups, faders);
  EXPECT_EQ(mix.weights, (std::vector{Rgb(0), Rgb(0.5f), Rgb(0)}));
  EXPECT_EQ(to_preset(groups, faders).assignments, (std::vector<std::string>{"a=0.5", "b=0.5", "c=0.5"}));
}

TEST(Faders, PresetsGiveTheSameMixAsTheCommandLine) {
  const std::vector<GroupInfo> groups = lamps({"ceiling", "lamp 1", "lamp 2", "window"});
  const Preset preset{.assignments = {"lamp*=0.25", "lamp 2=2,2700K"}, .others = "off"};
  EXPECT_EQ(make_mix(groups, to_faders(groups, preset)).weights,
            make_mix(groups, preset.assignments, preset.others, {}).weights);
  EXPECT_THROW(to_faders(groups, {.assignments = {"celing=1"}}), UsageError);
}

// A preset keeps where lamps are, where they point and what they became; one that names none leaves them.
TEST(Session, PresetsKeepLamps) {
  const std::vector<GroupInfo> groups = lamps({"a"});
  const std::vector<SceneLamp> bulbs{{"bulb#1", Vec3(1, 2, 3)}, {"", {}}, {"bulb#2", Vec3(4, 5, 6)}};
  Mood mood{.faders = {.groups = std::vector<Fader>(1)}};
  mood.moved[2] = {Vec3(7, 8, 9), Vec3(0, 0, 1), "spot"};
  const Preset preset = to_preset(groups, mood, "", bulbs);
  Mood other = mood;
  other.moved = {{0, {Vec3(9), {}, ""}}};
  EXPECT_EQ(to_mood(groups, preset, other, bulbs).moved, mood.moved) << "others go home";
  EXPECT_EQ(to_mood(groups, {}, other, bulbs).moved, other.moved);
  EXPECT_EQ(to_mood(groups, preset, other).moved, other.moved) << "nothing moves here";
  EXPECT_EQ(to_mood(groups, {.lamps = {{"bulb#1", {}, {}, "point"}}}, mood, bulbs).moved,
            (MovedPlaces{{0, {Vec3(1, 2, 3), {}, "point"}}}));
  EXPECT_THROW(to_mood(groups, {.lamps = {{"bulb"}}}, mood, bulbs), UsageError);
}

TEST(Session, OneDragIsOneStepOfUndo) {
  Session session(lamps({"a"}));
  for (double gain : {0.9, 0.8, 0.7}) {
    Mood mood = session.mood();
    mood.faders.groups[0].gain = gain;
    session.change(mood, "gain a");
  }
  EXPECT_EQ(session.mood().faders.groups[0].gain, 0.7);
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(session.mood().faders.groups[0].gain, 1);
  EXPECT_FALSE(session.undo());
  EXPECT_TRUE(session.redo());
  EXPECT_EQ(session.mood().faders.groups[0].gain, 0.7);
}

TEST(Session, CrossFadesAreSumsOfBothMoods) {
  Session session(lamps({"a"}));
  session.keep('a');
  session.perform({"set", {"a=off"}, "test"});
  EXPECT_TRUE(session.mix().weights[0].is_black());
  session.recall('a', 2);
  EXPECT_TRUE(session.mix().weights[0].is_black());
  EXPECT_TRUE(session.advance(0.5));
  EXPECT_FLOAT_EQ(session.mix().weights[0].g, 0.25f);
  session.advance(2);
  EXPECT_FALSE(session.advance(0.1));
  EXPECT_FLOAT_EQ(session.mix().weights[0].g, 1);
}

TEST(Session, HeldExposureIsWhatAutomaticWouldBe) {
  Session session(lamps({"a"}));
  session.meter_once({.log_mean = 12, .maximum = 100});
  EXPECT_NEAR(session.exposure({.log_mean = 1, .maximum = 1}).scale / auto_exposure(12, 100).scale, 1, 0.004);
}

TEST(Session, MoodsSurviveAPreset) {
  const TemporaryFolder folder;
  Session session(lamps({"a", "b"}));
  session.perform({"set", {"a=0.5,3000K", "b=off"}, "test"});
  session.perform({"ev100", {"7.5"}, "test"});
  session.perform({"tone", {"neutral"}, "test"});
  const Mood wanted = session.mood();
  session.perform({"save", {(folder / "p.toml").string()}, "test"});
  session.perform({"set", {"all=on"}, "test"});
  session.perform({"preset", {(folder / "p.toml").string()}, "test"});
  EXPECT_EQ(setting_text(session.mood().faders.groups[0]), "0.5,3000K");
  EXPECT_FALSE(session.mood().faders.groups[1].on);
  EXPECT_EQ(session.mood().ev100, wanted.ev100);
  EXPECT_EQ(session.mood().tone, "neutral");
  EXPECT_FALSE(session.perform({"screenshot", {"x.png"}, "test"}));
}

TEST(Script, WordsCommentsAndQuotes) {
  const auto actions = parse_script("# mood\nset \"lamp 1=0.5\" b=off # two\n\nframes 3\r\n", "s.txt");
  ASSERT_EQ(actions.size(), 2u);
  EXPECT_EQ(actions[0].arguments, (std::vector<std::string>{"lamp 1=0.5", "b=off"}));
  EXPECT_EQ(actions[1].where, "s.txt:4");
  const auto error = [](const char* text) -> std::string {
    try {
      parse_script(text, "s.txt");
    } catch (const UsageError& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_NE(error("set a=1\nslo a").find("s.txt:2: unknown word 'slo'; did you mean 'solo'?"),
            std::string::npos)
      << error("set a=1\nslo a");
  EXPECT_NE(error("solo").find("solo GROUP"), std::string::npos);
  EXPECT_NE(error("save \"a b").find("quote"), std::string::npos);
}

TEST(Search, FindsWordsAndMakesFolders) {
  const std::vector<std::string> few{"hall/left", "desk", "hall/right"};
  const auto folders = fader_folders(few, "");
  ASSERT_EQ(folders.size(), 2u);
  EXPECT_EQ(folders[0].name, "hall");
  EXPECT_EQ(folders[0].groups, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(fader_folders(few, "HALL rig").front().groups, std::vector<std::size_t>{2});
  EXPECT_TRUE(fader_folders(few, "zzz").empty());
  std::vector<std::string> many;
  for (int i = 0; i < 12; ++i) many.push_back("downlight " + std::to_string(i));
  many.push_back("window");
  EXPECT_EQ(fader_folders(many, "").front().name, "downlight");
  EXPECT_EQ(fader_folders(many, "").back().name, "");
}

TEST(Motion, OrbitsKeepDistanceAndPlace) {
  const Camera camera = look_at({3, 1, 2}, {0.5f, 0, 0});
  const Vec3 center(0, 0.5f, -1);
  const Camera moved = orbit(camera, center, {0.4f, -0.2f});
  const auto eye = [](const Camera& c) { return Vec3(c.frame[3]); };
  EXPECT_NEAR(glm::length(eye(moved) - center), glm::length(eye(camera) - center), 1e-4f);
  EXPECT_GT(glm::length(eye(moved) - eye(camera)), 0.5f);
  // No turn is no move, and the head is level.
  const Camera still = orbit(camera, center, {0, 0});
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(glm::length(still.frame[i] - camera.frame[i]), 0, 1e-4f);
  EXPECT_NEAR(moved.frame[0].y, 0, 1e-5f);
  EXPECT_NEAR(glm::length(eye(approach(camera, center, 0.5f)) - center),
              0.5f * glm::length(eye(camera) - center), 1e-4f);
  EXPECT_NEAR(glm::length(eye(fly(camera, {0, 2, 0})) - eye(camera) - Vec3(0, 2, 0)), 0, 1e-5f);
}

TEST(Remembered, IsKeptAndDamageIsNoHarm) {
  const TemporaryFolder folder;
  Remembered r;
  for (int i = 0; i < 12; ++i) r.opened("/x/" + std::to_string(i));
  r.opened("/x/5");
  keep(r, folder / "deep/view.json");
  const Remembered read = remember(folder / "deep/view.json");
  EXPECT_EQ(read.recent.size(), Remembered::kMostRecent);
  EXPECT_EQ(read.recent.front(), "/x/5");
  EXPECT_EQ(remember(folder.write("bad.json", "{\"width\": \"x\"")).width, Remembered{}.width);
}

}  // namespace
}  // namespace sconce
