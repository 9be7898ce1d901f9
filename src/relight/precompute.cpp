// SPDX-License-Identifier: Apache-2.0
#include "relight/precompute.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/hash.h"
#include "relight/chapter_operator.h"
#include "relight/exact_operator.h"
#include "relight/operator_parts.h"

namespace sconce {

void check(const TransferParams& p) {
  if (!is_power_of_four(p.gather) || p.gather < 256 || p.gather > 65536)
    throw UsageError("option '--gather'", fmt::format("{} samples", p.gather),
                     "a power of four: 256, 1024, 4096, 16384, 65536");
  const auto positive = [](const char* option, int value, int most) {
    if (value < 1 || value > most)
      throw UsageError(fmt::format("option '{}'", option), std::to_string(value),
                       fmt::format("1 to {}", most));
  };
  positive("--rays", p.rays, 1 << 20);
  positive("--cluster", p.cluster, 65536);
  if (p.cluster % 16 != 0)
    throw UsageError("option '--cluster'", std::to_string(p.cluster), "a multiple of 16");
  positive("--lights", p.lights, 4096);
  positive("--coefficients", p.coefficients, 65536);
  positive("--bounce-coefficients", p.bounce_coefficients, 65536);
  positive("--points", p.points, 256);
  positive("--photons", p.photons, 1 << 30);
  positive("--nearest", p.nearest, 1 << 20);
}

MadeOperators make_operators(const TracedScene& traced, const RelightReceivers& receivers,
                             const TransferParams& params, const std::string& scene,
                             const TransferWork& work) {
  check(params);
  if (!params.transmission.empty() && params.transmission.size() != traced.scene.materials.size())
    throw UsageError("transmission", std::to_string(params.transmission.size()) + " values",
                     "one for each material: " + std::to_string(traced.scene.materials.size()));
  if (params.method == TransferMethod::chapter)
    return {make_chapter_operator(traced, receivers, params, scene, work), std::nullopt};
  if (params.method == TransferMethod::exact)
    return make_exact_operator(traced, receivers, params, scene, work);
  OperatorParts parts(traced, receivers, params, scene, work);
  Operator op = parts.make(work);
  return {std::move(op), parts.take_lobes()};
}

Operator make_operator(const TracedScene& traced, const RelightReceivers& receivers,
                       const TransferParams& params, const std::string& scene, const TransferWork& work) {
  RelightReceivers diffuse = receivers;
  diffuse.glossy = {};
  return make_operators(traced, diffuse, params, scene, work).op;
}

std::string operator_scene(const Package& package) {
  ContentHash hash;
  for (const char* file : {"scene.glb", "layout.bin"}) {
    const auto it = package.manifest().hashes.find(file);
    hash.text(it != package.manifest().hashes.end() ? it->second : std::string());
  }
  return hash.hex();
}

}  // namespace sconce
