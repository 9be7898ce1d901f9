// SPDX-License-Identifier: Apache-2.0
// How much light arrives at receivers. Adding a solver is one file and one row of table.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/ranks.h"
#include "core/receiver.h"
#include "encode/basis.h"
#include "light/lamp.h"
#include "receive/atlas.h"
#include "trace/tracer.h"

namespace sconce {

struct BakeParams {
  int samples = 256;  ///< paths per receiver, rounded up to a multiple of kBatches
  int bounces = -1;   ///< reflections before the receiver; 0 = direct only, -1 = unbounded
  uint32_t seed = 1;
  Basis basis = Basis::flat;
  int cloud = 0;            ///< radiosity solver: gather samples; 0 = chosen by it
  int cache_samples = 0;    ///< samples that its cache is made good enough for; 0 = `samples`
  double noise = 0;         ///< stop a receiver early when its relative standard error falls below; 0 = never
  std::size_t photons = 0;  ///< photon solver: emitted by all lamps together; 0 = by the number of texels
  bool final_gather = true;           ///< photon solver: rays read the map; false = the receiver itself does
  std::string command;                ///< of a row with `runs_program`: what it runs
  std::filesystem::path work_folder;  ///< and where its files go
};

/// Batches of samples, parts of one scrambled sequence: their spread is the noise, or somewhat more (ADR 26).
inline constexpr int kBatches = 8;

/// What a solver sees. All outlive it.
struct SolveContext {
  const Scene& scene;
  const World& world;
  const Tracer& tracer;
  const Lamps& lamps;
  const Atlas* atlas = nullptr;               ///< the lightmap, where there is one
  const TexelReceivers* receivers = nullptr;  ///< its texels
  std::span<const uint8_t> wanted = {};  ///< per scene group: 0 = may stay black; empty = all are asked for

  Ranks ranks = {};  ///< may share what prepare() computes; each needs all of it

  bool wants(Id<LightGroup> group) const { return wanted.empty() || wanted[group.value] != 0; }
};

/// One receiver's answer for one group and one coefficient of the basis.
struct GroupValue {
  Rgb illuminance;  ///< lux per channel: E_g of contract.md, or a component of g (encode/basis.h)
  float error = 0;  ///< standard error of its luminance, lux
};

/// A solver made ready for a scene.
class Solver {
 public:
  virtual ~Solver() = default;
  /// All groups of one receiver at once. Thread-safe; a pure function of the footprint (its id names the
  /// random numbers).
  /// @param out  [coefficient * groups + group] of the scene's groups and its basis; of probes always sh1
  virtual void solve(const Footprint& receiver, std::span<GroupValue> out) const = 0;
  /// Another number of samples than it was prepared with, for a bake that learns only then how many its time
  /// allows. @return false: it has no such number
  virtual bool set_samples(int) { return false; }
};

struct SolverRow {
  std::string_view name, doc;
  std::unique_ptr<Solver> (*prepare)(const SolveContext& context, const BakeParams& params,
                                     const Progress& progress);
  /// Asked for as NAME:CMD; works on texels of an atlas only, whole pages at once.
  bool runs_program = false;
};

/// radiosity, path, photon, external; in this order.
std::span<const SolverRow> solvers();
/// @param name  of a row; NAME:CMD where it runs a program
/// @throws UsageError naming the choices
const SolverRow& find_solver(std::string_view name);
/// CMD of NAME:CMD, else empty.
std::string solver_command(std::string_view name);

}  // namespace sconce
