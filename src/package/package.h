// SPDX-License-Identifier: Apache-2.0
// name.sconce/ on disk: manifest, geometry with its lightmap coordinates, one float image per group and page.
// The contract between bake, CPU mix, GPU and web. Format: docs/package-format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "encode/layer_texture.h"
#include "image/image.h"
#include "scene/scene.h"

namespace sconce {

inline constexpr int kPackageVersion = 1;

/// What a fader needs to know of its group.
struct GroupInfo {
  std::string name;
  double lumens = 0;  ///< luminous flux at unit weight; 0 for sky and sun
  Rgb color{1.0f};    ///< flux-weighted colour, luminance 1 (contract.md, "Colour")
  /// Largest relative channel difference of a lamp's colour from `color`; 0 = one colour, negative = not
  /// known.
  double color_spread = 0;
  bool infinite = false;  ///< sky or sun: has no lumens
  double mean_lux = 0;    ///< area-weighted mean of the layer's luminance
  double noise = 0;       ///< relative standard error of the layer, area-weighted rms over texels
  std::vector<std::string> lamps{};
  std::string inputs{};  ///< hash of all that the layer was solved from; empty = not known
};

struct LayerInfo {
  uint32_t group = 0;
  int page = 0;
  std::string encoding;         ///< EncodingChoice::name()
  std::string file;             ///< base name below layers/; groups that share a texture name the same
  std::string hash;             ///< of the file's bytes
  uint64_t bytes = 0;           ///< of the file
  std::size_t coefficient = 0;  ///< of the basis
  int channel = -1;             ///< luminance packing: which channel of the file; -1 = R, G, B
  double gain = 1;              ///< EncodedImage::gain
  EncodingError error{};        ///< against the layer before it was encoded
};

/// Where an option's value came from: "default", "side file", "command line".
struct Provenance {
  std::string value, source;
};

struct Manifest {
  int version = kPackageVersion;
  std::string generator;  ///< "sconce 0.1.0"
  std::string scene_name;
  std::string scene_hash;  ///< of everything a bake of this scene depends on
  int width = 0, height = 0, pages = 0;
  double density = 0;               ///< texels per metre asked for
  uint32_t lightmap_set = 0;        ///< TEXCOORD_n of scene.glb that holds lightmap coordinates
  std::vector<int> instance_pages;  ///< per mesh node of scene.glb; -1 = none
  std::vector<int> instance_twins;  ///< per mesh node: node of its twin (same triangles from behind), or -1
  Basis basis = Basis::flat;
  std::vector<GroupInfo> groups;
  std::vector<LayerInfo> layers;
  std::vector<LayerInfo> raw;  ///< the layers before the denoiser, of the same form; empty = not denoised
  std::map<std::string, std::string>
      hashes;  ///< other files (scene.glb, receivers.N.exr, noise.N.exr, raw-noise.N.exr) -> hash
  std::map<std::string, Provenance> options;  ///< every option of the bake
  std::map<std::string, std::string> facts;   ///< solver, samples, isa, seed, statistics: free text
};

class Package;

/// A group's layer of a package that stands.
struct KeptLayer {
  const Package* from;
  std::size_t group;
};

/// What a writer hands over. Images are per page: layers[coefficient * groups + group][page], RGB lux.
struct PackageContents {
  Manifest manifest;  ///< layers, raw, hashes are filled in by the writer
  Scene scene;        ///< BakedScene::scene
  std::vector<std::vector<Image>> layers;
  /// Per group: the solver's own layer (raw where there is raw, else layers) is that of a package that
  /// stands; empty = none. Files are linked where name and encoding stay.
  std::vector<std::optional<KeptLayer>> kept;
  /// Per group: EncodingChoice::name(), or "auto": the smallest whose error stays below `max_error`.
  std::vector<std::string> encodings;
  double max_error = 0.01;
  std::vector<Image> receivers;  ///< per page: albedo.R/G/B and weight (area x visibility; 0 = no texel)
  std::vector<Image> noise;      ///< per page: one channel per group, relative standard error
  std::vector<std::vector<Image>> raw;  ///< before the denoiser, as `layers`; empty = there was none
  std::vector<Image> raw_noise;         ///< of `raw`, as `noise`
  std::string layout;                   ///< receive/layout.h; may be empty
};

/// Writes beside and renames. @throws Error (unwritable, disk full); nothing half-written stays
void write_package(const std::filesystem::path& path, PackageContents contents);

/// A package that was read and validated: version, files present, sizes; hashes when asked.
class Package {
 public:
  /// @throws Error: no package, other version (both named), missing or damaged file (named); NotMyFormat when
  /// not a package
  static Package open(const std::filesystem::path& path, bool check_hashes = true);

  /// The same package as it was before the denoiser: layer() and noise() are the solver's own.
  /// @throws Error when it was not denoised
  Package undenoised() const;
  /// The same, or this very one when it was not denoised.
  Package solved() const { return manifest_.raw.empty() ? *this : undenoised(); }
  /// Files of the layers that layer() reads, and their folder.
  const std::vector<LayerInfo>& layer_files() const { return raw_ ? manifest_.raw : manifest_.layers; }
  std::filesystem::path layer_folder() const;

  const Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& path() const { return path_; }
  /// @throws Error when there is no such group, page or coefficient
  const LayerInfo& layer_info(std::size_t group, int page, std::size_t coefficient = 0) const;
  /// What layer_files() of one coefficient are, in the order of their first groups, with gains; every page
  /// alike.
  /// @throws Error where pages of a group differ in encoding
  std::vector<LayerTexture> textures(std::size_t coefficient = 0) const;
  /// One page of such a texture. @throws as encoded()
  EncodedImage encoded(const LayerTexture& texture, int page) const {
    return encoded(layer_info(texture.groups.front(), page, texture.coefficient));
  }
  /// One of layer_files() as it is stored: R, G, B, or the luminances of all groups that share its file.
  /// @throws Error naming the file when damaged or of another size
  EncodedImage encoded(const LayerInfo& layer) const;
  /// Decoded layer, RGB lux. The first coefficient of every basis is E at the shading normal. @throws as
  /// encoded()
  Image layer(std::size_t group, int page, std::size_t coefficient = 0) const;
  Image receivers(int page) const;
  Image noise(int page) const;
  /// What PackageContents::layout was. @throws Error when there is none
  std::string layout() const;
  /// scene.glb, read when first asked for.
  Scene scene() const;

 private:
  Image page_image(const std::string& name, const std::vector<std::string>& channels) const;

  std::filesystem::path path_;
  Manifest manifest_;
  bool raw_ = false;
};

}  // namespace sconce
