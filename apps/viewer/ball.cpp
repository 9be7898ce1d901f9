// SPDX-License-Identifier: Apache-2.0
// A ball in the light of the package's probes: what moves in an engine is lit so.
#include "core/error.h"
#include "tone/apply.h"
#include "viewer/viewer.h"

namespace sconce::viewer {

namespace {

constexpr float kAlbedo = 0.8f;
constexpr int kRings = 12, kSectors = 32;

}  // namespace

void Viewer::place_ball(const Vec3& middle, float radius) {
  if (!state_.opened->probes)
    throw Error(state_.package.string(), "has no probes, which light a ball", "sconce bake --probes 1");
  state_.ball = Ball{middle, radius};
}

void Viewer::ball_overlay(ImDrawList& draw, const Lens& from) const {
  if (!state_.ball || !state_.opened->probes) return;
  const auto& [middle, radius] = *state_.ball;
  const Mat4& frame = state_.camera.frame;
  const Vec3 eye(frame[3]), ahead = middle - eye;
  const float depth = -glm::dot(ahead, Vec3(frame[2])), way = glm::length(ahead);
  const auto spot = on_screen(from, middle);
  if (!spot || depth < radius || rays().tracer().occluded({eye, ahead / way, way - radius})) return;
  const MixSpec mix = state_.session->mix();
  const ProbeValue light = state_.opened->probes->mixed(middle, mix.weights);
  const Exposure exposure = state_.session->exposure(state_.canvas->metering());
  const ToneMapper& curve = find_tone_mapper(state_.session->mood().tone);
  const float pixels = 0.5f * state_.canvas_size.y / std::tan(0.5f * state_.camera.yfov) * radius / depth;
  const auto at = [&](int ring, float sector) {
    const float r = static_cast<float>(ring) / kRings, angle = 2 * kPi * sector / kSectors;
    return Vec2(r * std::cos(angle), r * std::sin(angle));
  };
  const auto place = [&](Vec2 p) { return ImVec2(spot->x + pixels * p.x, spot->y - pixels * p.y); };
  const ImDrawListFlags before = draw.Flags;
  draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // it would draw the edges of the pieces
  for (int ring = 0; ring < kRings; ++ring)
    for (int sector = 0; sector < kSectors; ++sector) {
      const auto s = static_cast<float>(sector);
      const Vec2 p = 0.5f * (at(ring, s + 0.5f) + at(ring + 1, s + 0.5f));
      const Vec3 n =
          p.x * Vec3(frame[0]) + p.y * Vec3(frame[1]) + std::sqrt(1 - glm::dot(p, p)) * Vec3(frame[2]);
      const Rgb e = facing(light, n);
      const Rgb c =
          tone_map(kAlbedo * kInvPi * Rgb(std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f)),
                   exposure, curve);
      const auto byte = [](float v) { return static_cast<int>(255 * v + 0.5f); };
      draw.AddQuadFilled(place(at(ring, s)), place(at(ring, s + 1)), place(at(ring + 1, s + 1)),
                         place(at(ring + 1, s)), IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255));
    }
  draw.Flags = before;
}

}  // namespace sconce::viewer
