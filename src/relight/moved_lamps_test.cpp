// SPDX-License-Identifier: Apache-2.0
// Direct light of moved lamps against closed forms; numbers refer to the analytic tests in docs/methods.md.
#include "relight/moved_lamps.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "light/test_rig.h"
#include "scene/lens.h"
#include "scene/objects.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

constexpr float kLuminance = 10;  // cd/m2

/// A square lamp, 1 m wide, 1 m above the origin, and a bulb beside it.
Scene lamp_scene() {
  Scene scene;
  add_quad(scene, "lamp", add_material(scene, "glow", Rgb(0), Rgb(kLuminance)), Vec3(-0.5f, 1, -0.5f),
           Vec3(1, 0, 0), Vec3(0, 0, 1));
  Light bulb;
  bulb.name = "bulb";
  bulb.intensity = Rgb(4);
  bulb.frame[3] = glm::vec4(3, 2, 0, 1);
  scene.lights.push_back(bulb);
  return scene;
}

struct Room : LampRig {
  Tracer tracer;
  explicit Room(Scene s) : LampRig(std::move(s)), tracer(scene, world) {}

  Id<LightGroup> group(const std::string& name) const {
    for (std::size_t g = 0; g < scene.groups.size(); ++g)
      if (scene.groups[g].name == name) return Id<LightGroup>(g);
    return {};
  }
  MovedLamps moved(const std::string& name, std::span<const LampMove> moves = {}) const {
    const MovedGroup all{group(name), Rgb(1)};
    return MovedLamps(scene, world, tracer, {}, {&all, 1}, moves);
  }
};

SurfacePoint facing_up(const Vec3& at) {
  return {at, Vec3(0, 1, 0), Vec3(0, 1, 0)};
}

struct Spread {
  double mean = 0, deviation = 0, most = 0;
};
Spread sampled(const MovedLamps& lamps, const Vec3& at, uint32_t count) {
  Spread s;
  double squares = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const auto e = static_cast<double>(lamps.illuminance(facing_up(at), 7, i).g);
    s.mean += e / count, squares += e * e / count;
    s.most = std::max(s.most, e);
  }
  s.deviation = std::sqrt(std::max(0.0, squares - s.mean * s.mean));
  return s;
}

/// 10. On the axis of a rectangle.
double on_axis(double distance) {
  const double a = 0.5 / distance, root = std::sqrt(1 + a * a);
  return 4 * double{kLuminance} / 2 * 2 * (a / root) * std::atan(a / root);
}

// Close to a lamp area samples alone are noisy without bound; weighted with rays by the surface's cosine no
// estimate exceeds twice a hemisphere of the lamp.
TEST(MovedLamps, CloseToALampIsNotNoisy) {
  const Room room(lamp_scene());
  const MovedLamps lamps = room.moved("lamp");
  for (const float distance : {1.0f, 0.3f, 0.05f}) {
    const Spread s = sampled(lamps, Vec3(0, 1 - distance, 0), 4096);
    EXPECT_NEAR(s.mean, on_axis(double{distance}), 0.01 * on_axis(double{distance})) << distance;
    EXPECT_LE(s.most, 2 * kPiD * double{kLuminance} * (1 + 1e-4)) << distance;
    EXPECT_LT(s.deviation, 0.6 * s.mean) << distance;
  }
}

// 12. A bulb that is moved keeps its intensity: E = I / d2.
TEST(MovedLamps, AMovedBulbShinesFromItsNewPlace) {
  const Room room(lamp_scene());
  const LampMove move = find_move(room.scene, room.lamps, "bulb", {Vec3(3, 0.5f, 0)}, "--move");
  ASSERT_EQ(move.groups.size(), 1u);
  EXPECT_NEAR(sampled(room.moved("bulb"), Vec3(3, 0, 0), 1).mean, 4 / 4.0, 1e-5);
  EXPECT_NEAR(sampled(room.moved("bulb", {&move, 1}), Vec3(3, 0, 0), 1).mean, 4 / 0.25, 1e-4);
}

// A lamp that is a mesh takes its shape along; rays meet it no more, yet the mean is the same.
TEST(MovedLamps, AMovedMeshShinesFromItsNewPlace) {
  const Room room(lamp_scene());
  const LampMove move = find_move(room.scene, room.lamps, "lamp", {Vec3(10, 1, 0)}, "--move");
  const MovedLamps lamps = room.moved("lamp", {&move, 1});
  EXPECT_NEAR(sampled(lamps, Vec3(10, 0, 0), 4096).mean, on_axis(1), 0.01 * on_axis(1));
  EXPECT_LT(sampled(lamps, Vec3(0, 0, 0), 256).mean, 0.02);
}

// 10. Turned to its target a flat lamp shines there as on its axis; what shines all around has none.
TEST(MovedLamps, ALampIsTurnedToItsTarget) {
  const Room room(lamp_scene());
  const LampMove move =
      find_move(room.scene, room.lamps, "lamp", {Vec3(9, 0.5f, 0), Vec3(10, 0.5f, 0)}, "--move");
  const MovedLamps lamps = room.moved("lamp", {&move, 1});
  const SurfacePoint wall{Vec3(10, 0.5f, 0), Vec3(-1, 0, 0), Vec3(-1, 0, 0)};
  double mean = 0;
  for (uint32_t i = 0; i < 4096; ++i) mean += static_cast<double>(lamps.illuminance(wall, 7, i).g) / 4096;
  EXPECT_NEAR(mean, on_axis(1), 0.01 * on_axis(1));
  EXPECT_THROW(find_move(room.scene, room.lamps, "bulb", {Vec3(0), Vec3(0, 1, 0)}, "--move"), UsageError);
  EXPECT_THROW(find_move(room.scene, room.lamps, "lamp", {Vec3(0), Vec3(0)}, "--move"), UsageError);
}

// Of a group of which some lamps move its layer stays, and only they come by transfer.
TEST(MovedLamps, OneOfAGroupLeavesTheOthersInTheirLayer) {
  Scene scene = lamp_scene();
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].name = "other bulb";
  for (Light& light : scene.lights) light.group_name = "bulbs";
  const Room room(scene);
  const LampMove move = find_move(room.scene, room.lamps, "other bulb", {Vec3(3, 1, 0)}, "--move");
  const auto taken = [&](bool whole, double* weight) {
    MixSpec lightmap{std::vector<Rgb>(room.scene.groups.size(), Rgb(0.5f))};
    const std::vector<MovedGroup> out = take_lamps(room.lamps, {}, {&move, 1}, whole, lightmap);
    *weight = static_cast<double>(lightmap.weights[room.group("bulbs").value].g);
    return out;
  };
  double weight = 0;
  const std::vector<MovedGroup> part = taken(false, &weight);
  EXPECT_EQ(weight, 0.5);
  EXPECT_EQ(in_part(part).size(), 1u);
  const MovedLamps one(room.scene, room.world, room.tracer, {}, part, {&move, 1});
  EXPECT_NEAR(sampled(one, Vec3(3, 0, 0), 1).mean, 0.5 * 4, 1e-5);
  const std::vector<MovedGroup> all = taken(true, &weight);
  EXPECT_EQ(weight, 0);
  EXPECT_TRUE(in_part(all).empty());
  const MovedLamps both(room.scene, room.world, room.tracer, {}, all, {&move, 1});
  EXPECT_NEAR(sampled(both, Vec3(3, 0, 0), 1).mean, 0.5 * (4 + 4 / 4.0), 1e-5);
}

// Rays that meet the box of a shade tell all that differs between a world with it and one without.
TEST(MovedLamps, LightThroughABoxIsWhatDiffersWithinIt) {
  Scene shaded = lamp_scene();
  const auto black = add_material(shaded, "black", Rgb(0));
  add_quad(shaded, "shade", black, Vec3(2.8f, 1, -0.2f), Vec3(0, 0, 0.4f), Vec3(0.4f, 0, 0));
  const Room open(lamp_scene()), dark(shaded);
  const Bounds box = object_bounds(dark.scene, dark.world, "shade");
  const auto all = [](const Room& room) {
    std::vector<MovedGroup> groups;
    for (std::size_t g = 0; g < room.scene.groups.size(); ++g) groups.push_back({Id<LightGroup>(g), Rgb(1)});
    return groups;
  };
  const std::vector<MovedGroup> groups = all(open);
  const MovedLamps without(open.scene, open.world, open.tracer, {}, groups),
      with(dark.scene, dark.world, dark.tracer, {}, groups);
  // 12. Below the shade the bulb's I / d2 is missing, and all of it comes through the box.
  std::vector<Rgb> lost(open.scene.groups.size());
  without.add_light_through({&box, 1}, facing_up(Vec3(3, 0, 0)), 7, 0, lost);
  EXPECT_NEAR(lost[open.group("bulb").value].g, 4 / 4.0f, 1e-5f);
  for (uint32_t i = 0; i < 256; ++i) {
    const SurfacePoint at = facing_up(Vec3(0.02f * static_cast<float>(i), 0, 0.1f));
    std::vector<Rgb> difference(groups.size()), taken(groups.size());
    without.add_light_through({&box, 1}, at, 7, i, difference);
    with.add_light_through({&box, 1}, at, 7, i, taken);
    Rgb sum;
    for (std::size_t g = 0; g < groups.size(); ++g) sum += difference[g] - taken[g];
    EXPECT_NEAR(sum.g, (without.illuminance(at, 7, i) - with.illuminance(at, 7, i)).g, 1e-5f) << i;
  }
}

TEST(MovedLamps, UnknownNamesAndSunsAreRefused) {
  Scene scene = lamp_scene();
  Light sun;
  sun.name = "noon";
  sun.shape = SunLight{};
  sun.intensity = Rgb(1);
  scene.lights.push_back(sun);
  const Room room(scene);
  EXPECT_THROW(find_move(room.scene, room.lamps, "bulbs", {Vec3(0)}, "--move"), UsageError);
  EXPECT_THROW(find_move(room.scene, room.lamps, "noon", {Vec3(0)}, "--move"), UsageError);
}

TEST(MovedLamps, LampsInsideThingsAreFound) {
  Scene scene = lamp_scene();
  add_box(scene, "crate", add_material(scene, "wood", Rgb(0.5f)), Vec3(2.5f, 1.5f, -0.5f),
          Vec3(3.5f, 2.5f, 0.5f), false);
  const Room room(scene);
  EXPECT_EQ(room.moved("bulb").buried(), std::vector<std::string>{"bulb"});
  const LampMove out = find_move(room.scene, room.lamps, "bulb", {Vec3(3, 4, 0)}, "--move");
  EXPECT_TRUE(room.moved("bulb", {&out, 1}).buried().empty());
  const LampMove in = find_move(room.scene, room.lamps, "lamp", {Vec3(3, 2, 0)}, "--move");
  EXPECT_EQ(room.moved("lamp", {&in, 1}).buried(), std::vector<std::string>{"lamp"});
  EXPECT_TRUE(room.moved("lamp").buried().empty());
}

/// Down with `candela` at every angle below the horizon.
Luminaire downlight(double candela) {
  Luminaire out;
  out.name = "downlight";
  out.photometry.azimuths = {0, 360};
  out.photometry.polars = {0, 90};
  out.photometry.candela = {candela, candela, candela, candela};
  return out;
}

/// Nadir along -z, so that it looks down.
Light hung(const Vec3& at) {
  Light light;
  light.frame = look_at(at, at - Vec3(0, 1, 0)).frame;
  light.intensity = Rgb(1);
  light.shape = LuminaireLight{Id<Luminaire>(0)};
  return light;
}

// Lamps that join bring their tables with them, whatever tables the scene has: E = I / d2. A sun is as
// strong everywhere.
TEST(MovedLamps, MeasuredLampsAndSunsJoin) {
  Scene scene = lamp_scene();
  scene.luminaires = {downlight(5)};
  scene.lights.push_back(hung(Vec3(6, 1, 0)));
  const Room room(std::move(scene));
  MoreLights more{{hung(Vec3(8, 1.5f, 0))}, {downlight(90)}};
  Light sun;
  sun.frame = look_at(Vec3(0), Vec3(0, -1, 0)).frame;
  sun.intensity = Rgb(7);
  sun.shape = SunLight{};
  append(more, MoreLights{{hung(Vec3(8, 2, 0))}, {downlight(400)}});
  const MovedLamps measured(room.scene, room.world, room.tracer, more, {});
  EXPECT_NEAR(measured.illuminance(facing_up(Vec3(8, 0, 0)), 0, 0).g, 90 / 2.25f + 400 / 4.0f, 1e-3f);
  const MovedLamps noon(room.scene, room.world, room.tracer, {{sun}}, {});
  EXPECT_NEAR(noon.illuminance(facing_up(Vec3(5, 0, 0)), 0, 0).g, 7, 1e-5f);
  EXPECT_EQ(noon.illuminance(facing_up(Vec3(0, 0, 0)), 0, 0).g, 0) << "below the lamp";
}

// Each lamp has a name of its own; what shines from everywhere has none.
TEST(MovedLamps, NamesAreUnique) {
  Scene scene = lamp_scene();
  Light other = scene.lights[0];
  other.frame[3].x = 5;
  Light noon;
  noon.name = "noon", noon.shape = SunLight{}, noon.intensity = Rgb(1);
  scene.lights.push_back(noon);
  scene.lights.push_back(other);
  const Room room(std::move(scene));
  EXPECT_EQ(lamp_names(room.lamps), (std::vector<std::string>{"bulb#1", "", "bulb#2", "lamp"}));
  EXPECT_EQ(find_lamps(room.scene, room.lamps, "bulb", "").lamps, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(find_lamps(room.scene, room.lamps, "bulb#2", "").lamps, std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace sconce
