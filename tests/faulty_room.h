// SPDX-License-Identifier: Apache-2.0
// A small room, its package, and what stands under the name of an output.
#pragma once

#include <gtest/gtest.h>

#include "core/files.h"
#include "core/hash.h"
#include "package/package.h"
#include "process.h"
#include "small_scenes.h"
#include "transfer/operator.h"

namespace sconce::test {

/// The smallest operator; its package follows.
inline const std::vector<std::string> kSmallTransfer = {"transfer", "--gather", "256", "--rays",
                                                        "16",       "--lights", "16",  "--quiet"};

class FaultyRoom : public testing::Test {
 protected:
  void SetUp() override { folder.write("room.glb", write_glb(two_lamp_room(), "test")); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::vector<std::string> bake(const std::string& output, const std::string& seed) const {
    return {"bake", path("room.glb"), "-o", path(output), "--atlas", "64", "--samples",
            "16",   "--seed",         seed, "--quiet"};
  }
  void done(const std::vector<std::string>& words) const {
    const Outcome outcome = run_sconce(words);
    ASSERT_EQ(outcome.code, 0) << join(words, " ") << "\n" << outcome.err;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
      all.push_back(std::filesystem::relative(entry.path(), folder.path()).string());
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Of a file's bytes or of a package's layers, geometry and operators, all of which are checked; empty
  /// where nothing is. @throws Error where it is not whole
  static std::string content(const std::filesystem::path& output) {
    if (!std::filesystem::exists(output)) return {};
    if (!std::filesystem::is_directory(output)) return hash_file(output);
    const Package package = Package::open(output, true);
    std::string all;
    for (const LayerInfo& layer : package.manifest().layers) all += layer.hash;
    for (const auto& [name, hash] : package.manifest().hashes) all += hash;
    const std::filesystem::path op = output / "operators/lightmap.bin";
    if (std::filesystem::exists(op)) open_operator(op, true), all += hash_file(op);
    return hash_hex(all);
  }

  TemporaryFolder folder;
};

}  // namespace sconce::test
