// SPDX-License-Identifier: Apache-2.0
#include "receive/layout.h"

#include <cstring>

#include "core/error.h"

namespace sconce {

namespace {

constexpr std::string_view kMagic = "sconcel2", kEarlier = "sconcel1";

struct Head {
  int32_t width, height, pages;
  float density;
  uint64_t triangles, charts;
  double stretch_mean, stretch_max;
  uint64_t twins;
  uint32_t kept_uvs, reserved;
};

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes values off the front; false once when they run out.
struct Reader {
  std::string_view left;
  bool whole = true;

  void take(void* to, std::size_t size) {
    whole &= left.size() >= size;
    if (!whole) return;
    std::memcpy(to, left.data(), size);
    left.remove_prefix(size);
  }
};

}  // namespace

std::string pack_layout(const Atlas& atlas) {
  std::string out(kMagic);
  const AtlasReport& report = atlas.report;
  put(out, Head{atlas.width, atlas.height, atlas.pages, atlas.density, atlas.front.size(),
                atlas.seen_charts.size(), report.stretch_mean, report.stretch_max, report.twins,
                report.kept_uvs ? 1u : 0u, 0});
  const auto bytes = [&](const std::vector<uint8_t>& v) {
    out.append(reinterpret_cast<const char*>(v.data()), v.size());
  };
  bytes(atlas.reached_back);
  bytes(atlas.seen_charts);
  for (const std::vector<TexelTriangle>* sides : {&atlas.front, &atlas.back})
    for (const TexelTriangle& side : *sides) {
      put(out, static_cast<int32_t>(side.page));
      if (side.page < 0) continue;
      put(out, side.chart);
      put(out, side.uv);
      put(out, side.importance);
    }
  return out;
}

Atlas unpack_layout(std::string_view bytes, std::size_t triangles, const std::string& where) {
  Reader in{bytes};
  char magic[kMagic.size()] = {};
  Head head{};
  in.take(magic, sizeof magic);
  in.take(&head, sizeof head);
  if (std::string_view(magic, sizeof magic) == kEarlier)
    throw Error(where, "has the atlas of an earlier version", "a package that is baked anew");
  if (!in.whole || std::string_view(magic, sizeof magic) != kMagic || head.triangles != triangles ||
      head.charts > 2 * triangles || head.width < 1 || head.height < 1 || head.pages < 1)
    throw Error(where, "is not the layout of this scene");
  Atlas atlas;
  atlas.width = head.width, atlas.height = head.height, atlas.pages = head.pages;
  atlas.density = head.density;
  atlas.report.charts = head.charts;
  atlas.report.stretch_mean = head.stretch_mean, atlas.report.stretch_max = head.stretch_max;
  atlas.report.twins = head.twins;
  atlas.report.kept_uvs = head.kept_uvs != 0;
  atlas.reached_back.resize(triangles);
  atlas.seen_charts.resize(head.charts);
  in.take(atlas.reached_back.data(), triangles);
  in.take(atlas.seen_charts.data(), head.charts);
  for (std::vector<TexelTriangle>* sides : {&atlas.front, &atlas.back}) {
    sides->resize(triangles);
    for (TexelTriangle& side : *sides) {
      int32_t page = -1;
      in.take(&page, sizeof page);
      side.page = page;
      if (page < 0) continue;
      in.take(&side.chart, sizeof side.chart);
      in.take(&side.uv, sizeof side.uv);
      in.take(&side.importance, sizeof side.importance);
      in.whole &= page < head.pages && side.chart < head.charts;
    }
  }
  if (!in.whole || !in.left.empty()) throw Error(where, "is damaged");
  return atlas;
}

}  // namespace sconce
