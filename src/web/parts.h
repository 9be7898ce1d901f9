// SPDX-License-Identifier: Apache-2.0
// Parts of a site, written one by one; each returns what sconce.json says of it.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "package/shown_scene.h"
#include "web/meter_points.h"
#include "web/site.h"

namespace sconce::web {

using Json = nlohmann::ordered_json;

inline Json json_of(const Rgb& c) {
  return {c.r, c.g, c.b};
}
/// Index, or -1.
template <class T>
Json json_of(Id<T> id) {
  return id.valid() ? static_cast<int64_t>(id.value) : -1;
}

/// Writes files, each name once, and counts.
class SiteFiles {
 public:
  explicit SiteFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// @return {"file": name, "bytes": of it}
  Json write(const std::string& name, const std::function<std::string()>& make);
  template <class T>
  Json write_packed(const std::string& name, const std::vector<T>& values, std::size_t numbers = 1) {
    return write_packed(name, std::as_bytes(std::span(values)), numbers * sizeof(T));
  }
  Json write_packed(const std::string& name, std::span<const std::byte> data, std::size_t element);
  std::size_t bytes() const { return bytes_; }

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::size_t> written_;  ///< bytes, by name
  std::size_t bytes_ = 0;
};

/// @param normal_maps  are seen: with what they need
Json write_geometry(SiteFiles& files, const ShownScene& shown, bool normal_maps);
Json write_materials(const Scene& scene, bool normal_maps);
Json write_textures(SiteFiles& files, const Scene& scene, bool normal_maps);
Json write_skies(SiteFiles& files, const Scene& scene);
/// Null where the package has none.
Json write_probes(SiteFiles& files, const Package& package);
Json write_meter(SiteFiles& files, const MeterPoints& points);
/// @param coefficients  of the basis that are shown
Json write_tier(SiteFiles& files, const Package& package, std::size_t coefficients, const ShaderTier& tier,
                const std::optional<EncodingChoice>& encoding);

}  // namespace sconce::web
