// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "app.h"
#include "bake_report.h"
#include "core/file_lock.h"
#include "core/parallel.h"

namespace sconce::app {

int run_merge(int argc, const char* const* argv) {
  Options options(
      "merge",
      "Joins the shards of one bake (`bake --shard i/n`) into its package, bit for bit the whole bake.",
      {"sconce merge kitchen.shard-*-of-3 -o kitchen.sconce",
       "sconce merge a/k.shard-0-of-2 b/k.shard-1-of-2 -o kitchen.sconce", "sconce view {PACKAGE}"});
  std::vector<std::string> shards;
  std::string output;
  options.positionals("SHARD", &shards, "state files that `bake --shard` wrote", true);
  options.option("-o,--output", &output, "package to write");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "the package to write is missing", "-o NAME.sconce");

  const auto start = std::chrono::steady_clock::now();
  const Progress progress = make_progress(options);
  const ThreadLimit threads(options.threads);
  const FileLock lock(output);
  std::vector<BakeState> states;
  for (const std::string& shard : shards) {
    states.push_back(BakeState::open(shard, false));
    const BakeHeader &first = states.front().header(), &header = states.back().header();
    if (header.hash != first.hash) throw Error(shard, "belongs to another bake than " + shards.front());
    if (header.job != first.job) throw Error(shard, "was baked with other options than " + shards.front());
    if (header.isa != first.isa)
      throw Error(shard, "was baked on another instruction set (" + header.isa + ") than " + shards.front(),
                  first.isa);
  }
  const PreparedBake bake(BakeJob::from_json(states.front().header().job, shards.front()), progress);
  if (states.front().header().layers != bake.scene.groups.size() * coefficients(bake.job.params.basis))
    throw Error(shards.front(), "holds only some of the light groups: `bake --resume` goes on with it",
                "what `bake --shard` wrote");
  if (bake.hash != states.front().header().hash)
    throw Error(shards.front(), "its scene " + bake.job.scene.string() + " has changed since");
  std::map<std::string, Provenance> provenance;
  for (const auto& [key, value] : options.provenance()) provenance[key] = {value.value, value.source};
  const Manifest manifest = write_result(bake, states, output, provenance, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.quiet || options.json) print_result(bake, manifest, output, seconds, options.json);
  options.next({output});
  return kDone;
}

}  // namespace sconce::app
