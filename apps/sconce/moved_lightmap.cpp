// SPDX-License-Identifier: Apache-2.0
#include "moved_lightmap.h"

#include "core/error.h"
#include "gpu/lamp_light.h"
#include "stage.h"

namespace sconce::app {

MovedLightmap::MovedLightmap(std::shared_ptr<const Opened> opened, const Rearrangement& now,
                             const Progress& progress)
    : opened_(std::move(opened)) {
  if (!now.objects().empty()) {
    objects_ = std::make_unique<ObjectMover>(opened_, progress);
    objects_->place(now.objects());
    objects_->take(objects_->refined(progress));
    objects_->take(objects_->follow(now.objects(), progress));
  }
  if (now.places().empty() && !now.adds()) return;
  movable_ = objects_
                 ? std::make_shared<const Movable>(opened_, objects_->view(), *objects_->bounces(),
                                                   objects_->objects().atlas(), objects_->objects().texels())
                 : std::make_shared<const Movable>(opened_, progress);
  lamps_ = std::make_unique<LampMover>(
      movable_, [this](std::size_t lamp, const MovedLamp& state) { return other(lamp, state); });
  lamps_->follow(now.places());
  if (const std::string problem = lamps_->problem(); !problem.empty()) throw Error({}, problem);
  while (const auto task = lamps_->rough()) lamps_->refine(LampMover::light(*movable_, *task, progress));
  light_added(now, progress);
}

OtherLamp MovedLightmap::other(std::size_t lamp, const MovedLamp& state) {
  OtherKind made = become(movable_->lamps.all()[lamp], {state.at, state.target}, state.kind, state.kind);
  if (auto* lights = std::get_if<MoreLights>(&made)) return std::move(*lights);
  return prelit(std::move(std::get<gpu::LampShader>(made)));
}

PrelitLamp MovedLightmap::prelit(gpu::LampShader shader) {
  if (context_ == nullptr) {
    context_ = open_context("gl");
    geometry_ = std::make_unique<gpu::Geometry>(*context_, movable_->view.shown(), false);
  }
  gpu::LampLight light(*context_, *geometry_, movable_->view.world().bounds, std::move(shader));
  return {light.on_receivers(movable_->op, *movable_->bounces), {}};
}

void MovedLightmap::light_added(const Rearrangement& now, const Progress& progress) {
  if (!now.adds()) return;
  std::vector<Rgb> sum(movable_->op.places.size());
  const auto add = [&](const std::vector<Rgb>& light) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light[i];
  };
  if (!now.added().lights.empty()) add(movable_->light(movable_->alone(now.added()), true, progress));
  for (const Rearrangement::Shader& shader : now.shaders())
    if (shader.group == opened_->package.manifest().groups.size()) add(prelit(shader.lamp).light);
  added_ = to_pages(movable_->atlas, movable_->op, sum);
}

GroupedLight MovedLightmap::light() const {
  GroupedLight light = moved_light({lamps_.get(), objects_.get()}, layers_of(opened_));
  light.given = added_;
  return light;
}

}  // namespace sconce::app
