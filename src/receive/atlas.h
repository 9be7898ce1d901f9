// SPDX-License-Identifier: Apache-2.0
// The lightmap atlas: charts, their places on pages, and the receivers under its texels.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/ranks.h"
#include "core/receiver.h"
#include "image/image.h"
#include "trace/tracer.h"

namespace sconce {

struct AtlasParams {
  int page_size = 0;  ///< texels; 0 = chosen from `density`, power of two up to max_page
  int max_page = 4096;
  float density = 0;  ///< texels per metre; 0 = chosen so that one page of `page_size` is filled
  int gutter = 2;     ///< texels between charts, at least 2
  float min_density_scale = 1.0f / 16;  ///< linear scale for what nobody sees
  bool keep_uvs = true;                 ///< use an existing, valid set
  uint32_t seed = 1;
};

/// One side of a triangle in the atlas.
struct TexelTriangle {
  std::array<Vec2, 3> uv;  ///< texel coordinates on its page: x right, y down, row 0 = v 0
  int page = -1;           ///< -1: this side has no texels (emissive back, unseen back, single-sided back)
  uint32_t chart = 0;
  uint8_t importance = 0;  ///< how much it is looked at: importance_code()
};

struct AtlasReport {
  std::size_t charts = 0, texels = 0, invalid = 0;
  double utilisation = 0;  ///< used texels / page texels
  double stretch_mean = 0,
         stretch_max = 0;  ///< L2 stretch, 1 = isometric, area-weighted mean and maximum over charts
  std::size_t twins = 0;   ///< triangles whose back has texels
  bool kept_uvs = false;
  std::vector<std::string> warnings;
};

/// A surface chart placed in texels; front and back (twin) of each World triangle.
struct Atlas {
  int width = 0, height = 0, pages = 0;
  float density = 0;                       ///< texels per metre where the density scale is 1
  std::vector<TexelTriangle> front, back;  ///< per World triangle
  std::vector<uint8_t>
      reached_back;  ///< per World triangle: 1 where probe rays reach its back, so that it is legal to see
  std::vector<uint8_t> seen_charts;  ///< per chart: 1 where any probe ray reaches it
  AtlasReport report;
};

/// Unwraps, measures what can be seen, packs. 400 k triangles take under a minute on two cores.
/// @throws Error when `page_size` is too small for the charts, or a scene has nothing to light
Atlas make_atlas(const Scene& scene, const World& world, const Tracer& tracer, const AtlasParams& params,
                 const Progress& progress = {});

/// @param side  2 * triangle + 1 for the back
inline const TexelTriangle& side_of(const Atlas& atlas, uint32_t side) {
  return ((side & 1) != 0 ? atlas.back : atlas.front)[side / 2];
}

/// Where a surface is looked at this many times as much as an ordinary one, it is metered no more for it.
inline constexpr float kMostImportance = 16;
/// Sixteen steps to a factor of two, downwards from kMostImportance, never 0: the same from a kept layout.
uint8_t importance_code(double importance);
float importance_of(uint8_t code);

/// The texels of an atlas as receivers, in fixed tiles.
class TexelReceivers {
 public:
  static constexpr std::size_t kTile =
      256;  ///< receivers per tile: the unit of work, of checkpoints and of shards

  /// Rasterises conservatively: a texel is a receiver where a triangle covers any of it. Parts of a texel
  /// whose points mostly see backs that no probe ray reached, or meet something right in front of them, are
  /// buried and do not count; texels without any other part are left out and counted invalid.
  /// @pre atlas comes from make_atlas() with the same world
  /// @param ranks  share the search for buried parts
  /// @param all    also those without any other part, whole: what is above them may move away
  TexelReceivers(const World& world, const Tracer& tracer, Atlas& atlas, const Progress& progress = {},
                 const Ranks& ranks = {}, bool all = false);

  std::size_t size() const { return texels_.size(); }
  std::size_t tiles() const { return (size() + kTile - 1) / kTile; }
  /// Where receiver i lies: page * height * width + y * width + x.
  uint32_t texel(std::size_t i) const { return texels_[i]; }
  /// Clips the texel's triangles; pieces carry the back's flipped normals where the texel is of a twin chart.
  Footprint footprint(std::size_t i) const;
  /// Whether all of it lies under or inside other geometry, as the world stands now.
  bool covered(std::size_t i) const;
  /// Of the World: the first one under it.
  uint32_t triangle(std::size_t i) const { return sides_[first_[i]] / 2; }
  /// How much it is looked at, in (0, kMostImportance]: exposure is metered with area x importance.
  float importance(std::size_t i) const;
  /// Metres from a texel to the next where it lies, at least those at the atlas's density.
  float spacing(std::size_t i) const;
  /// Area-weighted mean diffuse albedo over the footprint's triangles (contract: without emission).
  Rgb albedo(const Scene& scene, std::size_t i) const;

 private:
  const World* world_;
  const Tracer* tracer_;
  const Atlas* atlas_;
  std::vector<uint32_t> texels_;
  std::vector<uint32_t> first_;  ///< CSR over texels_: range of sides_
  std::vector<uint32_t> sides_;  ///< triangle * 2 + (1 if back)
  std::vector<uint16_t> cells_;  ///< per receiver: which cells of its 4 x 4 grid count; the others are buried
};

/// Fills texels that no receiver owns: invalid ones inside charts from valid neighbours of the same chart
/// first, then the gutters by dilation, so that bilinear look-ups never meet black. In place, any channel
/// count, one image per page.
/// @param valid  per texel of that page: 1 where `image` holds a baked value
void fill_gaps(const Atlas& atlas, int page, const std::vector<uint8_t>& valid, Image& image);

/// The scene that a package carries: instances made real, split by page and by side; twin charts as
/// primitives of their own with flipped normals; lightmap coordinates in [0,1] as the first free TEXCOORD
/// set, the same for all meshes.
struct BakedScene {
  Scene scene;
  uint32_t lightmap_set = 0;
  std::vector<int> pages;           ///< per instance of `scene`; -1 = no lightmap (emitters may have none)
  std::vector<Id<Instance>> twins;  ///< per instance: its twin (same triangles, seen from behind), or none
};
BakedScene make_baked_scene(const Scene& scene, const World& world, const Atlas& atlas);

}  // namespace sconce
