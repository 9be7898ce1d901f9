// SPDX-License-Identifier: Apache-2.0
#include "gpu/direct_light.h"

#include <algorithm>

namespace sconce::gpu {

namespace {

constexpr std::size_t kPoints = 64;  // of a group of gpu/lamp_points.glsl
constexpr GLuint kMishaps = 7;       // gpu/lamp_arriving.glsl
constexpr int kShadowUnit = SeenSurfaces::kUnits;
constexpr std::array<uint32_t, 2> kNone{0, 0xffffffffu};

}  // namespace

struct DirectLight::Lamp {
  Lamp(const Context& context, LampShader shader_, const LampProgram& program_, const Bounds& bounds)
      : shader(std::move(shader_)),
        program(&program_),
        values(context, shader, program_),
        shadow(context, shader, bounds) {}

  void use(const Program& with) const {
    with.use();
    shadow.bind(with, kShadowUnit);
    values.bind(shader, with, kShadowUnit + 1);
  }

  LampShader shader;
  const LampProgram* program;
  LampValues values;
  ShadowMap shadow;
  Mishap cloud, pixels;
};

DirectLight::DirectLight(const Context& context, const Geometry& geometry, const Bounds& bounds,
                         std::vector<LampShader> lamps)
    : context_(&context), mishaps_(context, sizeof kNone, nullptr, "mishaps") {
  const Program shapes = shadow_program();
  for (LampShader& lamp : lamps) {
    std::unique_ptr<LampProgram>& program = programs_[lamp.text];
    if (program == nullptr) program = std::make_unique<LampProgram>(lamp.file, lamp.text);
    lamps_.push_back(std::make_unique<Lamp>(context, std::move(lamp), *program, bounds));
    lamps_.back()->shadow.draw(geometry, shapes);
    context.check("drawing the shadow maps of " + lamps_.back()->shader.file);
  }
}

DirectLight::~DirectLight() = default;

void DirectLight::start_count() const {
  mishaps_.write(sizeof kNone, kNone.data());
  mishaps_.bind(kMishaps);
}

void DirectLight::count(Mishap* mishap) const {
  std::array<uint32_t, 2> seen{};
  mishaps_.read(sizeof seen, seen.data());
  if (seen[0] == 0) return;
  mishap->first = mishap->count == 0 ? seen[1] : std::min(mishap->first, seen[1]);
  mishap->count += seen[0];
}

void DirectLight::light_cloud(const Buffer& points, uint32_t slots, uint32_t points_per_slot,
                              const Buffer& exitance) {
  exitance.clear();
  for (const auto& lamp : lamps_) {
    const Program& program = lamp->program->points();
    start_count();
    lamp->use(program);
    program.set("sconce_slots", slots);
    program.set("sconce_per_slot", points_per_slot);
    points.bind(0);
    exitance.bind(1);
    dispatch((slots + kPoints - 1) / kPoints);
    buffers_written();
    lamp->cloud = {};
    count(&lamp->cloud);
  }
  context_->check("lighting the cloud");
}

void DirectLight::add(const SeenSurfaces& seen, const Texture& picture) {
  for (const auto& lamp : lamps_) {
    start_count();
    lamp->use(lamp->program->pixels());
    seen.shade(lamp->program->pixels(), picture);
    count(&lamp->pixels);
  }
  context_->check("lighting the picture");
}

std::vector<DirectLight::Report> DirectLight::mishaps() const {
  std::vector<Report> out;
  for (const auto& lamp : lamps_)
    if (lamp->cloud.count + lamp->pixels.count > 0)
      out.push_back({lamp->shader.file, lamp->cloud, lamp->pixels});
  return out;
}

}  // namespace sconce::gpu
