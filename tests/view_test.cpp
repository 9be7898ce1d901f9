// SPDX-License-Identifier: Apache-2.0
// The window, driven by scripts on a display of its own; its pictures against the CPU's.
#include <thread>

#include "bumpy_room.h"
#include "core/files.h"
#include "image/io.h"
#include "mix/preset.h"
#include "view_window.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

TEST_F(ViewTest, PicturesAreTheCpusWhateverTheFaders) {
  bake();
  const auto outcome =
      view("set window=0.3 mirror=4000K,+1ev shower=off\nev100 8\ncamera tub\nsettle\npicture " +
           path("window.png") + "\nlook lux\nscale 0 500\nlines on\nsettle\npicture " + path("lux.png") +
           "\nscreenshot " + path("all.png") + "\nscene " + path("relit.glb") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto exported = test::run_sconce({"export", path("x.sconce"), "window=0.3", "mirror=4000K,+1ev",
                                          "shower=off", "--scene", path("again.glb"), "--quiet"});
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_EQ(read_file(path("relit.glb")), read_file(path("again.glb")));
  const Image8 shown = png("window.png");
  const auto rendered = test::run_sconce(
      {"render", path("x.sconce"), "window=0.3", "mirror=4000K,+1ev", "shower=off", "--ev100", "8",
       "--camera", "tub", "--device", "cpu", "--size",
       std::to_string(shown.width) + "x" + std::to_string(shown.height), "-o", path("cpu.png")});
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_LE(mean_difference(shown, png("cpu.png")), 2);
  EXPECT_GT(mean_difference(shown, png("lux.png")), 20);
  EXPECT_EQ(png("all.png").width, 900);
}

// OpenGL draws the mirror as if matt; at rest rays show in it what `render` does, and it follows the faders.
TEST_F(ViewTest, MirrorsAreFollowedAtRest) {
  Scene room = test::two_lamp_room();
  Material& mirror = room.materials.emplace_back(room.materials[0]);
  mirror.name = "mirror", mirror.base_color = Rgb(0.9f), mirror.metallic = 1, mirror.roughness = 0;
  room.meshes[room.instances[2].mesh.value].material =
      Id<Material>(static_cast<uint32_t>(room.materials.size() - 1));
  folder_.write("x.glb", write_glb(room, "test"));
  const auto baked = test::run_sconce(
      {"bake", path("x.glb"), "-o", path("x.sconce"), "--atlas", "128", "--samples", "8", "--quiet"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  const std::string script = "ev100 2\nsettle\npicture " + path("on.png") + "\npicture " + path("on.exr") +
                             "\ntimes " + path("before.csv") + "\nset left=off\nsettle\npicture " +
                             path("left-off.png") + "\ntimes " + path("moved.csv") + "\n";
  ASSERT_EQ(view(script).code, 0);
  const Image8 on = png("on.png"), off = png("left-off.png");
  ASSERT_EQ(
      view("ev100 2\nsettle\npicture " + path("none.png") + "\n", "x.sconce", {"--no-reflections"}).code, 0);
  const auto render = [&](const char* name, std::vector<std::string> arguments) {
    for (const std::string& a :
         {std::string("--device"), std::string("cpu"), std::string("--size"),
          std::to_string(on.width) + "x" + std::to_string(on.height), std::string("-o"), path(name)})
      arguments.push_back(a);
    arguments.insert(arguments.begin(), {"render", path("x.sconce")});
    const auto outcome = test::run_sconce(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  const auto rendered = [&](const char* option = "--quiet") {
    render("cpu.png", {"--ev100", "2", option});
    return png("cpu.png");
  };
  EXPECT_LE(mean_difference(on, rendered()), 1);
  EXPECT_LE(mean_difference(off, rendered("left=off")), 1);
  const Image8 without = rendered("--no-reflections");
  render("cpu.exr", {});
  const auto mean = [&](const char* name) {
    double sum = 0;
    const Image image = read_exr(path(name));
    EXPECT_EQ(image.width, on.width);
    for (const float v : image.data) sum += static_cast<double>(v);
    return sum;
  };
  EXPECT_NEAR(mean("on.exr") / mean("cpu.exr"), 1, 0.01);
  const std::string times = read_file(path("moved.csv"));
  EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), 2) << times;  // one frame in which a fader moved
  EXPECT_LE(mean_difference(png("none.png"), without), 2);
  EXPECT_GT(mean_difference(on, without), 10);
}

// Where the light knows directions, also while a lamp is elsewhere: then under the groups that stay.
TEST_F(ViewTest, NormalMapsAreSeen) {
  Scene scene = test::bumpy_room();
  bake_movable(scene, {"--basis", "sh1"});
  const auto outcome = view("ev100 3\nset left=0.5\nsettle\npicture " + path("bumpy.png") +
                            "\nlamp \"lamp left\" 0,1.4,0\nsettle\npicture " + path("moved.png") +
                            "\nlook lightmap\nsettle\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image8 bumpy = png("bumpy.png"), moved = png("moved.png");
  const auto picture = [&](std::vector<std::string> words) {
    words.insert(words.begin() + 1, path("x.sconce"));
    for (const std::string& word :
         {std::string("left=0.5"), std::string("--ev100"), std::string("3"), std::string("--no-reflections"),
          std::string("--size"), std::to_string(bumpy.width) + "x" + std::to_string(bumpy.height),
          std::string("-o"), path("cpu.png")})
      words.push_back(word);
    const auto made = test::run_sconce(words);
    EXPECT_EQ(made.code, 0) << made.err;
    return png("cpu.png");
  };
  EXPECT_LE(mean_difference(bumpy, picture({"render", "--device", "cpu"})), 1);
  const Image8 relit = picture({"relight", "--move", "lamp left=0,1.4,0", "--device", "cpu"});
  EXPECT_LE(mean_difference(moved, relit), 3);
  std::filesystem::remove_all(path("x.sconce"));
  bake_movable(scene);
  EXPECT_GT(mean_difference(bumpy, picture({"render", "--device", "cpu"})), 1.5) << "the maps should be seen";
}

TEST_F(ViewTest, HandsMoveFadersAndKeysTakeThemBack) {
  bake();
  const auto outcome = view("settle\npull ceiling -60\nframes 3\nsave " + path("pulled.toml") +
                            "\nkey ctrl+z\nframes 3\nsave " + path("undone.toml") + "\nsolo tub\n");
  EXPECT_EQ(outcome.code, 2);  // the room has a group `shower`, and a camera `tub`
  EXPECT_NE(outcome.err.find("unknown light group 'tub'"), std::string::npos) << outcome.err;
  const auto setting = [&](const std::string& file) { return read_preset(path(file)).assignments.front(); };
  EXPECT_EQ(setting("undone.toml"), "ceiling=on");
  ASSERT_TRUE(setting("pulled.toml").starts_with("ceiling=0.")) << setting("pulled.toml");
}

// A lamp that was dragged shines as `relight --move` says, and undo takes it back.
TEST_F(ViewTest, LampsAreDraggedAndTheirLightFollows) {
  bake_movable();
  const auto outcome =
      view("ev100 3\nsettle\npicture " + path("home.png") + "\nlamp \"lamp left\" 0,1.4,0\nsettle\npicture " +
           path("there.png") + "\ntug y 0,60\nsettle\npicture " + path("tugged.png") + "\nmoves " +
           path("moves.txt") + "\nscreenshot " + path("all.png") + "\nkey ctrl+z\nsettle\npicture " +
           path("undone.png") + "\nhome\nsettle\npicture " + path("back.png") + "\ngrab lamp\n");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("no lamp or group 'lamp'"), std::string::npos) << outcome.err;
  const Image8 there = png("there.png");
  const auto relit = [&](const std::string& move, const std::string& output) {
    const auto made = test::run_sconce(
        {"relight", path("x.sconce"), "--move", move, "--ev100", "3", "--device", "cpu", "--size",
         std::to_string(there.width) + "x" + std::to_string(there.height), "-o", path(output)});
    EXPECT_EQ(made.code, 0) << made.err;
    return png(output);
  };
  EXPECT_LE(mean_difference(there, relit("lamp left=0,1.4,0", "relit.png")), 2);
  EXPECT_GT(mean_difference(there, png("home.png")), 4);
  // Down along the green arrow alone.
  const std::string moves = read_file(path("moves.txt"));
  float x = 1, y = 2, z = 1;
  ASSERT_EQ(std::sscanf(moves.c_str(), "lamp left=%f,%f,%f", &x, &y, &z), 3) << moves;
  EXPECT_NEAR(x, 0, 1e-3);
  EXPECT_NEAR(z, 0, 1e-3);
  EXPECT_LT(y, 1.35f);
  EXPECT_LE(mean_difference(png("tugged.png"), relit(moves.substr(0, moves.size() - 1), "relit.png")), 2);
  EXPECT_LE(mean_difference(png("undone.png"), there), 0.01);
  EXPECT_LE(mean_difference(png("back.png"), png("home.png")), 0.01);

  std::filesystem::remove_all(path("x.sconce") + "/operators");
  const auto none = view("settle\ngrab left\n");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("bake --movable"), std::string::npos) << none.err;
}

// A lamp becomes a spot, and a shader that is edited meanwhile: `relight` says how it must look. A typo is
// told, and the last good one goes on.
TEST_F(ViewTest, LampsBecomeOthersAndShadersAreReadAgain) {
  bake_movable();
  const std::string example = read_file(fs::path(SCONCE_SOURCE_DIR) / "examples/lights/point.glsl");
  folder_.write("lamp.glsl", example);
  const std::string kind = "kind \"lamp left\" ", at = "lamp \"lamp left\" 0,1.4,0.2\n";
  std::thread editor = after("point.png", [&] {
    folder_.write("lamp.glsl", "vec3 light(vec3 P, vec3 N) { return vec3(50.0) * max(N.y, 0.0); }\n");
  });
  std::thread careless = after(
      "up.png", [&] { folder_.write("lamp.glsl", "vec3 light(vec3 P, vec3 N) { return vec2(1.0); }\n"); });
  const auto outcome = view(
      "ev100 3\nset right=off\nsettle\n" + at + kind +
      "spot,outer=40,intensity=60,kelvin=3000,target=0,0,0.2\nsettle\npicture " + path("spot.png") + "\n" +
      kind + "shader,file=" + path("lamp.glsl") + ",intensity=60,kelvin=3000,shadow=none\nsettle\npicture " +
      path("point.png") + "\nwait 3\nsettle\npicture " + path("up.png") + "\nwait 3\nsettle\npicture " +
      path("kept.png") + "\nmoves " + path("moves.txt") + "\nscreenshot " + path("all.png") + "\n" + kind +
      "own\nsettle\nmoves " + path("own.txt") + "\n" + kind + "spto\n");
  editor.join(), careless.join();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("spto"), std::string::npos) << outcome.err;
  const Image8 spot = png("spot.png");
  folder_.write("lamp.glsl", example);
  const auto expect_relit = [&](const Image8& picture, const std::string& lamp, const char* device) {
    const auto relit = test::run_sconce(
        {"relight", path("x.sconce"), "--others", "off", "--light", lamp + ",kelvin=3000,position=0,1.39,0.2",
         "--ev100", "3", "--device", device, "--size",
         std::to_string(spot.width) + "x" + std::to_string(spot.height), "-o", path("relit.png")});
    ASSERT_EQ(relit.code, 0) << relit.err;
    EXPECT_LE(mean_difference(picture, png("relit.png")), 2) << lamp;
  };
  expect_relit(spot, "spot,outer=40,intensity=60,target=0,0,0.2", "cpu");
  expect_relit(png("point.png"), "shader,intensity=60,shadow=none,file=" + path("lamp.glsl"), "gl");
  EXPECT_GT(mean_difference(spot, png("point.png")), 4);
  EXPECT_GT(mean_difference(png("up.png"), png("point.png")), 4);
  EXPECT_EQ(png("kept.png").data, png("up.png").data);
  const std::string moves = read_file(path("moves.txt"));
  EXPECT_NE(moves.find("lamp.glsl:1: "), std::string::npos) << moves;
  EXPECT_EQ(read_file(path("own.txt")).find('#'), std::string::npos);
}

// Kinds of lamps by words and by a dropped photometric file, a lamp that is turned, and all that kept by a
// preset; `relight` says how each must look.
TEST_F(ViewTest, LampsBecomeMeasuredOnesAndSuns) {
  bake_movable(test::two_lamp_court());
  folder_.write("lamp.ies", test::kPhotometricLamp);
  const std::string sun = "sun,direction=0.2,-1,-0.1,intensity=90,kelvin=5500", lamp = " \"lamp left\" ";
  const auto picture = [&](const std::string& name) { return "\nsettle\npicture " + path(name) + "\n"; };
  const auto outcome =
      view("ev100 3\nset right=off left=50%\nsettle\nlamp" + lamp + "0,1.4,0.2\ndrop " + path("lamp.ies") +
           picture("measured.png") + "kind" + lamp + sun + picture("sun.png") + "kind" + lamp + "own\naim" +
           lamp + "0.9,0.9,0.2" + picture("aimed.png") + "save " + path("aimed.toml") +
           "\nhome\nsettle\ndrop " + path("aimed.toml") + "\nwait 1.2" + picture("again.png"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(mean_difference(png("again.png"), png("aimed.png")), 0.01) << "a preset keeps lamps";
  const auto run = [&](std::vector<std::string> words, const std::string& to, const std::string& size) {
    for (const char* word : {"--device", "cpu", "--size"}) words.emplace_back(word);
    words.push_back(size), words.push_back("-o"), words.push_back(path(to));
    words.insert(words.begin() + 1, path("x.sconce"));
    const auto done = test::run_sconce(words);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.err;
  };
  const std::string place = "lamp left=0,1.4,0.2";
  const Image8 seen = png("sun.png");
  const std::string size = std::to_string(seen.width) + "x" + std::to_string(seen.height);
  for (const auto& [name, kind] : {std::pair<std::string, std::string>{"sun.png", sun},
                                   {"measured.png", "luminaire,file=" + path("lamp.ies")}}) {
    run({"relight", "right=off", "left=50%", "--move", place, "--kind", "lamp left=" + kind, "--ev100", "3"},
        "relit.png", size);
    EXPECT_LE(mean_difference(png(name), png("relit.png")), 2) << kind;
  }
  EXPECT_GT(mean_difference(png("measured.png"), seen), 4);
  run({"relight", "right=off", "left=50%", "--move", place + ",target=0.9,0.9,0.2", "--ev100", "3"},
      "words.exr", "40x30");
  run({"relight", "--preset", path("aimed.toml")}, "preset.exr", "40x30");
  EXPECT_EQ(read_exr(path("preset.exr")).data, read_exr(path("words.exr")).data);
  EXPECT_NE(
      run({"render", "--preset", path("aimed.toml")}, "r.png", "8x6").find("stay where they were baked"),
      std::string::npos);
}

TEST_F(ViewTest, PresetsFadeAndFilesDrop) {
  bake();
  folder_.write("mood.toml", "others = \"off\"\n[mix]\nmirror = \"2700K\"\n");
  const auto outcome = view("settle\nkeep a\ndrop " + path("mood.toml") + "\nwait 1.2\nsettle\nsave " +
                            path("now.toml") + "\nrecall a 0.2\nsettle\nsave " + path("before.toml") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_preset(path("now.toml")).assignments,
            (std::vector<std::string>{"ceiling=off", "mirror=on,2700K", "shower=off", "window=off"}));
  EXPECT_EQ(read_preset(path("before.toml")).assignments[3], "window=on");
}

TEST_F(ViewTest, AMoodIsNamedByHandAndSaved) {
  write_package(folder_ / "x.sconce", test_package(2, 1, 8, 8));
  const auto outcome =
      view("settle\nset a=off\nclick 640,133\ntype \"late dusk\"\nframes 2\nclick 844,133\nframes 3\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_preset(path("x-late dusk.toml")).assignments[0], "a=off");
}

// What cannot be opened takes nobody's name: Ctrl-S still writes beside the package, by its name.
TEST_F(ViewTest, WhatCannotBeOpenedTakesNoNames) {
  write_package(folder_ / "x.sconce", test_package(1, 1, 8, 8));
  fs::create_directory(path("other"));
  folder_.write("other/notes.md", "no scene\n");
  const auto outcome =
      view("settle\ndrop " + path("other/notes.md") + "\nsettle\nframes 3\nkey ctrl+s\nframes 3\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::size_t presets = 0;
  for (const auto& entry : fs::directory_iterator(path("")))
    presets += entry.path().filename().string().starts_with("x-") && entry.path().extension() == ".toml";
  EXPECT_EQ(presets, 1u);
}

// The pictures of `render --turntable`, and the camera is where it was.
TEST_F(ViewTest, Turntable) {
  bake();
  const auto outcome =
      view("ev100 8\nsettle\npicture " + path("before.png") + "\nturntable " + path("turn%d.png") +
           " 3\nsettle\npicture " + path("after.png") + "\nturntable " + path("turn.png") + " 4\n");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("has no place for the frame's number"), std::string::npos) << outcome.err;
  const Image8 before = png("before.png");
  EXPECT_EQ(png("turn1.png").data, before.data);
  EXPECT_EQ(png("after.png").data, before.data);
  const auto rendered = test::run_sconce(
      {"render", path("x.sconce"), "--ev100", "8", "--turntable", "3", "--device", "cpu", "--size",
       std::to_string(before.width) + "x" + std::to_string(before.height), "-o", path("cpu%d.png")});
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  for (const char* number : {"2", "3"})
    EXPECT_LE(mean_difference(png(std::string("turn") + number + ".png"),
                              png(std::string("cpu") + number + ".png")),
              2)
        << number;
  EXPECT_FALSE(fs::exists(path("turn4.png")));
}

TEST_F(ViewTest, OtherRenderersPicturesHaveTheSameFaders) {
  Image layers(96, 64, {"R", "G", "B", "A", "key.R", "key.G", "key.B", "fill.R", "fill.G", "fill.B"});
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      const float key = 200 * static_cast<float>(x) / 96, fill = 50 * static_cast<float>(y) / 64;
      const float values[] = {key + fill + 5, key + fill + 5, key + 2 * fill + 5, 1, key, key, key, fill,
                              fill,           2 * fill};
      std::copy(std::begin(values), std::end(values), layers.at(x, y));
    }
  write_exr(folder_ / "render.exr", layers, PixelType::full);
  const auto outcome =
      view("set key=0.25 fill=2,2700K rest=off\nev100 6\nsettle\npicture " + path("window.png") + "\n",
           "render.exr");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> mix{"mix", path("render.exr"), "key=0.25", "fill=2,2700K", "rest=off"};
  const auto mixed = [&](std::vector<std::string> more) {
    std::vector<std::string> all = mix;
    all.insert(all.end(), more.begin(), more.end());
    const auto done = test::run_sconce(all);
    ASSERT_EQ(done.code, 0) << done.err;
  };
  mixed({"--ev100", "6", "-o", path("cpu.png")});
  EXPECT_LE(mean_difference(png("window.png"), png("cpu.png")), 0.1);

  // The faders that made a picture are found in it again.
  mixed({"-o", path("mixed.exr")});
  const auto sought = view("set key=1 fill=1,2700K rest=1\nlike " + path("mixed.exr") +
                               "\nwait 1.2\nsettle\nsave " + path("found.toml") +
                               "\nlook cd/m2\nsettle\nmove 400,300\nscreenshot " + path("all.png") + "\n",
                           "render.exr");
  ASSERT_EQ(sought.code, 0) << sought.err;
  EXPECT_EQ(read_preset(path("found.toml")).assignments,
            (std::vector<std::string>{"fill=2,2700K", "key=0.25", "rest=off"}));

  const auto surface = view("wish 0,0,0 300\n", "render.exr");
  EXPECT_EQ(surface.code, 1);
  EXPECT_NE(surface.err.find("needs a package"), std::string::npos) << surface.err;
  write_exr(folder_ / "plain.exr", Image::rgb(4, 4), PixelType::full);
  const auto plain = view("settle\npicture " + path("p.png") + "\n", "plain.exr");
  EXPECT_EQ(plain.code, 1);
  EXPECT_NE(plain.err.find("light-group"), std::string::npos) << plain.err;
}

// What is in memory goes on, and is written as a scene; the damaged package, dropped, does not take its
// place.
TEST_F(ViewTest, PackagesMayBeDamagedWhileTheyAreOpen) {
  bake_movable();
  std::thread vandal = after("first.png", [&] {
    for (const auto& entry : fs::recursive_directory_iterator(path("x.sconce")))
      if (entry.is_regular_file()) fs::resize_file(entry.path(), 100);
  });
  const auto outcome = view("ev100 3\nsettle\npicture " + path("first.png") +
                            "\nwait 3\nset right=off\nlamp \"lamp left\" 0,1.4,0\nsettle\npicture " +
                            path("second.png") + "\nscene " + path("relit.glb") + "\ndrop " +
                            path("x.sconce") + "\nsettle\npicture " + path("third.png") + "\n");
  vandal.join();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GT(mean_difference(png("second.png"), png("first.png")), 4);
  EXPECT_LE(mean_difference(png("third.png"), png("second.png")), 0.01);
  EXPECT_EQ(read_glb(read_file(path("relit.glb")), "relit.glb").instances.size(),
            test::two_lamp_room().instances.size());
}

TEST_F(ViewTest, BadInputIsOneLine) {
  const auto no_display = test::run_sconce({"view"}, "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(no_display.code, 1);
  EXPECT_NE(no_display.err.find("xvfb-run"), std::string::npos) << no_display.err;
  write_package(folder_ / "x.sconce", test_package(1, 1, 8, 8));
  write_file(folder_ / "x.sconce/scene.glb", "damaged");
  const auto damaged = view("settle\npicture " + path("p.png") + "\n");
  EXPECT_EQ(damaged.code, 1);
  EXPECT_NE(damaged.err.find("scene.glb"), std::string::npos) << damaged.err;
  EXPECT_EQ(view("fly away\n").code, 2);
}

}  // namespace
}  // namespace sconce
