// SPDX-License-Identifier: Apache-2.0
// Bakes with the basis sh1: as many bits as flat ones, however they are cut, and pictures with normal maps.
#include <gtest/gtest.h>

#include "bake_job.h"
#include "core/parallel.h"
#include "picture/render.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Names = std::vector<std::string>;

class Directional : public testing::Test {
 protected:
  TemporaryFolder folder;
  Scene scene = test::two_lamp_room();

  void SetUp() override { write_scene(); }
  void write_scene() const { write_file(folder / "room.glb", write_glb(scene, "test")); }

  app::BakeJob job(Basis basis, const std::string& solver = "radiosity") const {
    app::BakeJob job;
    job.scene = folder / "room.glb";
    job.solver = solver;
    job.encoding = "f32";
    job.atlas.density = 16;
    job.params.samples = 16;
    job.params.cloud = solver == "radiosity" ? 1024 : 0;
    job.params.photons = solver == "photon" ? 1 << 15 : 0;
    job.params.basis = basis;
    return job;
  }
  Package bake(const app::BakeJob& job, const std::string& name, uint32_t shards = 1) const {
    std::vector<BakeState> states;
    for (uint32_t i = 0; i < shards; ++i) {
      const app::PreparedBake part(job, {});
      states.push_back(BakeState::create(folder / (name + std::to_string(i)), part.header()));
      app::run_bake(part, {i, shards}, states.back(), {});
    }
    app::write_result(app::PreparedBake(job, {}), states, folder / name, {}, {});
    return Package::open(folder / name);
  }
  static std::map<std::string, std::string> files(const Package& package) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(package.layer_folder()))
      files[entry.path().filename().string()] = read_file(entry.path());
    return files;
  }
};

TEST_F(Directional, FlatLayersKeepTheirBitsWithEverySolver) {
  for (const char* solver : {"radiosity", "path", "photon"}) {
    SCOPED_TRACE(solver);
    const auto flat = files(bake(job(Basis::flat, solver), "flat.sconce"));
    const auto sh1 = files(bake(job(Basis::sh1, solver), "sh1.sconce"));
    EXPECT_EQ(flat.size(), 2u);
    EXPECT_EQ(sh1.size(), 8u);
    for (const auto& [name, bytes] : flat) EXPECT_EQ(sh1.at(name), bytes) << name;
  }
}

TEST_F(Directional, SameBitsAtAnyThreadCountAndInShards) {
  const auto bake_with = [&](int threads, uint32_t shards) {
    const ThreadLimit limit(threads);
    return files(bake(job(Basis::sh1), "x.sconce", shards));
  };
  const auto whole = bake_with(1, 1);
  EXPECT_EQ(whole, bake_with(2, 1));
  EXPECT_EQ(whole, bake_with(2, 3));
}

/// The denoiser gives g the weights that it gives E: groups add up, raw ones stay.
TEST_F(Directional, DenoisedWithTheWeightsOfTheFlatLayers) {
  app::BakeJob denoised = job(Basis::sh1);
  denoised.denoise = true;
  const Package clean = bake(denoised, "clean.sconce");
  denoised.params.basis = Basis::flat;
  const Package flat = bake(denoised, "flat.sconce"), raw = bake(job(Basis::sh1), "raw.sconce");
  double change = 0, size = 0;
  for (std::size_t g = 0; g < 2; ++g) {
    EXPECT_EQ(clean.layer(g, 0).data, flat.layer(g, 0).data);
    for (std::size_t c = 1; c < 4; ++c) {
      const Image filtered = clean.layer(g, 0, c), before = clean.undenoised().layer(g, 0, c);
      EXPECT_EQ(before.data, raw.layer(g, 0, c).data);
      for (std::size_t i = 0; i < before.data.size(); ++i) {
        change += std::abs(double{filtered.data[i]} - before.data[i]);
        size += std::abs(double{before.data[i]});
      }
    }
  }
  EXPECT_GT(change, 0.005 * size);
  EXPECT_LT(change, 0.3 * size);
}

TEST_F(Directional, KeptLayersKeepAllCoefficients) {
  const Names words{"bake",       (folder / "room.glb").string(),
                    "-o",         (folder / "x.sconce").string(),
                    "--density",  "16",
                    "--samples",  "16",
                    "--encoding", "f32",
                    "--basis",    "sh1"};
  ASSERT_EQ(test::run_sconce(words).code, 0);
  const auto before = files(Package::open(folder / "x.sconce"));
  scene.materials[3].emission *= 2.0f;
  write_scene();
  ASSERT_EQ(test::run_sconce(words).code, 0);
  const Package package = Package::open(folder / "x.sconce");
  const auto after = files(package);
  int same = 0;
  for (const auto& [name, bytes] : before) same += after.at(name) == bytes ? 1 : 0;
  EXPECT_EQ(same, 4) << "those of the lamp that did not change";
  const test::Outcome again = test::run_sconce(words);
  EXPECT_NE(again.out.find("up to date"), std::string::npos) << again.out;
  Names flat = words;
  flat.back() = "flat";
  EXPECT_EQ(test::run_sconce(flat).code, 0);
  EXPECT_EQ(Package::open(folder / "x.sconce").manifest().basis, Basis::flat);
  EXPECT_EQ(files(Package::open(folder / "x.sconce")).size(), 2u);
}

TEST_F(Directional, RefusalsAreOneClearLine) {
  const auto error = [&](const Names& more) {
    Names words{"bake", (folder / "room.glb").string(), "-o", (folder / "x.sconce").string(), "--basis"};
    words.insert(words.end(), more.begin(), more.end());
    const test::Outcome outcome = test::run_sconce(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(error({"sh2"}).find("unknown basis 'sh2' (allowed: flat, sh1)"), std::string::npos)
      << error({"sh2"});
  for (const char* encoding : {"exp8", "rgbe8", "multi8", "bc6h", "lum:f16", "f16,left=exp8"})
    EXPECT_NE(error({"sh1", "--encoding", encoding}).find("cannot hold the signed basis sh1"),
              std::string::npos)
        << encoding;
  EXPECT_NE(error({"sh1", "--solver", "external:true"}).find("knows no directions"), std::string::npos);
  EXPECT_NE(error({"sh1", "--solver", "photon", "--direct-estimate"}).find("knows no directions"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "x.sconce"));
}

/// A tile on black ground under an even sky: one normal map tilts it all by `tilt`, or the tile is tilted.
Scene tile(bool mapped, float tilt) {
  Scene scene;
  const auto black = add_material(scene, "black", Rgb(0)), grey = add_material(scene, "grey", Rgb(0.5f));
  add_quad(scene, "ground", black, Vec3(-20, -0.1f, -20), Vec3(0, 0, 40), Vec3(40, 0, 0));
  scene.instances[0].lightmap_scale = 0.02f;
  const float c = mapped ? 1 : std::cos(tilt), s = mapped ? 0 : std::sin(tilt);
  const auto quad = add_quad(scene, "tile", grey, Vec3(0), Vec3(0, 0, 0.1f), 0.1f * Vec3(c, -s, 0));
  Mesh& mesh = scene.meshes[scene[quad].mesh.value];
  mesh.texcoords = {{}};
  for (const Vec3& p : mesh.positions) mesh.texcoords[0].emplace_back(10 * p.x, 10 * p.z);
  if (mapped) {
    const auto code = [](float v) { return static_cast<unsigned char>(std::lround(127.5f * (v + 1))); };
    Texture map;
    map.name = "tilted";
    map.pixels = {1, 1, 3, {code(std::sin(tilt)), 128, code(std::cos(tilt))}};
    scene.textures = {map};
    scene.materials[1].normal_texture.texture = Id<Texture>(0);
  }
  scene.cameras.push_back(look_at(Vec3(0.05f, 0.4f, 0.06f), Vec3(0.05f, 0, 0.05f)));
  scene.cameras.back().name = "main";
  scene.cameras.back().yfov = 0.05f;
  return scene;
}

// From scene file to picture. An even sky gives a tilted tile pi L (1 + cos) / 2; the map's normal leans
// towards +x, where a tile with that normal falls.
TEST_F(Directional, MappedTileLooksLikeTheTiltedOne) {
  constexpr float kTilt = 0.9f;
  const auto radiance = [&](bool mapped, Basis basis) {
    scene = tile(mapped, kTilt);
    write_scene();
    folder.write("room.toml", "[sky]\nluminance = 100\n");
    app::BakeJob j = job(basis, "path");
    j.params.samples = 512;
    j.params.cloud = 0;
    j.atlas.density = 60;
    const Package package = bake(j, "tile.sconce");
    const View view(package);
    const MixSpec mix{{Rgb(1)}};
    PictureParams params;
    params.width = params.height = 4;
    const Image picture = view.render(view.camera("main"), mix, mix_pages(package, mix), params, {}, nullptr,
                                      {}, mix_components(package, mix));
    return picture.rgb_at(2, 2).g;
  };
  const float truth = radiance(false, Basis::flat), flat = radiance(true, Basis::flat),
              sh1 = radiance(true, Basis::sh1);
  EXPECT_NEAR(truth, 0.5f * 100 * (1 + std::cos(kTilt)) / 2, 0.5f);
  EXPECT_NEAR(sh1, truth, 0.5f);
  EXPECT_NEAR(flat, 50, 0.5f) << "flat layers know no normal maps";
}

}  // namespace
}  // namespace sconce
