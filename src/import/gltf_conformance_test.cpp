// SPDX-License-Identifier: Apache-2.0
// Other people's glTF test suites: never a crash; what the reference validator finds no error in loads.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/test_data.h"
#include "import/test_files.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

std::vector<fs::path> gltf_below(const fs::path& root) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Loads, or says why not in one line.
std::string outcome(const fs::path& path) {
  const std::string error = error_of([&] { import_gltf(path); });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  if (!error.empty()) {
    EXPECT_NE(error.find(path.filename().string()), std::string::npos) << error;
  }
  return error;
}

TEST(GltfConformance, Validator) {
  const fs::path root = test_data() / "conformance/gltf-validator";
  SCONCE_NEEDS_DATA(root);
  int valid = 0, invalid = 0, refused = 0;
  for (const fs::path& path : gltf_below(root)) {
    const fs::path report_path = path.string() + ".report.json";
    if (!fs::exists(report_path)) continue;
    const auto report = nlohmann::json::parse(read_file(report_path));
    const std::string error = outcome(path);
    if (report.at("issues").at("numErrors").get<int>() == 0) {
      ++valid;
      // What asks for glTF 2.1 must not be read by a program that knows 2.0.
      EXPECT_EQ(error.empty(), path.filename() != "min_version_valid.gltf") << error;
    } else {
      ++invalid;
      refused += error.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(valid, 20);
  EXPECT_GT(invalid, 50);
  EXPECT_GT(refused, invalid / 4);  // many errors are in parts that light transport does not use
}

TEST(GltfConformance, Magnum) {
  const fs::path root = test_data() / "conformance/magnum-gltf";
  SCONCE_NEEDS_DATA(root);
  const auto all = gltf_below(root);
  EXPECT_GT(all.size(), 70u);
  for (const fs::path& path : all) outcome(path);
}

TEST(GltfConformance, FuzzSeeds) {
  const fs::path root = test_data() / "conformance/cgltf-fuzz";
  SCONCE_NEEDS_DATA(root);
  for (const fs::path& path : gltf_below(root)) outcome(path);
}

// Every prefix of a GLB, and every byte of its JSON overwritten: an Error or a scene, never anything else.
TEST(GltfConformance, DamagedBoxNeverCrashes) {
  const fs::path box = test_data() / "glb/cornell-two-lights.glb";
  SCONCE_NEEDS_DATA(box);
  const TemporaryFolder folder;
  const std::string whole = read_file(box);
  const fs::path path = folder.path() / "damaged.glb";
  for (std::size_t n = 0; n < whole.size(); n += 97) {
    folder.write("damaged.glb", std::string_view(whole).substr(0, n));
    outcome(path);
  }
  unsigned state = 1;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k) {
      state = state * 1664525u + 1013904223u;
      bytes[20 + (state >> 8) % (bytes.size() - 20)] = "0123456789{}[]\",-"[(state >> 4) % 17];
    }
    folder.write("damaged.glb", bytes);
    outcome(path);
  }
}

}  // namespace
}  // namespace sconce
