// SPDX-License-Identifier: Apache-2.0
#include "light/near_field.h"

#include <cmath>

namespace sconce {

namespace {

/// Spacing of a coarser light field, in distances: joining moves light by half of it, 0.45 degrees.
constexpr double kCoarse = 1.0 / 64;
/// Share of exact samples that goes by the terms' flux: what arrives need not vanish where eq. 14 does.
constexpr double kByFlux = 0.1;

/// Calls f(term, weight of its filter at uv) for the filters that reach uv.
template <class F>
void each_filter(const LightField& field, const glm::dvec2& uv, const F& f) {
  const glm::dvec2 at = (uv - field.first) / field.spacing;
  const double reach = basis_reach(field.basis);
  const auto begin = [&](double x) { return std::max(0, static_cast<int>(std::ceil(x - reach))); };
  const auto end = [&](double x, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(x + reach)));
  };
  for (int n = begin(at.y); n <= end(at.y, field.rows); ++n)
    for (int m = begin(at.x); m <= end(at.x, field.columns); ++m)
      f(static_cast<std::size_t>(n) * static_cast<std::size_t>(field.columns) + static_cast<std::size_t>(m),
        basis_at(field.basis, at.x - m) * basis_at(field.basis, at.y - n));
}

glm::dvec2 center_of(const LightField& field, std::size_t term) {
  const auto columns = static_cast<std::size_t>(field.columns);
  return field.center(static_cast<int>(term % columns), static_cast<int>(term / columns));
}

glm::dvec2 in_filter(const LightField& field, std::size_t term, double u, double v) {
  return center_of(field, term) +
         field.spacing * glm::dvec2(basis_quantile(field.basis, u), basis_quantile(field.basis, v));
}

/// Picks one of `weights` by their absolute values and makes u uniform again. Positive ones come first: with
/// one step from sum to sum, low-discrepancy numbers meet both signs in their right shares.
std::size_t pick(std::span<const double> weights, double total, double& u) {
  double left = u * total;
  std::size_t last = 0;
  for (const double sign : {1.0, -1.0})
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double w = sign * weights[i];
      if (!(w > 0)) continue;
      last = i;
      if (left < w) {
        u = left / w;
        return i;
      }
      left -= w;
    }
  u = 0.5;  // rounding: beyond the last
  return last;
}

double absolute_sum(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += std::abs(v);
  return sum;
}

}  // namespace

NearField::NearField(const LightField& field) : flux_(sconce::flux(field)) {
  LightField level = field;
  for (;;) {
    std::vector<double> terms(level.terms());
    for (std::size_t i = 0; i < terms.size(); ++i) {
      for (const float v : level.image(i)) terms[i] += static_cast<double>(v);
      terms[i] = std::abs(terms[i]);
    }
    by_flux_.emplace_back(terms);
    levels_.emplace_back(level, field.spacing);
    if (level.terms() == 1) break;
    level = coarser(levels_.back());
  }
  std::vector<double> pixels(field.pixels());
  for (std::size_t i = 0; i < field.irradiance.size(); ++i)
    pixels[i % pixels.size()] += std::abs(static_cast<double>(field.irradiance[i]));
  absolute_ = absolute_sum(pixels) * field.pixel * field.pixel;
  pixels_ = AliasTable(pixels);
  const glm::dvec2 size(field.columns - 1, field.rows - 1);
  center_ = Vec3(Vec2(field.first + 0.5 * field.spacing * size), 0);
  radius_ = static_cast<float>(field.spacing *
                               (0.5 * glm::length(size) + basis_reach(field.basis) * std::sqrt(2.0)));
}

std::size_t NearField::level_index(const Vec3& x) const {
  const LightField& field = levels_.front().field();
  const glm::dvec3 point(x);
  const glm::dvec2 nearest =
      glm::clamp(glm::dvec2(point), field.first, field.center(field.columns - 1, field.rows - 1));
  const double distance = glm::length(point - glm::dvec3(nearest, 0));
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level + 1].field().spacing < kCoarse * distance) ++level;
  return level;
}

NearField::Sample NearField::sample(const Vec3& x, Vec2 where, double tolerance) const {
  const std::size_t level = level_index(x);
  const NearLamp& lamp = levels_[level];
  const LightField& field = lamp.field();
  std::vector<double> terms(field.terms());
  lamp.terms(x, terms);
  const double total = absolute_sum(terms);
  double u = static_cast<double>(where.x);
  if (lamp.bound(x, terms, levels_.front().field().spacing) <= tolerance) {
    if (!(total > 0)) return {};
    const std::size_t term = pick(terms, total, u);
    return {center_of(field, term), std::copysign(total, terms[term])};
  }
  const double by_flux = total > 0 ? kByFlux : 1;
  std::size_t term = 0;
  if (u < by_flux) {
    auto rest = static_cast<float>(u / by_flux);
    term = by_flux_[level].sample(rest);
    u = static_cast<double>(rest);
  } else {
    u = (u - by_flux) / (1 - by_flux);
    term = pick(terms, total, u);
  }
  const glm::dvec2 at = in_filter(field, term, u, static_cast<double>(where.y));
  double density = 0;
  each_filter(field, at, [&](std::size_t i, double weight) {
    density += weight * (by_flux * by_flux_[level].probability(i) +
                         (total > 0 ? (1 - by_flux) * std::abs(terms[i]) / total : 0));
  });
  density /= field.spacing * field.spacing;
  return {at, density > 0 ? levels_.front().from(at, x) / density : 0};
}

EmittedLight NearField::emit(Vec2 where, Vec2 whither) const {
  const LightField& field = levels_.front().field();
  const std::size_t pixel = pixels_.sample(where.x), width = static_cast<std::size_t>(field.width);
  const glm::dvec2 to =
      field.corner + field.pixel * (glm::dvec2(pixel % width, pixel / width) + glm::dvec2(where));
  std::vector<double> terms(field.terms());
  for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = static_cast<double>(field.image(i)[pixel]);
  double u = static_cast<double>(whither.x);
  const std::size_t term = pick(terms, absolute_sum(terms), u);
  const glm::dvec2 from = in_filter(field, term, u, static_cast<double>(whither.y));
  // Filters overlap: what they send from here together, over what was picked by their size.
  double sum = 0, picked = 0;
  each_filter(field, from, [&](std::size_t i, double weight) {
    sum += weight * terms[i];
    picked += weight * std::abs(terms[i]);
  });
  EmittedLight out;
  out.position = Vec3(Vec2(from), 0);
  out.direction = Vec3(glm::normalize(glm::dvec3(to - from, -field.distance)));
  out.flux = Rgb(static_cast<float>(picked > 0 ? absolute_ * sum / picked : 0));
  return out;
}

Lamp make_near_field(const Light& light, std::shared_ptr<const NearField> field, float exact_below) {
  NearFieldLamp lamp;
  lamp.position = Vec3(light.frame[3]);
  lamp.to_world = Mat3(light.frame);
  lamp.scale = light.intensity;
  lamp.exact_below = exact_below;
  const Rgb flux = light.intensity * static_cast<float>(field->flux());
  lamp.field = std::move(field);
  return {light.name, light.group, std::move(lamp), flux, false};
}

bool sample(const NearFieldLamp& lamp, const Vec3& x, Vec2 u, LightSample& out) {
  const Vec3 local = (x - lamp.position) * lamp.to_world;
  if (!(local.z < -1e-6f)) return false;
  const NearField::Sample sample = lamp.field->sample(local, u, static_cast<double>(lamp.exact_below));
  if (sample.lux == 0) return false;
  const Vec3 to = Vec3(Vec2(sample.at), 0) - local;
  const float d = glm::length(to);
  // Just short of it, as for openings.
  out = {lamp.to_world * (to / d), d * (1 - 1e-4f), lamp.scale * static_cast<float>(sample.lux), 1.0f, true};
  return true;
}

EmittedLight emit(const NearFieldLamp& lamp, Vec2 where, Vec2 whither) {
  EmittedLight out = lamp.field->emit(where, whither);
  out.position = lamp.position + lamp.to_world * out.position;
  out.direction = lamp.to_world * out.direction;
  out.flux = lamp.scale * out.flux.r;
  return out;
}

}  // namespace sconce
