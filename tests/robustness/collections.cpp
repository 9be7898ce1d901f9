// SPDX-License-Identifier: Apache-2.0
#include "collections.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "core/program.h"
#include "core/scratch_folder.h"

namespace fs = std::filesystem;

namespace sconce::robustness {

namespace {

constexpr Collection kCollections[] = {
    {"gltf-validator", "gltf-validator", "glTF, valid and not, with the reference validator's reports"},
    {"magnum-gltf", "magnum-gltf", "glTF that a strict loader refuses"},
    {"cgltf-fuzz", "cgltf-fuzz", "seeds of another loader's fuzzing"},
    {"tinyobj", "tinyobj", "features of OBJ and MTL"},
    {"assimp-3ds", "assimp-3ds", "3DS; empty and malformed files"},
    {"xatlas-degenerate", "xatlas-degenerate", "meshes without area, doubled edges"},
    {"view3d-formfactors", "view3d-formfactors", "inputs of another program"},
    {"ufbx-obj-fuzz", "ufbx-obj-fuzz.tar.xz", "OBJ and MTL that fuzzing found"},
    {"openexr-damaged", "openexr-damaged.tar.xz", "OpenEXR that fuzzing found"}};

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Unpacked files that do not say by their name what they are: pictures get their ending, and an MTL is read
/// through an OBJ.
std::vector<fs::path> unpack(const fs::path& archive, const fs::path& folder) {
  const std::string tar[] = {"tar", "xJf", archive.string(), "-C", folder.string()};
  if (run_program(tar, "/dev/null", "/dev/null", {}) != 0)
    throw Error(archive.string(), "cannot be unpacked");
  std::vector<fs::path> files = files_below(folder);
  for (fs::path& file : files) {
    fs::path named = file;
    if (file.extension() == ".mtl") {
      named.replace_extension(".obj");
      write_file(named, fmt::format("mtllib {}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
                                    file.filename().string()));
    } else if (!file.has_extension() && archive.stem().stem() == "openexr-damaged") {
      named += ".exr";
      fs::rename(file, named);
    }
    file = named;
  }
  return files;
}

bool found_valid(const fs::path& file) {
  const fs::path report = file.string() + ".report.json";
  return fs::exists(report) &&
         nlohmann::json::parse(read_file(report)).at("issues").at("numErrors").get<int>() == 0;
}

void try_file(const fs::path& file, const Program& program, const fs::path& scratch, Counts& counts) {
  ++counts.files;
  const bool picture = file.extension() == ".exr";
  const std::string name = file.string();
  const auto run = [&](std::vector<std::string> words) {
    Run made = run_limited(program, std::move(words), file);
    const std::string folder = file.parent_path().string() + "/";  // says nothing elsewhere
    for (std::size_t at = 0; (at = made.line.find(folder)) != std::string::npos;)
      made.line.erase(at, folder.size());
    counts.slowest = std::max(counts.slowest, made.seconds);
    if (made.end == End::finding) counts.findings.push_back(file.filename().string() + ": " + made.line);
    return made;
  };
  const Run read = picture ? run({"diff", name, name}) : run({"info", name});
  if (read.end == End::done) ++counts.read;
  if (read.end == End::refused)
    ++(read.line.find("is in no format") != std::string::npos ? counts.foreign : counts.refused);
  if (found_valid(file)) {
    ++counts.valid;
    if (read.end != End::done) counts.valid_refused.push_back(read.line);
  }
  if (picture) run({"info", name});
  if (picture || read.end != End::done) return;
  const Run baked = run({"bake", name, "-o", (scratch / "x.sconce").string(), "--force", "--atlas", "64",
                         "--samples", "1", "--bounces", "1", "--cloud", "64"});
  if (baked.end == End::done) ++counts.baked;
}

}  // namespace

std::span<const Collection> collections() {
  return kCollections;
}

std::string Counts::row(const Collection& collection) const {
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", collection.name, collection.what, files,
                     read, baked, refused, foreign, findings.size());
}

Counts try_all(const Collection& collection, const fs::path& data, const Program& program) {
  const fs::path place = data / "conformance" / collection.place;
  if (!fs::exists(place)) throw Error(place.string(), "is absent");
  const ScratchFolder unpacked, scratch;
  Counts counts;
  for (const fs::path& file : fs::is_directory(place) ? files_below(place) : unpack(place, unpacked.path()))
    try_file(file, program, scratch.path(), counts);
  return counts;
}

}  // namespace sconce::robustness
