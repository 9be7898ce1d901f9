// SPDX-License-Identifier: Apache-2.0
#include "detect/tinted_bounces.h"

namespace sconce {

std::vector<std::vector<float>> tints(const Detection& detection) {
  constexpr float kColour = 0.01f;  // between channels: less is no colour
  bool any = false, coloured = false;
  for (const DetectedMaterial& m : detection.materials) {
    if (!m.lets_through()) continue;
    const Rgb& t = m.response.transmission;
    any = true;
    coloured = coloured || t.max() - std::min({t.r, t.g, t.b}) > kColour;
  }
  std::vector<std::vector<float>> out(any ? (coloured ? 3 : 1) : 0);
  for (const DetectedMaterial& m : detection.materials) {
    const Rgb& t = m.response.transmission;
    const std::array channels{t.r, t.g, t.b};
    for (std::size_t c = 0; c < out.size(); ++c)
      out[c].push_back(coloured ? channels[c] : (t.r + t.g + t.b) / 3);
  }
  return out;
}

TintedBounces::TintedBounces(std::vector<Operator> operators) {
  for (Operator& op : operators) {
    ways_.push_back(std::make_unique<Way>());
    ways_.back()->op = std::move(op);
    ways_.back()->light.resize(ways_.back()->op.gather.rows);
  }
}

void TintedBounces::set_reflectance(std::span<const Rgb> of) {
  for (const std::unique_ptr<Way>& way : ways_) {
    way->albedo.resize(of.size());
    for (std::size_t node = 0; node < of.size(); ++node) {
      const float weight = way->op.albedo[node][3];  // Operator::albedo
      const Rgb a = (weight > 0 ? weight : 1.0f) * of[node];
      way->albedo[node] = {a.r, a.g, a.b, weight};
    }
    way->op.albedo = way->albedo;
    way->bounces = std::make_unique<FoldedBounces>(way->op);
  }
}

void TintedBounces::go_on_from(const TintedBounces& old) {
  for (std::size_t w = 0; w < ways_.size(); ++w) ways_[w]->light = old.ways_[w]->light;
}

std::size_t TintedBounces::solve(std::span<const Rgbx> light, const FrameBudget& budget,
                                 const Stopwatch& running) {
  const bool limited = budget.limited(op().gather.rows);
  for (const std::unique_ptr<Way>& way : ways_) {
    std::vector<Rgbx> all(light.begin(), light.end());
    way->bounces->apply(all);
    if (!limited) {
      multiply(way->op.gather, all, way->light);
      way->gradual.reset();
      continue;
    }
    if (way->gradual == nullptr)
      way->gradual = std::make_unique<GradualRows>(way->op.gather), way->lit.clear();
    if (all != way->lit) way->lit = std::move(all), way->gradual->start(way->lit, way->light);
  }
  return limited ? refine(budget, running) : 0;
}

std::size_t TintedBounces::refine(const FrameBudget& budget, const Stopwatch& running) {
  // By time in small steps, so that the last is not far beyond it.
  const std::size_t step = std::size_t{128} * op().gather.cluster;
  const GradualRows& first = *ways_.front()->gradual;
  for (std::size_t left = budget.receivers; first.left() > 0;) {
    const std::size_t before = first.left();
    for (const std::unique_ptr<Way>& way : ways_)
      way->gradual->refine(way->lit, std::min(left, step), way->light);
    left -= std::min(left, before - first.left());
    if (left < op().gather.cluster || running.milliseconds() > budget.milliseconds) break;
  }
  return first.left();
}

Rgb TintedBounces::light(std::size_t receiver) const {
  const Rgb &r = ways_.front()->light[receiver], &g = ways_[ways_.size() / 2]->light[receiver],
            &b = ways_.back()->light[receiver];
  return {std::max(r.r, 0.0f), std::max(g.g, 0.0f), std::max(b.b, 0.0f)};
}

}  // namespace sconce
