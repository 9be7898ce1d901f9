// SPDX-License-Identifier: Apache-2.0
#include "picture_options.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "picture/gloss.h"
#include "shader/composer.h"

namespace sconce::app {

namespace {

constexpr int kMaxSide = 16384, kDefaultWidth = 1280, kMaxSamples = 1 << 16;

int parse_side(const std::string& text, const std::string& whole) {
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value >= 1 && *value <= kMaxSide) || *value != std::floor(*value))
    throw UsageError("option '--size'", "'" + whole + "' is no size",
                     fmt::format("WIDTHxHEIGHT or WIDTH, 1 to {} pixels", kMaxSide));
  return static_cast<int>(*value);
}

}  // namespace

PictureSize parse_size(const std::string& text) {
  const std::vector<std::string> sides = split(lower(text), 'x');
  if (sides.size() > 2) parse_side("", text);
  return {parse_side(sides[0], text), sides.size() == 2 ? parse_side(sides[1], text) : 0};
}

Vec3 parse_point(const std::string& text, const std::string& option) {
  const std::vector<std::string> parts = split(text, ',');
  Vec3 point(0);
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value =
        parts.size() == 3 ? parse_number(trim(parts[static_cast<std::size_t>(i)])) : std::nullopt;
    if (!value || !(std::abs(*value) < 1e9))
      throw UsageError("option '" + option + "'", "'" + text + "' is no point", "X,Y,Z in metres");
    point[i] = static_cast<float>(*value);
  }
  return point;
}

void PictureOptions::declare(Options& options) {
  options.option("--camera", &camera, "camera of the scene (default: the first)");
  options.option("--eye", &eye, "X,Y,Z in metres: look from here, with --target");
  options.option("--target", &target, "X,Y,Z in metres: look at this");
  options.option("--fov", &fov, "vertical field of view in degrees (default: the camera's)");
  options.option("--size", &size, "WIDTHxHEIGHT, or WIDTH at the camera's aspect (default: 1280)");
  options.option("--samples", &samples, "per pixel; 1 looks at pixel centres");
  options.flag("--no-reflections", &no_reflections,
               "no reflections are followed: metals are as if matt, gloss shows nothing, as OpenGL draws");
  tone.declare(options);
  options.option(
      "--device", &device,
      "auto, cpu, gl (OpenGL), software (as hardware without shaders would: an 8-bit lightmap, "
      "tone mapped before the texture); auto draws by OpenGL where there is a graphics device and nothing in "
      "the scene mirrors");
  options.option(
      "--tier", &tier,
      "what OpenGL's textures may be: auto, full, half, unfiltered, byte; for trying lesser devices");
}

void PictureOptions::apply(const Preset& preset) {
  if (camera.empty() && eye.empty()) camera = preset.camera;
  tone.apply(preset);
}

void PictureOptions::check() const {
  if (eye.empty() != target.empty())
    throw UsageError({}, eye.empty() ? "--target needs --eye" : "--eye needs --target");
  if (!eye.empty() && !camera.empty()) throw UsageError({}, "--camera and --eye exclude each other");
  if (!eye.empty()) look_at(parse_point(eye, "--eye"), parse_point(target, "--target"));
  if (fov != 0 && !(fov >= 0.1 && fov <= 179))
    throw UsageError("option '--fov'", fmt::format("{:g} degrees", fov), "0.1 to 179");
  if (!size.empty()) parse_size(size);
  if (samples < 1 || samples > kMaxSamples)
    throw UsageError("option '--samples'", fmt::format("{} samples", samples),
                     fmt::format("1 to {}", kMaxSamples));
  tone.check();
  if (device != "auto" && device != "cpu" && device != "gl" && device != "software")
    throw UsageError("option '--device'", "unknown device '" + device + "'", "auto, cpu, gl, software");
  if (tier != "auto") {
    find_shader_tier(tier);
    if (device == "cpu" || device == "software") throw UsageError({}, "--tier needs --device gl");
  }
}

Camera PictureOptions::find_camera(const Scene& scene, const std::function<Camera()>& otherwise) const {
  Camera found;
  if (!eye.empty())
    found = look_at(parse_point(eye, "--eye"), parse_point(target, "--target"));
  else if (const Camera* named = sconce::find_camera(scene, camera))
    found = *named;
  else
    found = otherwise();
  if (fov != 0) found.yfov = static_cast<float>(fov * static_cast<double>(kPi) / 180);
  return found;
}

PictureParams PictureOptions::params(const Camera& found) const {
  const PictureSize wanted = size.empty() ? PictureSize{kDefaultWidth, 0} : parse_size(size);
  const float aspect = found.aspect > 0 && std::isfinite(found.aspect) ? found.aspect : Camera{}.aspect;
  PictureParams out;
  out.width = wanted.width;
  const float height = std::round(static_cast<float>(wanted.width) / aspect);
  out.height =
      wanted.height > 0 ? wanted.height : static_cast<int>(std::clamp(height, 1.0f, float{kMaxSide}));
  out.samples = samples;
  out.reflections = no_reflections ? 0 : kReflections;
  return out;
}

}  // namespace sconce::app
