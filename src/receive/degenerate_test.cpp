// SPDX-License-Identifier: Apache-2.0
// Meshes that broke other unwrappers (xatlas's own test models): nothing may crash, hang or lose a triangle.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/test_data.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

/// Positions and faces of an OBJ file, fanned; enough for these files.
Mesh read_obj(const std::filesystem::path& path) {
  Mesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec3 p(0);
      words >> p.x >> p.y >> p.z;
      mesh.positions.push_back(p);
    } else if (word == "f") {
      std::vector<uint32_t> corners;
      while (words >> word) {
        const int i = std::stoi(word);
        corners.push_back(static_cast<uint32_t>(i > 0 ? i - 1 : static_cast<int>(mesh.positions.size()) + i));
      }
      for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({{corners[0], corners[k - 1], corners[k]}});
    }
  }
  return mesh;
}

TEST(Degenerate, ModelsThatBrokeOthersAreUnwrapped) {
  const std::filesystem::path folder = test_data() / "conformance" / "xatlas-degenerate";
  SCONCE_NEEDS_DATA(folder);
  int models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    SCOPED_TRACE(entry.path().filename());
    ++models;
    TestScene s;
    s.scene.meshes.push_back(read_obj(entry.path()));
    ASSERT_FALSE(s.scene.meshes[0].triangles.empty());
    s.scene.meshes[0].material = add_material(s.scene, "grey", Rgb(0.5f), {}, true);
    s.scene.instances.emplace_back();
    s.scene.instances[0].mesh = Id<Mesh>(0);
    try {
      s.finish();
    } catch (const Error&) {
      continue;  // not one triangle of any area
    }
    AtlasParams params;
    params.page_size = 256;
    s.unwrap(params);
    for (const TexelTriangle& t : s.atlas.front) {
      ASSERT_GE(t.page, 0);
      for (const Vec2& p : t.uv) {
        EXPECT_TRUE(p.x >= 0 && p.x <= 256 && p.y >= 0 && p.y <= 256);
      }
    }
    const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
    for (std::size_t i = 0; i < receivers.size(); ++i) EXPECT_FALSE(receivers.footprint(i).pieces.empty());
  }
  EXPECT_GT(models, 0);
}

}  // namespace
}  // namespace sconce
