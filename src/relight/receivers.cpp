// SPDX-License-Identifier: Apache-2.0
#include "relight/receivers.h"

#include <cstring>
#include <map>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/gloss.h"
#include "receive/layout.h"

namespace sconce {

namespace {

/// A side by where it lies in the lightmap: sides do not overlap there.
using SideKey = std::pair<int, std::array<Vec2, 3>>;
struct Before {
  bool operator()(const SideKey& a, const SideKey& b) const {
    return a.first != b.first ? a.first < b.first : std::memcmp(&a.second, &b.second, sizeof a.second) < 0;
  }
};

AllTexels find_texels(const TracedScene& traced, Atlas atlas, const Progress& progress, bool all) {
  struct State {
    Atlas atlas;
    std::unique_ptr<TexelReceivers> texels;
  };
  const auto state = std::make_shared<State>();
  state->atlas = std::move(atlas);
  state->texels =
      std::make_unique<TexelReceivers>(traced.world, traced.tracer, state->atlas, progress, Ranks{}, all);
  RelightReceivers out;
  out.width = state->atlas.width, out.height = state->atlas.height, out.pages = state->atlas.pages;
  for (std::size_t i = 0; i < state->texels->size(); ++i) out.places.push_back(state->texels->texel(i));
  out.source = {state->texels->size(), [state](std::size_t i) { return state->texels->footprint(i); }};
  out.albedo = [state, &scene = traced.scene](std::size_t i) { return state->texels->albedo(scene, i); };
  return {out, {state, state->texels.get()}};
}

}  // namespace

// layout.bin counts triangles as the source did; the package has them sorted by page. A triangle's place in
// the lightmap tells which it is. Sides without a place need none.
Atlas package_atlas(const Package& package, const View& view) {
  const Manifest& m = package.manifest();
  const std::string where = (package.path() / "layout.bin").string();
  const std::size_t n = view.world().size();
  const Atlas source = unpack_layout(package.layout(), n, where);
  std::map<SideKey, std::pair<uint32_t, bool>, Before> known;
  const Vec2 page(static_cast<float>(source.width), static_cast<float>(source.height));
  for (uint32_t t = 0; t < n; ++t)
    for (const bool back : {false, true}) {
      const TexelTriangle& side = (back ? source.back : source.front)[t];
      if (side.page < 0) continue;
      SideKey key{side.page, side.uv};
      for (Vec2& uv : key.second) uv = glm::clamp(uv / page, Vec2(0), Vec2(1));
      known.emplace(key, std::pair(t, back));
    }
  Atlas atlas = source;
  for (uint32_t t = 0; t < n; ++t) {
    for (const bool back : {false, true}) {
      TexelTriangle& side = (back ? atlas.back : atlas.front)[t];
      side = {};
      const LightmapSide& seen = view.side(t, back);
      if (seen.page < 0) continue;
      const auto it = known.find({seen.page, seen.uv});
      if (it == known.end() || it->second.second != back)
        throw Error(where, "is not the layout of this scene");
      side = (back ? source.back : source.front)[it->second.first];
      atlas.reached_back[t] = source.reached_back[it->second.first];
    }
  }
  if (atlas.width != m.width || atlas.height != m.height || atlas.pages != m.pages)
    throw Error(where, "is not the layout of this scene");
  return atlas;
}

RelightReceivers texel_receivers(const TracedScene& traced, Atlas atlas, const Progress& progress) {
  return find_texels(traced, std::move(atlas), progress, false).receivers;
}

AllTexels all_texels(const TracedScene& traced, Atlas atlas, const Progress& progress) {
  return find_texels(traced, std::move(atlas), progress, true);
}

RelightReceivers texel_receivers(const Package& package, const View& view, const Progress& progress) {
  return texel_receivers(view.traced(), package_atlas(package, view), progress);
}

RelightReceivers vertex_receivers(const TracedScene& traced) {
  const World& world = traced.world;
  /// CSR: corners of faces around each vertex, as 3 x triangle + corner.
  struct Around {
    std::vector<uint32_t> first, corners;
  };
  const auto around = std::make_shared<Around>();
  around->first.assign(world.positions.size() + 1, 0);
  for (const Triangle& t : world.triangles)
    for (const uint32_t v : t.v) ++around->first[v + 1];
  std::partial_sum(around->first.begin(), around->first.end(), around->first.begin());
  around->corners.resize(around->first.back());
  std::vector<uint32_t> cursor(around->first.begin(), around->first.end() - 1);
  for (uint32_t k = 0; k < 3 * world.size(); ++k)
    around->corners[cursor[world.triangles[k / 3].v[k % 3]]++] = k;

  RelightReceivers out;
  out.kind = OperatorReceivers::vertices;
  out.width = static_cast<int>(world.positions.size()), out.height = out.pages = 1;
  for (uint32_t v = 0; v < world.positions.size(); ++v)
    if (around->first[v] != around->first[v + 1]) out.places.push_back(v);
  out.source.count = out.places.size();
  out.source.footprint = [around, &world, places = out.places](std::size_t i) {
    constexpr float kInto = 0.125f;  // of the edges' lengths
    Footprint footprint;
    footprint.kind = ReceiverKind::vertex, footprint.id = places[i];
    for (uint32_t k = around->first[places[i]]; k < around->first[places[i] + 1]; ++k) {
      const uint32_t t = around->corners[k] / 3, corner = around->corners[k] % 3;
      constexpr std::array<Vec2, 3> kCorners{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
      const Vec2 at = kCorners[corner];
      const auto point = [&](uint32_t c) { return at + kInto * (kCorners[(corner + c) % 3] - at); };
      footprint.pieces.push_back({world.position(t, at), world.position(t, point(1)),
                                  world.position(t, point(2)), world.normal(t, at), world.normal(t, point(1)),
                                  world.normal(t, point(2)), world.face_normals[t]});
      footprint.area += kInto * kInto * world.area(t);
      footprint.pieces.back().cumulative = footprint.area;
    }
    for (FootprintPiece& piece : footprint.pieces) piece.cumulative /= footprint.area;
    footprint.pieces.back().cumulative = 1;
    return footprint;
  };
  out.albedo = [around, traced, places = out.places](std::size_t i) {
    const uint32_t k = around->corners[around->first[places[i]]];
    return shade(traced.scene, traced.world, k / 3, Vec2(1.0f / 3)).receiver_albedo();
  };
  return out;
}

void add_to_pages(const Package& package, const View& view, const Operator& op, std::span<const Rgb> light,
                  std::vector<Image>& pages) {
  add_to_pages(package_atlas(package, view), op, light, pages);
}

void add_to_pages(const Atlas& atlas, const Operator& op, std::span<const Rgb> light,
                  std::vector<Image>& pages) {
  add_to_pages(atlas, op.places, light, pages);
}

std::vector<Image> to_pages(const Atlas& atlas, const Operator& op, std::span<const Rgb> light) {
  std::vector<Image> pages(static_cast<std::size_t>(atlas.pages), Image::rgb(atlas.width, atlas.height));
  add_to_pages(atlas, op, light, pages);
  return pages;
}

void add_to_pages(const Atlas& atlas, std::span<const uint32_t> places, std::span<const Rgb> light,
                  std::vector<Image>& pages) {
  const std::size_t page_size =
      static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height);
  for (int page = 0; page < atlas.pages; ++page) {
    Image own = Image::rgb(atlas.width, atlas.height);
    std::vector<uint8_t> valid(page_size, 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] / page_size != static_cast<std::size_t>(page)) continue;
      const std::size_t at = places[i] % page_size;
      valid[at] = 1;
      own.set_rgb(static_cast<int>(at) % atlas.width, static_cast<int>(at) / atlas.width, light[i]);
    }
    fill_gaps(atlas, page, valid, own);
    Image& sum = pages[static_cast<std::size_t>(page)];
    for (std::size_t k = 0; k < own.data.size(); ++k) sum.data[k] += own.data[k];
  }
}

RelightReceivers pixel_receivers(const TracedScene& traced, const Camera& camera, int width, int height) {
  PictureParams params;
  params.width = width, params.height = height;
  const Lens lens(camera, params);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<Hit> hits(pixels);
  parallel_for(pixels, 1024, [&](std::size_t i) {
    const auto x = static_cast<float>(i % static_cast<std::size_t>(width)),
               y = static_cast<float>(i / static_cast<std::size_t>(width));
    hits[i] = traced.tracer.closest({lens.eye(), lens.direction({x + 0.5f, y + 0.5f})});
  });
  const auto kept = std::make_shared<std::vector<Hit>>();
  RelightReceivers out;
  out.kind = OperatorReceivers::pixels;
  out.width = width, out.height = height, out.pages = 1;
  out.camera = camera;
  for (std::size_t i = 0; i < pixels; ++i) {
    const Hit& hit = hits[i];
    if (!hit || (hit.back && !traced.scene[traced.world.materials[hit.triangle]].double_sided)) continue;
    out.places.push_back(static_cast<uint32_t>(i));
    kept->push_back(hit);
  }
  out.source.count = kept->size();
  out.source.footprint = [kept, traced, places = out.places](std::size_t i) {
    return Footprint::point(places[i], ReceiverKind::pixel, surface_point(traced.world, (*kept)[i]));
  };
  out.albedo = [kept, traced](std::size_t i) {
    return shade(traced.scene, traced.world, (*kept)[i].triangle, (*kept)[i].barycentric).receiver_albedo();
  };
  out.glossy = [kept, traced, eye = lens.eye()](std::size_t i) -> std::optional<Glossy> {
    const Hit& hit = (*kept)[i];
    Glossy seen{shade(traced.scene, traced.world, hit.triangle, hit.barycentric), {}, {}};
    if (!mirrors(seen.surface)) return std::nullopt;
    seen.at = surface_point(traced.world, hit);
    const Vec3 mapped = normal_offset(traced.scene, traced.world, hit.triangle, hit.barycentric);
    seen.at.shading_normal += hit.back ? -mapped : mapped;
    seen.to_eye = glm::normalize(eye - seen.at.position);
    return seen;
  };
  return out;
}

}  // namespace sconce
