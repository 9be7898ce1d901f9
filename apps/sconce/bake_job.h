// SPDX-License-Identifier: Apache-2.0
// A bake from scene file to package: what `bake` starts, `--resume` and `merge` take up again.
#pragma once

#include <filesystem>

#include "bake_plan.h"
#include "scene/groups.h"
#include "solve/bake.h"
#include "solve/points.h"

namespace sconce::app {

/// Everything that decides a bake's result. As JSON it travels in the state file, so that shards can be
/// merged.
struct BakeJob {
  std::filesystem::path scene;  ///< absolute
  std::string grouping = "auto";
  std::string solver = "radiosity";
  std::string encoding =
      "f16";  ///< "f16" or "f16,ceiling=lum:f16": a default, then exceptions by group name or glob
  double max_error = 0.01;  ///< of the encoding "auto"
  bool denoise = false;
  double probes = 0;  ///< metres between probes; 0 = none
  AtlasParams atlas;
  BakeParams params;

  /// Whether some layer may be kept in blocks of 4 x 4 texels, which must not mix two charts.
  bool may_use_blocks() const;
  std::string to_json() const;
  /// @throws Error naming `where`
  static BakeJob from_json(const std::string& text, const std::string& where);
};

/// A job with its scene loaded, charts cut and lamps found; members refer to each other, so it stays where it
/// is.
struct PreparedBake {
  BakeJob job;
  Scene scene;
  World world;
  std::vector<std::string> inputs;     ///< per group: solve/inputs.h
  std::vector<std::string> encodings;  ///< per group
  BakePlan plan;
  std::vector<uint8_t> wanted;  ///< per group: 1 = to be solved
  Tracer tracer;
  Lamps lamps;
  Atlas atlas;
  TexelReceivers receivers;
  std::vector<PlaneLight> planes;  ///< of the side file, without light yet
  std::string hash;                ///< of what records depend on: contract.md, "The resume hash"

  /// @param before  a package whose layers are kept where nothing that they depend on has changed, on its own
  /// texels; empty or not there = all is solved
  /// @param ranks  share the search for buried texels; all must see the same
  PreparedBake(const BakeJob& job, const Progress& progress, const std::filesystem::path& before = {},
               const Ranks& ranks = {});
  PreparedBake(const PreparedBake&) = delete;
  PreparedBake& operator=(const PreparedBake&) = delete;

  /// Before anything is baked, and only where nothing is kept.
  void set_samples(int samples);

  BakeHeader header() const;
  /// Hash of the records and of how they are sampled and encoded.
  std::string result_hash() const;
  /// Whether the package that stands is what this bake would write.
  bool up_to_date() const;
};

/// @param seen  what must be the same on all ranks: they would bake parts that do not fit together
/// @throws Error naming the first rank that is not like rank 0
void check_agreement(std::string_view seen, const Ranks& ranks);

/// The job's solver, made ready for the groups that are not kept. All ranks together.
/// @param state  its path; programs of others work beside it
std::unique_ptr<Solver> make_solver(const PreparedBake& bake, const std::filesystem::path& state,
                                    const Ranks& ranks, const Progress& progress);
/// Bakes these tiles, for the groups that are not kept.
void run_bake(const PreparedBake& bake, const Solver& solver, std::span<const std::size_t> tiles,
              BakeState& state, const Progress& progress);
/// Both, for the tiles of the shard that `state` lacks.
void run_bake(const PreparedBake& bake, Shard shard, BakeState& state, const Progress& progress);

/// Denoises if asked to, fills gaps, takes over what is kept and writes the package. @throws Error: tiles
/// missing, unwritable
/// @param options  provenance for the manifest
/// @return what was written
Manifest write_result(const PreparedBake& bake, std::span<BakeState> states,
                      const std::filesystem::path& output, const std::map<std::string, Provenance>& options,
                      const Progress& progress);

}  // namespace sconce::app
