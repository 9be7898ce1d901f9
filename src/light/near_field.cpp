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

/// What every channel of a light field has of something, [channel][i].
using Channels = std::vector<std::vector<double>>;

/// What terms are picked by: the value of a grey light field, the sum of the absolute ones of colours. The
/// sign of the former stays, for pick().
std::vector<double> weights_of(const Channels& values) {
  if (values.size() == 1) return values.front();
  std::vector<double> out(values.front().size());
  for (const std::vector<double>& channel : values)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += std::abs(channel[i]);
  return out;
}

/// Red, green and blue; the same thrice where there is one channel.
template <class Value>
Rgb rgb(std::size_t channels, const Value& value) {
  const auto at = [&](std::size_t c) { return static_cast<float>(value(c)); };
  return channels == 1 ? Rgb(at(0)) : Rgb(at(0), at(1), at(2));
}

}  // namespace

NearField::NearField(const LightField& field) {
  std::vector<LightField> channels;
  if (field.is_grey()) channels.push_back(field);
  for (int c = 0; c < 3 && !field.is_grey(); ++c) channels.push_back(channel_of(field, c));
  flux_ = rgb(channels.size(), [&](std::size_t c) { return sconce::flux(channels[c]); });
  std::vector<double> pixels(field.pixels());
  for (const LightField& channel : channels)
    for (std::size_t i = 0; i < channel.irradiance.size(); ++i)
      pixels[i % pixels.size()] += std::abs(static_cast<double>(channel.irradiance[i]));
  absolute_ = absolute_sum(pixels) * field.pixel * field.pixel;
  pixels_ = AliasTable(pixels);
  for (;;) {
    std::vector<double> terms(channels.front().terms());
    Level& level = levels_.emplace_back();
    for (const LightField& channel : channels) {
      for (std::size_t i = 0; i < terms.size(); ++i) {
        double sum = 0;
        for (const float v : channel.image(i)) sum += static_cast<double>(v);
        terms[i] += std::abs(sum);
      }
      level.channels.emplace_back(channel, field.spacing);
    }
    level.by_flux = AliasTable(terms);
    if (terms.size() == 1) break;
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c] = coarser(level.channels[c]);
  }
  const glm::dvec2 size(field.columns - 1, field.rows - 1);
  center_ = Vec3(Vec2(field.first + 0.5 * field.spacing * size), 0);
  radius_ = static_cast<float>(field.spacing *
                               (0.5 * glm::length(size) + basis_reach(field.basis) * std::sqrt(2.0)));
}

std::size_t NearField::level_index(const Vec3& x) const {
  const LightField& field = finest().field();
  const glm::dvec3 point(x);
  const glm::dvec2 nearest =
      glm::clamp(glm::dvec2(point), field.first, field.center(field.columns - 1, field.rows - 1));
  const double distance = glm::length(point - glm::dvec3(nearest, 0));
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         levels_[level + 1].channels.front().field().spacing < kCoarse * distance)
    ++level;
  return level;
}

NearField::Sample NearField::sample(const Vec3& x, Vec2 where, double tolerance) const {
  const Level& level = levels_[level_index(x)];
  const NearLamp& lamp = level.channels.front();
  const LightField& field = lamp.field();
  Channels values(channels(), std::vector<double>(field.terms()));
  for (std::size_t c = 0; c < values.size(); ++c) level.channels[c].terms(x, values[c]);
  const std::vector<double> terms = weights_of(values);
  const double total = absolute_sum(terms);
  double u = static_cast<double>(where.x);
  if (lamp.bound(x, terms, finest().field().spacing) <= tolerance) {
    if (!(total > 0)) return {};
    const std::size_t term = pick(terms, total, u);
    return {center_of(field, term), rgb(channels(), [&](std::size_t c) {
              return values[c][term] * (total / std::abs(terms[term]));
            })};
  }
  const double by_flux = total > 0 ? kByFlux : 1;
  std::size_t term = 0;
  if (u < by_flux) {
    auto rest = static_cast<float>(u / by_flux);
    term = level.by_flux.sample(rest);
    u = static_cast<double>(rest);
  } else {
    u = (u - by_flux) / (1 - by_flux);
    term = pick(terms, total, u);
  }
  const glm::dvec2 at = in_filter(field, term, u, static_cast<double>(where.y));
  double density = 0;
  each_filter(field, at, [&](std::size_t i, double weight) {
    density += weight * (by_flux * level.by_flux.probability(i) +
                         (total > 0 ? (1 - by_flux) * std::abs(terms[i]) / total : 0));
  });
  density /= field.spacing * field.spacing;
  if (!(density > 0)) return {at, Rgb(0)};
  return {at, rgb(channels(), [&](std::size_t c) { return channel(c).from(at, x) / density; })};
}

EmittedLight NearField::emit(Vec2 where, Vec2 whither) const {
  const LightField& field = finest().field();
  const std::size_t pixel = pixels_.sample(where.x), width = static_cast<std::size_t>(field.width);
  const glm::dvec2 to =
      field.corner + field.pixel * (glm::dvec2(pixel % width, pixel / width) + glm::dvec2(where));
  Channels values(channels(), std::vector<double>(field.terms()));
  for (std::size_t c = 0; c < values.size(); ++c)
    for (std::size_t i = 0; i < field.terms(); ++i)
      values[c][i] = static_cast<double>(channel(c).field().image(i)[pixel]);
  const std::vector<double> terms = weights_of(values);
  double u = static_cast<double>(whither.x);
  const std::size_t term = pick(terms, absolute_sum(terms), u);
  const glm::dvec2 from = in_filter(field, term, u, static_cast<double>(whither.y));
  // Filters overlap: what they send from here together, over what was picked by their size.
  std::vector<double> sums(channels());
  double picked = 0;
  each_filter(field, from, [&](std::size_t i, double weight) {
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += weight * values[c][i];
    picked += weight * std::abs(terms[i]);
  });
  EmittedLight out;
  out.position = Vec3(Vec2(from), 0);
  out.direction = Vec3(glm::normalize(glm::dvec3(to - from, -field.distance)));
  if (picked > 0) out.flux = rgb(channels(), [&](std::size_t c) { return absolute_ * sums[c] / picked; });
  return out;
}

Lamp make_near_field(const Light& light, std::shared_ptr<const NearField> field, float exact_below) {
  NearFieldLamp lamp;
  lamp.position = Vec3(light.frame[3]);
  lamp.to_world = Mat3(light.frame);
  lamp.scale = light.intensity;
  lamp.exact_below = exact_below;
  const Rgb flux = light.intensity * field->flux();
  lamp.field = std::move(field);
  return {light.name, light.group, std::move(lamp), flux, false};
}

bool sample(const NearFieldLamp& lamp, const Vec3& x, Vec2 u, LightSample& out) {
  const Vec3 local = (x - lamp.position) * lamp.to_world;
  if (!(local.z < -1e-6f)) return false;
  const NearField::Sample sample = lamp.field->sample(local, u, static_cast<double>(lamp.exact_below));
  if (sample.lux.is_black()) return false;
  const Vec3 to = Vec3(Vec2(sample.at), 0) - local;
  const float d = glm::length(to);
  // Just short of it, as for openings.
  out = {lamp.to_world * (to / d), d * (1 - 1e-4f), lamp.scale * sample.lux, 1.0f, true};
  return true;
}

EmittedLight emit(const NearFieldLamp& lamp, Vec2 where, Vec2 whither) {
  EmittedLight out = lamp.field->emit(where, whither);
  out.position = lamp.position + lamp.to_world * out.position;
  out.direction = lamp.to_world * out.direction;
  out.flux = lamp.scale * out.flux;
  return out;
}

}  // namespace sconce
