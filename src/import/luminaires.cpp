// SPDX-License-Identifier: Apache-2.0
#include "import/luminaires.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/text.h"
#include "photometry/formats.h"
#include "photometry/light_field_file.h"

namespace sconce {

namespace fs = std::filesystem;

namespace {

constexpr double kFarStep = 5;  // degrees of the far field that a light field also is

}  // namespace

Id<Luminaire> LuminaireFiles::load(const fs::path& file) {
  const auto found = known_.find(file);
  if (found != known_.end()) return found->second;
  const std::string name = file.filename().string();
  if (lower(file.extension().string()) == ".exr") {
    auto field = std::make_shared<LightField>(read_light_field(file));
    light_of(*field, file.string());
    Photometry far = far_field(NearLamp(*field), kFarStep);
    scene_.luminaires.push_back({name, std::move(far), std::move(field)});
    return known_[file] = Id<Luminaire>(scene_.luminaires.size() - 1);
  }
  Photometry photometry = read_photometry(file);
  for (const std::string& note : photometry.notes) progress_.warn(file.string() + ": " + note);
  return known_[file] = add(name, std::move(photometry));
}

Id<Luminaire> LuminaireFiles::add(const std::string& name, Photometry photometry) {
  scene_.luminaires.push_back({name, std::move(photometry)});
  return Id<Luminaire>(scene_.luminaires.size() - 1);
}

Light make_luminaire_light(const Scene& scene, Id<Luminaire> luminaire, const Mat4& frame,
                           const LuminaireStrength& strength, const std::string& where) {
  const Photometry& p = scene[luminaire].photometry;
  double factor = strength.dim;
  if (strength.flux) {
    const double table = flux(p);
    if (!(table > 0))
      throw Error(where, "asks for a flux, but " + scene[luminaire].name + " has no light at all");
    factor *= *strength.flux / table;
  }
  const Vec3 nadir = -Vec3(frame[2]);
  factor *=
      tilt_factor(p.tilt, glm::degrees(static_cast<double>(std::acos(std::clamp(-nadir.y, -1.0f, 1.0f)))));
  Light light;
  light.name = fs::path(scene[luminaire].name).stem().string();
  light.frame = frame;
  light.intensity = strength.color * static_cast<float>(factor);
  LuminaireLight shape{luminaire};
  if (strength.exact_below) {
    if (!scene[luminaire].field)
      throw Error(where, "asks for exact_below, but " + scene[luminaire].name + " is no light field");
    shape.exact_below = static_cast<float>(*strength.exact_below);
  }
  light.shape = shape;
  return light;
}

std::optional<fs::path> find_luminaire_file(const fs::path& folder, const std::string& name) {
  std::error_code ec;
  if (fs::is_regular_file(folder / name, ec)) return folder / name;
  const std::size_t dot = name.rfind('.');
  const bool counted = dot != std::string::npos && dot + 1 < name.size() &&
                       std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(),
                                   [](unsigned char c) { return std::isdigit(c) != 0; });
  if (counted && fs::is_regular_file(folder / name.substr(0, dot), ec)) return folder / name.substr(0, dot);
  return std::nullopt;
}

std::string luminaire_of_node_name(const std::string& name) {
  constexpr std::string_view kPrefix = "ies:";
  return name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : std::string();
}

}  // namespace sconce
