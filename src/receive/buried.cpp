// SPDX-License-Identifier: Apache-2.0
#include "receive/buried.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/sobol.h"
#include "receive/parameterize.h"

namespace sconce {

namespace {

constexpr uint32_t kPoints = 4, kRaysPerPoint = 3;  // first look
constexpr uint32_t kRaysPerCell = 8, kRaysToAcquit = 32;
constexpr float kNear = 0.1f;           // of a texel: gaps this narrow take no light that a texel could show
constexpr float kNearSuspicion = 0.7f;  // a wall beside a point takes half of its rays and does not bury it
constexpr float kBuried = 0.5f;
constexpr float kOddRays = 1.5f;  // of the first look: a stray ray through a crack is no reason for a second

}  // namespace

TexelRect texel_rect(const Atlas& atlas, uint32_t texel) {
  const auto width = static_cast<uint32_t>(atlas.width), height = static_cast<uint32_t>(atlas.height);
  const uint32_t in_page = texel % (width * height);
  const Vec2 lo(static_cast<float>(in_page % width), static_cast<float>(in_page / width));
  return {lo, lo + Vec2(1)};
}

TexelRect cell_rect(const TexelRect& texel, int cell) {
  constexpr float kStep = 1.0f / kCells;
  const Vec2 lo =
      texel.lo + kStep * Vec2(static_cast<float>(cell % kCells), static_cast<float>(cell / kCells));
  return {lo, lo + Vec2(kStep)};
}

float BurialTest::texel_length(uint32_t side) const {
  const TexelTriangle& t = side_of(atlas_, side);
  return std::sqrt(world_.area(side / 2) / std::max(std::abs(signed_area(t.uv)), 1e-6f));
}

float BurialTest::suspicion(const SurfacePoint& point, Vec2 u, float near) const {
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  const Vec3 direction = glm::normalize(
      Frame(point.geometric_normal).to_world(Vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x))));
  const Hit hit =
      tracer_.closest({offset_origin(point.position, point.geometric_normal, direction), direction});
  if (!hit) return 0;
  if (hit.back && atlas_.reached_back[hit.triangle] == 0 && !(tracer_.passing(hit).share() > 0)) return 1;
  return hit.distance < near ? kNearSuspicion : 0.0f;
}

bool BurialTest::clearly_free(uint32_t texel, std::span<const uint32_t> sides) const {
  Footprint footprint;
  clip_to_rect(world_, atlas_, sides, texel_rect(atlas_, texel), footprint.pieces);
  if (footprint.pieces.empty()) footprint.pieces.push_back(whole_side(world_, sides.front()));
  finish(footprint.pieces);
  const float near = kNear * texel_length(sides.front());
  const uint32_t stream = mix32(texel, 0x62757279u);
  float sum = 0;
  for (uint32_t p = 0; p < kPoints && sum < kOddRays; ++p) {
    const SurfacePoint point = footprint.sample(sobol_pair(p, 0, stream));
    for (uint32_t r = 0; r < kRaysPerPoint; ++r)
      sum += suspicion(point, sobol_pair(p * kRaysPerPoint + r, 1, stream), near);
  }
  return sum < kOddRays;
}

bool BurialTest::buried(const Footprint& part, float near, uint32_t stream, uint32_t rays) const {
  const float limit = kBuried * static_cast<float>(rays);
  float sum = 0;
  for (uint32_t r = 0; r < rays; ++r) {
    // Decided as soon as the rays still to come cannot change it, or hardly.
    if (sum > limit) return true;
    if (r == rays / 2 && sum <= 0.125f * limit) return false;
    sum += suspicion(part.sample(sobol_pair(r, 0, stream)), sobol_pair(r, 1, stream), near);
  }
  return sum > limit;
}

uint16_t BurialTest::free_cells(uint32_t texel, std::span<const uint32_t> sides) const {
  const TexelRect rect = texel_rect(atlas_, texel);
  const float near = kNear * texel_length(sides.front());
  std::array<Footprint, kCells * kCells> parts;
  uint16_t covered = 0, free = 0;
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    Footprint& part = parts[static_cast<std::size_t>(cell)];
    clip_to_rect(world_, atlas_, sides, cell_rect(rect, cell), part.pieces);
    part.area = finish(part.pieces);
    if (part.area > 0) covered |= static_cast<uint16_t>(1u << cell);
  }
  if (covered == 0) {
    parts[0].pieces.assign(1, whole_side(world_, sides.front()));
    finish(parts[0].pieces);
    return buried(parts[0], near, mix32(texel, 0x63656c6cu), kRaysToAcquit) ? 0 : kAllCells;
  }
  const auto look = [&](uint16_t cells, uint32_t salt, uint32_t rays) {
    uint16_t result = 0;
    for (int cell = 0; cell < kCells * kCells; ++cell) {
      const auto bit = static_cast<uint16_t>(1u << cell);
      if ((cells & bit) == 0) continue;
      const uint32_t stream = mix32(texel, salt + static_cast<uint32_t>(cell));
      if (!buried(parts[static_cast<std::size_t>(cell)], near, stream, rays)) result |= bit;
    }
    return result;
  };
  free = look(covered, 0x63656c6cu, kRaysPerCell);
  // Where most is buried, a cell that seems free by luck would be a black texel at a contact.
  if (2 * std::popcount(free) < std::popcount(covered)) free = look(free, 0x66726565u, kRaysToAcquit);
  if (free == covered) return kAllCells;
  return free;
}

}  // namespace sconce
