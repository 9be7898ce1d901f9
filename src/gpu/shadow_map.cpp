// SPDX-License-Identifier: Apache-2.0
#include "gpu/shadow_map.h"

#include "gpu/framebuffer.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kVertex =
#include "gpu/shadow_vertex.glsl.h"
    ;
constexpr std::string_view kFragment =
#include "gpu/shadow_fragment.glsl.h"
    ;
constexpr float kMargin = 3;  // texels around what is looked up, for the filter

}  // namespace

ShadowMap::ShadowMap(const Context& context, const LampShader& lamp, const Bounds& bounds)
    : side_(lamp.side), eye_(Vec3(lamp.frame[3])), near_(1e-4f * bounds.diagonal()) {
  const Vec3 right(lamp.frame[0]), up(lamp.frame[1]), back(lamp.frame[2]);
  switch (lamp.shadow) {
    case LampShader::Shadow::none:
      break;
    case LampShader::Shadow::map:
      views_ = {perspective(right, up, -back, std::tan(lamp.opening / 2))};
      break;
    case LampShader::Shadow::cube:
      for (const auto& [axis, other] : {std::pair(right, up), std::pair(up, back), std::pair(back, right)})
        for (const float sign : {1.0f, -1.0f})
          views_.push_back(perspective(other, glm::cross(axis, other), sign * axis, 1));
      break;
    case LampShader::Shadow::sun:
      parallel_ = true;
      views_ = {fitted(lamp.frame, bounds)};
      break;
  }
  if (!views_.empty())
    depths_.emplace(context,
                    TextureParams{.format = GL_DEPTH_COMPONENT32F,
                                  .width = side_,
                                  .height = side_,
                                  .layers = static_cast<int>(views_.size()),
                                  .filter = GL_NEAREST},
                    "shadow map of " + lamp.file);
}

ShadowMap::Projection ShadowMap::perspective(const Vec3& right, const Vec3& up, const Vec3& forward,
                                             float tangent) const {
  const float half = 0.5f * static_cast<float>(side_), scale = (half - kMargin) / tangent;
  return {glm::transpose(Mat3(half * forward + scale * right, half * forward + scale * up, forward))};
}

ShadowMap::Projection ShadowMap::fitted(const Mat4& frame, const Bounds& bounds) {
  const Mat3 axes(frame);
  Bounds box;  // of the scene as the light has it
  for (int corner = 0; corner < 8; ++corner)
    box.add(Vec3((corner & 1) != 0 ? bounds.hi.x : bounds.lo.x, (corner & 2) != 0 ? bounds.hi.y : bounds.lo.y,
                 (corner & 4) != 0 ? bounds.hi.z : bounds.lo.z) *
            axes);
  const float loose = 1e-3f * bounds.diagonal();
  const Vec3 size = box.hi - box.lo + 2 * loose;
  const auto side = static_cast<float>(side_);
  const Vec2 scale = (side - 2 * kMargin) / Vec2(size);
  // Depth is 0 at the far end, where z of the frame is least.
  eye_ = axes * (box.lo - loose - Vec3(kMargin / scale, 0));
  return {glm::transpose(Mat3(scale.x * axes[0], scale.y * axes[1], axes[2] / size.z))};
}

void ShadowMap::draw(const Geometry& geometry, const Program& shader) const {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  shader.use();
  shader.set("eye", eye_);
  shader.set("size", static_cast<float>(side_));
  shader.set("near", near_);
  shader.set("parallel", parallel_ ? 1 : 0);
  for (std::size_t view = 0; view < views_.size(); ++view) {
    const Framebuffer target(Framebuffer::DepthOnly{}, *depths_, static_cast<int>(view));
    target.use();
    target.clear();
    shader.set("to_plane", views_[view].to_plane);
    geometry.draw_shapes(shader);
  }
  glDisable(GL_DEPTH_TEST);
}

void ShadowMap::bind(const Program& lamp, int unit) const {
  lamp.set("sconce_views", static_cast<int>(views_.size()));
  lamp.set("sconce_parallel", parallel_ ? 1 : 0);
  lamp.set("sconce_shadow", unit);  // always: two kinds of samplers on one unit draw nothing
  if (views_.empty()) return;
  std::vector<Mat3> to, from;
  for (const Projection& view : views_) to.push_back(view.to_plane), from.push_back(view.from_plane());
  lamp.set("sconce_eye", eye_);
  lamp.set("sconce_near", near_);
  lamp.set("sconce_to_plane", to);
  lamp.set("sconce_from_plane", from);
  depths_->bind(unit);
}

Program shadow_program() {
  return Program("shadow map", kVertex, kFragment);
}

}  // namespace sconce::gpu
