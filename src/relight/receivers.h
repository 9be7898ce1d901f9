// SPDX-License-Identifier: Apache-2.0
// Who receives indirect light: the texels of a package's lightmap, so that the camera is free, or the pixels
// of a fixed camera (the chapter's deep frame buffer).
#pragma once

#include <optional>

#include "core/progress.h"
#include "picture/render.h"
#include "receive/atlas.h"
#include "transfer/operator.h"

namespace sconce {

/// What an eye sees of a surface that mirrors.
struct Glossy {
  Shade surface;
  Vec3 to_eye;      ///< unit
  SurfacePoint at;  ///< its shading normal is the normal map's
};

/// Receivers and where their answers go.
struct RelightReceivers {
  OperatorReceivers kind = OperatorReceivers::texels;
  int width = 0, height = 0, pages = 0;  ///< of the lightmap, or of the picture
  Camera camera;                         ///< of pixels
  std::vector<uint32_t> places;          ///< Operator::places
  ReceiverSource source;
  std::function<Rgb(std::size_t)> albedo;  ///< diffuse; thread-safe
  /// Of pixels: those that mirror; thread-safe. None of other receivers, and where lobes are not wanted.
  std::function<std::optional<Glossy>(std::size_t)> glossy;
};

/// The package's atlas on the triangles of its View. @throws Error when the package has no layout, or another
/// scene's
Atlas package_atlas(const Package& package, const View& view);

/// The texels of a lightmap. The scene must outlive it.
RelightReceivers texel_receivers(const TracedScene& traced, Atlas atlas, const Progress& progress = {});

/// Texels with those that lie under things which may move away.
struct AllTexels {
  RelightReceivers receivers;
  std::shared_ptr<const TexelReceivers> texels;  ///< the same
};
AllTexels all_texels(const TracedScene& traced, Atlas atlas, const Progress& progress = {});

/// The vertices of the world: each a little into the faces around it, by their area, since a point on the
/// edge of a room lies in the planes of its walls. Places are vertices; those without faces are none.
RelightReceivers vertex_receivers(const TracedScene& traced);

/// The texels that were baked. Package and view must outlive it.
RelightReceivers texel_receivers(const Package& package, const View& view, const Progress& progress = {});

/// Adds light on an operator's texels to the pages of a lightmap, gaps filled.
/// @param light  per receiver, lux
void add_to_pages(const Package& package, const View& view, const Operator& op, std::span<const Rgb> light,
                  std::vector<Image>& pages);
/// The same where the package's atlas is at hand.
void add_to_pages(const Atlas& atlas, const Operator& op, std::span<const Rgb> light,
                  std::vector<Image>& pages);
/// @param places  of the light, page x height x width + y x width + x
void add_to_pages(const Atlas& atlas, std::span<const uint32_t> places, std::span<const Rgb> light,
                  std::vector<Image>& pages);

/// That light alone: pages of a lightmap, lux.
std::vector<Image> to_pages(const Atlas& atlas, const Operator& op, std::span<const Rgb> light);

/// What the middles of pixels see; pixels that see nothing or a black back are none.
RelightReceivers pixel_receivers(const TracedScene& traced, const Camera& camera, int width, int height);

}  // namespace sconce
