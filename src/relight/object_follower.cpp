// SPDX-License-Identifier: Apache-2.0
#include "relight/object_follower.h"

#include "core/parallel.h"
#include "core/sobol.h"
#include "relight/moved_objects.h"

namespace sconce {

namespace {

constexpr uint32_t kStream = 0x666f6c6cu;

TransferParams params_of_followers() {
  TransferParams params;
  params.gather = 16384, params.rays = 256, params.coefficients = 512, params.movable = true;
  return params;
}

}  // namespace

ObjectFollower::ObjectFollower(const Package& package, const View& home, const Progress& progress)
    : package_(package),
      scene_(home.scene()),
      world_(home.world()),
      tracer_(scene_, world_),
      places_(scene_, world_),
      receivers_(all_texels({scene_, world_, tracer_}, package_atlas(package, home), progress).receivers),
      parts_({scene_, world_, tracer_}, receivers_, params_of_followers(), "", {progress, nullptr}),
      home_(lit(parts_.make({progress, nullptr}), {})) {}

ObjectBounces ObjectFollower::follow(const ObjectMoves& moves, const Progress& progress) {
  if (moves.empty()) return home_;
  places_.place(moves, scene_, world_);
  tracer_ = Tracer(scene_, world_);
  FollowReport made;
  ObjectBounces bounces = lit(parts_.follow(progress, &made), moves);
  bounces.made = made;
  return bounces;
}

ObjectBounces ObjectFollower::lit(Operator op, const ObjectMoves& moves) const {
  struct Kept {
    Operator op;
    FoldedBounces folded{op};
  };
  const auto kept = std::make_shared<const Kept>(std::move(op));
  const Operator& transfer = kept->op;
  ObjectBounces out;
  out.moves = moves, out.op = {kept, &kept->op}, out.folded = {kept, &kept->folded};
  const std::size_t groups = package_.manifest().groups.size();
  const MovedLamps lamps(scene_, world_, tracer_, {}, all_groups(package_));
  const Bounds everywhere{Vec3(-1e30f), Vec3(1e30f)};
  std::vector<Rgb> arriving(transfer.lit.size() * groups);
  parallel_for(transfer.lit.size(), 256, [&](std::size_t i) {
    const auto slot = static_cast<uint32_t>(i / transfer.points_per_slot);
    lamps.add_light_through({&everywhere, 1}, point_of(transfer.lit[i]), mix32(kStream, slot),
                            static_cast<uint32_t>(i % transfer.points_per_slot),
                            {&arriving[groups * i], groups});
  });
  const std::vector<uint32_t>& places = receivers_.places;
  std::vector<std::size_t> own(transfer.places.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    own[i] = static_cast<std::size_t>(std::lower_bound(places.begin(), places.end(), transfer.places[i]) -
                                      places.begin());
  out.light.resize(places.size() * groups);
  std::vector<Rgb> light(transfer.places.size());
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<Rgbx> cloud =
        slot_exitance(transfer, [&](std::size_t i) { return arriving[groups * i + g]; });
    kept->folded.indirect(cloud, light);
    for (std::size_t i = 0; i < light.size(); ++i) out.light[groups * own[i] + g] = light[i];
  }
  out.slots = transfer.slots(), out.receivers = places.size();
  return out;
}

}  // namespace sconce
