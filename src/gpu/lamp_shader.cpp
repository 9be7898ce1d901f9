// SPDX-License-Identifier: Apache-2.0
#include "gpu/lamp_shader.h"

#include "core/error.h"
#include "core/sobol.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kPoint =
#include "lights/point.glsl.h"
    ;
constexpr std::string_view kSpot =
#include "lights/spot.glsl.h"
    ;
constexpr std::string_view kSun =
#include "lights/sun.glsl.h"
    ;
constexpr std::string_view kProjector =
#include "lights/projector.glsl.h"
    ;
constexpr std::string_view kPatch =
#include "lights/patch.glsl.h"
    ;
constexpr std::string_view kLuminaire =
#include "gpu/luminaire.glsl.h"
    ;
constexpr float kWidestMap = 120 * kPi / 180;  // wider cones take cubes
constexpr uint32_t kPatchStream = 0x70617463u;

Mat4 placed(const Vec3& position, const Mat3& to_world) {
  Mat4 out(to_world);
  out[3] = glm::vec4(position, 1);
  return out;
}

Mat4 looking_along(const Vec3& position, const Vec3& axis) {
  const Frame frame(-axis);
  return placed(position, Mat3(frame.x, frame.y, frame.z));
}

float degrees(float cosine) {
  return std::acos(std::clamp(cosine, -1.0f, 1.0f)) * 180 / kPi;
}

/// As luminaire.glsl looks it up.
std::shared_ptr<const Image> table_of(const Photometry& photometry) {
  constexpr int kColumns = 145, kRows = 361;  // 2.5 and 0.5 degrees apart
  auto out = std::make_shared<Image>(Image::rgb(kColumns, kRows));
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const Vec3 direction = direction_of(Photometry::Type::c, 2.5 * x, 0.5 * y);
      out->set_rgb(x, y, Rgb(static_cast<float>(intensity(photometry, direction))));
    }
  return out;
}

LampShader shader(const Lamp& lamp, std::string_view text, const Mat4& frame, const Rgb& intensity) {
  LampShader out;
  out.name = lamp.name, out.file = "lamp '" + lamp.name + "'", out.text = text;
  out.frame = frame, out.intensity = intensity;
  return out;
}

/// What each kind becomes.
struct Maker {
  const Lamps& lamps;
  std::size_t number;
  Rgb weight;
  int patches, side;
  std::vector<LampShader>& out;

  const Lamp& lamp() const { return lamps.all()[number]; }

  void operator()(const PunctualLamp& p) const {
    const bool spot = p.cos_outer > -1;
    LampShader made =
        shader(lamp(), spot ? kSpot : kPoint, looking_along(p.position, p.axis), weight * p.intensity);
    made.uniforms = {{"range", {p.range}}};
    if (spot) {
      made.uniforms.push_back({"inner", {degrees(p.cos_inner)}});
      made.uniforms.push_back({"outer", {degrees(p.cos_outer)}});
      made.opening = 2 * std::acos(p.cos_outer);
      if (made.opening <= kWidestMap) made.shadow = LampShader::Shadow::map;
    }
    made.side = side;
    out.push_back(std::move(made));
  }
  void operator()(const ProjectorLamp& p) const {
    // Which way is up counts.
    LampShader made = shader(lamp(), kProjector, placed(p.position, p.to_world), weight * p.intensity);
    made.uniforms = {{"slide", {}, {}, p.slide},
                     {"fov", {2 * std::atan(p.half.y) * 180 / kPi}},
                     {"aspect", {p.half.x / p.half.y}}};
    made.opening = 2 * std::atan(glm::length(p.half));
    if (made.opening <= kWidestMap) made.shadow = LampShader::Shadow::map;
    made.side = side;
    out.push_back(std::move(made));
  }
  void operator()(const SunLamp& s) const {
    out.push_back(shader(lamp(), kSun, looking_along(Vec3(0), -s.direction), weight * s.illuminance));
    out.back().shadow = LampShader::Shadow::sun;
    out.back().side = side;
  }
  void operator()(const MeshLamp& mesh) const {
    for (int i = 0; i < patches; ++i) {
      const auto index = static_cast<uint32_t>(i),
                 stream = mix32(kPatchStream, static_cast<uint32_t>(number));
      const EmittedLight from = lamps.emit(number, sobol_pair(index, 0, stream), Vec2(0));
      // A lamp of two sides has such a patch on either.
      for (const float facing : {1.0f, -1.0f}) {
        if (facing < 0 && !mesh.two_sided) continue;
        const Rgb candela = weight * from.flux * (kInvPi / static_cast<float>(patches));
        out.push_back(shader(lamp(), kPatch, looking_along(from.position, facing * from.normal),
                             mesh.two_sided ? candela * 0.5f : candela));
        out.back().side = std::max(64, side / 4);
      }
    }
  }
  void operator()(const SkyLamp&) const {
    throw UnknownLamp("lamp '" + lamp().name + "'", "is a sky, which OpenGL does not move", "--device cpu");
  }
  /// Points of the opening.
  void operator()(const LuminaireLamp& l) const {
    const auto table = table_of(*l.table);
    const int points = l.table->opening.is_point() ? 1 : patches;
    for (int i = 0; i < points; ++i) {
      const auto index = static_cast<uint32_t>(i),
                 stream = mix32(kPatchStream, static_cast<uint32_t>(number));
      const EmittedLight from =
          lamps.emit(number, sobol_pair(index, 0, stream), sobol_pair(index, 1, stream));
      out.push_back(shader(lamp(), kLuminaire, placed(from.position, l.to_world),
                           weight * l.scale / static_cast<float>(points)));
      out.back().uniforms = {{"table", {}, {}, table}};
      out.back().side = points == 1 ? side : std::max(64, side / 4);
    }
  }
  void operator()(const NearFieldLamp&) const {}  // NearLights
};

}  // namespace

std::vector<LampShader> lamp_shaders(const Lamps& lamps, std::span<const std::pair<std::size_t, Rgb>> chosen,
                                     int patches, int side) {
  std::vector<LampShader> out;
  for (const auto& [number, weight] : chosen)
    std::visit(Maker{lamps, number, weight, patches, side, out}, lamps.all()[number].shape);
  return out;
}

}  // namespace sconce::gpu
