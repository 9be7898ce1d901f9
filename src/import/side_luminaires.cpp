// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "core/kelvin.h"
#include "import/luminaires.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

/// Straight down with C0 towards +x, turned by the shortest way to `direction`, then by `roll` about it,
/// counter-clockwise as seen by who looks up into the lamp's back: C0 moves towards C90.
Mat4 hanging(const Vec3& at, const Vec3& direction, float roll) {
  const Vec3 down(0, -1, 0), nadir = normalize_or(direction, down);
  Vec3 c0(1, 0, 0);
  const float cosine = glm::dot(down, nadir);
  if (cosine > -0.99999f) {
    // Rodrigues' formula for the rotation that takes `down` to `nadir`.
    const Vec3 axis = glm::cross(down, nadir);
    c0 = c0 + glm::cross(axis, c0) + glm::cross(axis, glm::cross(axis, c0)) / (1 + cosine);
  }
  const Vec3 z = -nadir, c90 = glm::cross(z, c0);
  Mat4 out(1.0f);
  out[0] = glm::vec4(std::cos(roll) * c0 + std::sin(roll) * c90, 0);
  out[1] = glm::vec4(std::cos(roll) * c90 - std::sin(roll) * c0, 0);
  out[2] = glm::vec4(z, 0);
  out[3] = glm::vec4(at, 1);
  return out;
}

LuminaireStrength strength_of(const SideTable& table) {
  LuminaireStrength out;
  out.flux = table.not_negative("flux");
  out.dim = table.not_negative("dim").value_or(1);
  out.exact_below = table.not_negative("exact_below");
  if (table.has("cct") && table.has("color")) table.fail("cct", "stands beside color", "one of the two");
  if (const auto cct = table.number("cct")) {
    if (*cct < kKelvinMin || *cct > kKelvinMax) table.fail("cct", "is out of range", "1000 to 11000");
    out.color = kelvin_color(*cct);
  }
  if (const auto color = table.lamp_color()) out.color = *color;
  return out;
}

/// Places of a grid of count[0] x count[1] along x and z, pitch metres apart, centred at `at`.
std::vector<Vec3> grid(const SideTable& table, const Vec3& at) {
  const auto count = table.pair("count");
  const auto pitch = table.pair("pitch");
  if (!count && pitch) table.fail("pitch", "stands without count", "count = [columns along x, rows along z]");
  if (!count) return {at};
  constexpr int kMost = 10000;
  const std::array<int, 2> n{static_cast<int>((*count)[0]), static_cast<int>((*count)[1])};
  for (std::size_t i = 0; i < 2; ++i)
    if (n[i] < 1 || n[i] > kMost || n[i] != (*count)[i])
      table.fail("count", "is no pair of whole numbers", "[columns along x, rows along z], each 1 to 10000");
  if (n[0] > kMost / n[1]) table.fail("count", "makes more than 10000 luminaires");
  if (!pitch && n[0] * n[1] > 1)
    table.fail("count", "stands without pitch", "pitch = [metres along x, metres along z]");
  std::vector<Vec3> out;
  for (int row = 0; row < n[1]; ++row)
    for (int column = 0; column < n[0]; ++column)
      out.push_back(at + Vec3(static_cast<float>((pitch ? (*pitch)[0] : 0) * (column - 0.5 * (n[0] - 1))), 0,
                              static_cast<float>((pitch ? (*pitch)[1] : 0) * (row - 0.5 * (n[1] - 1)))));
  return out;
}

}  // namespace

void apply_luminaire(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[[luminaire]]", node,
                        {"file", "name", "at", "aim", "direction", "roll", "group", "flux", "cct", "color",
                         "dim", "count", "pitch", "exact_below"});
  const auto file = table.text("file");
  if (!file) table.fail({}, "has no file", "file = an .ies, .ldt or light field (.exr) beside this one");
  const auto at = table.vector("at");
  if (!at) table.fail({}, "has no place", "at = [x, y, z] in metres");
  if (table.has("aim") && table.has("direction"))
    table.fail("direction", "stands beside aim", "one of the two");
  LuminaireFiles files(context.scene, context.progress);
  Id<Luminaire> luminaire;
  try {
    luminaire = files.load(context.path.parent_path() / *file);
  } catch (const Error& e) {
    table.fail("file", e.what());
  }
  const LuminaireStrength strength = strength_of(table);
  const float roll = glm::radians(static_cast<float>(table.number("roll").value_or(0)));
  const Vec3 direction = table.vector("direction").value_or(Vec3(0, -1, 0));
  const auto aim = table.vector("aim");
  const std::vector<Vec3> places = grid(table, *at);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 towards = aim ? *aim - places[i] : direction;
    if (!(glm::length(towards) > 0)) table.fail(aim ? "aim" : "direction", "has no length");
    Light light = make_luminaire_light(context.scene, luminaire, hanging(places[i], towards, roll), strength,
                                       table.where(strength.flux ? "flux" : "exact_below"));
    light.name = table.text("name").value_or(light.name);
    if (places.size() > 1) light.name += fmt::format(".{:03}", i + 1);
    light.group_name = table.text("group").value_or("");
    context.scene.lights.push_back(std::move(light));
  }
}

}  // namespace sconce
