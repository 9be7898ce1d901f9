// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "import/gltf_model.h"

namespace sconce {

/// A glTF picture where it lies: in a file beside the scene, inline, or in a buffer view.
struct GltfImage {
  std::string name, mime, uri;
  int buffer_view = -1;
};

/// A glTF file read and checked as a whole: version, extensions, buffers. Pictures are not yet read.
struct GltfSource {
  std::filesystem::path path;
  tinygltf::Model model;
  std::vector<bool> buffer_missing;  ///< per buffer of the file: a warning has named it
  std::vector<GltfImage> images;

  /// "kitchen.glb: meshes[3]" - the place of an error.
  std::string at(const std::string& place) const { return path.string() + ": " + place; }

  /// Does the view lie in a buffer that is there? @throws Error when it reaches beyond it
  bool has_view(int view, const std::string& place) const;
  std::span<const unsigned char> view(int view, const std::string& place) const;
};

/// @throws NotMyFormat, Error: damaged, wrong version, an unknown extension is required, a buffer is too
/// short
GltfSource open_gltf(const std::filesystem::path& path, const Progress& progress);

/// External buffers and pictures that the file names and that are there.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path);

}  // namespace sconce
