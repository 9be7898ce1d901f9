// SPDX-License-Identifier: Apache-2.0
#include "scene/groups.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sconce {
namespace {

/// Instances of one mesh each; material "glow" shines, "wall" does not.
struct Lamps {
  Scene scene;

  Lamps() {
    scene.name = "lamps";
    Material wall, glow;
    wall.name = "wall";
    glow.name = "glow.004";
    glow.emission = Rgb(10);
    scene.materials = {wall, glow};
    for (std::size_t m = 0; m < 2; ++m) {
      Mesh mesh;
      mesh.material = Id<Material>(m);
      scene.meshes.push_back(mesh);
    }
  }
  Lamps& mesh(const std::string& name, const std::string& group = {}, const std::string& lamp = {},
              bool glows = true) {
    Instance i;
    i.name = name;
    i.mesh = Id<Mesh>(glows ? 1 : 0);
    i.group_name = group;
    i.light_name = lamp;
    scene.instances.push_back(i);
    return *this;
  }
  template <class Shape>
  Lamps& light(const std::string& name, Shape shape, const std::string& group = {}) {
    Light l;
    l.name = name;
    l.shape = shape;
    l.group_name = group;
    scene.lights.push_back(l);
    return *this;
  }
  std::vector<std::string> grouped(Grouping grouping) {
    assign_groups(scene, grouping);
    std::vector<std::string> out;
    for (const Instance& i : scene.instances) out.push_back(i.group ? scene[i.group].name : "");
    for (const Light& l : scene.lights) out.push_back(scene[l.group].name);
    return out;
  }
  std::vector<std::string> groups() const {
    std::vector<std::string> out;
    for (const LightGroup& g : scene.groups) out.push_back(g.name);
    return out;
  }
};

using Names = std::vector<std::string>;

TEST(Groups, AutomaticStripsCounters) {
  Lamps l;
  l.mesh("Lamp.001")
      .mesh("Lamp.002")
      .mesh("spot_2")
      .mesh("bulb12")
      .mesh("Neon 3")
      .mesh("a_1.002")
      .mesh("42")
      .mesh("");
  l.light("Lamp", PointLight{}).light("Sun", SunLight{}).light("env", SkyLight{});
  EXPECT_EQ(l.grouped(Grouping::automatic),
            (Names{"Lamp", "Lamp", "spot", "bulb", "Neon", "a", "42", "glow", "Lamp", "sun", "sky"}));
  EXPECT_EQ(l.groups(), (Names{"Lamp", "spot", "bulb", "Neon", "a", "42", "glow", "sun", "sky"}));
}

TEST(Groups, NamedKeepTheirNameAndDarkOnesHaveNone) {
  Lamps l;
  l.mesh("x", "ceiling 2")
      .mesh("floor", "ceiling 2", "", false)
      .mesh("group:left.001")
      .light("moon", SunLight{}, "night");
  EXPECT_EQ(l.grouped(Grouping::automatic), (Names{"ceiling 2", "", "left", "night"}));
  EXPECT_EQ(l.grouped(Grouping::named), (Names{"ceiling 2", "", "rest", "night"}));
}

TEST(Groups, PerLightNamesAreUnique) {
  Lamps l;
  l.mesh("group:down", "down", "spot a")
      .mesh("group:down", "down")
      .mesh("group:down", "down")
      .light("down", PointLight{});
  l.light("", SkyLight{}, "sky");
  EXPECT_EQ(l.grouped(Grouping::per_light), (Names{"spot a", "down", "down#2", "down#3", "sky"}));
  EXPECT_EQ(l.scene.groups.size(), 5u);
}

TEST(Groups, One) {
  Lamps l;
  l.mesh("a").mesh("b", "named").light("c", SkyLight{}, "sky");
  EXPECT_EQ(l.grouped(Grouping::one), (Names{"all-lights", "all-lights", "all-lights"}));
}

TEST(Groups, ReservedNames) {
  EXPECT_THROW(Lamps().mesh("a", "all").grouped(Grouping::automatic), Error);
  EXPECT_THROW(Lamps().mesh("a", "sky").grouped(Grouping::automatic), Error);
  EXPECT_THROW(Lamps().light("a", PointLight{}, "sun").grouped(Grouping::automatic), Error);
  EXPECT_NO_THROW(Lamps().light("a", SunLight{}, "sun").grouped(Grouping::automatic));
  EXPECT_NO_THROW(Lamps().mesh("a", "rest").grouped(Grouping::named));
  Lamps own;  // names of our own making step aside
  own.mesh("sun").mesh("all.001").mesh("rest").light("", SunLight{});
  EXPECT_EQ(own.grouped(Grouping::automatic), (Names{"sun-lamp", "all-lamp", "rest-lamp", "sun"}));
}

TEST(Groups, Parse) {
  EXPECT_EQ(parse_grouping("auto"), Grouping::automatic);
  EXPECT_EQ(parse_grouping("named"), Grouping::named);
  EXPECT_EQ(parse_grouping("per-light"), Grouping::per_light);
  EXPECT_EQ(parse_grouping("one"), Grouping::one);
  EXPECT_THROW(parse_grouping("two"), UsageError);
}

}  // namespace
}  // namespace sconce
