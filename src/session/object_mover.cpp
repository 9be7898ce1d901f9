// SPDX-License-Identifier: Apache-2.0
#include "session/object_mover.h"

#include <fmt/format.h>

namespace sconce {

namespace {

constexpr uint32_t kFineRays = 32;

}  // namespace

ObjectMover::ObjectMover(std::shared_ptr<const Opened> opened, const Progress& progress)
    : opened_(std::move(opened)),
      objects_(opened_->package, opened_->rays, progress),
      nothing_(objects_.places().size() * opened_->package.manifest().groups.size()) {}

void ObjectMover::place(const ObjectMoves& moves) {
  objects_.place(moves);
  direct_ = objects_.direct(1);
  rough_ = any();
  ++version_;
}

ObjectMover::Fine ObjectMover::refined(const Progress& progress) const {
  return {moves(), objects_.direct(kFineRays, progress)};
}

void ObjectMover::take(Fine fine) {
  if (fine.moves != moves()) return;
  direct_ = std::move(fine.direct);
  rough_ = false;
  ++version_;
}

ObjectBounces ObjectMover::follow(const ObjectMoves& moves, const Progress& progress) {
  if (follower_ == nullptr)
    follower_ = std::make_unique<ObjectFollower>(opened_->package, opened_->rays, progress);
  return follower_->follow(moves, progress);
}

void ObjectMover::take(ObjectBounces bounces) {
  if (home_.empty()) home_ = follower_->home().light;
  bounces_ = std::move(bounces);
  ++version_;
}

std::vector<Image> ObjectMover::pages(std::vector<Image> pages, const MixSpec& mix) const {
  if (any())
    objects_.add_to(pages, mix, direct_, bounces_ ? bounces_->light : nothing_, bounces_ ? home_ : nothing_);
  return pages;
}

std::vector<std::string> object_options(const ObjectMover& mover) {
  std::vector<std::string> out;
  for (const auto& [name, move] : mover.moves()) {
    const Vec3 at = middle_of_object(mover.opened().rays, name, {}) + move.by;
    out.push_back(fmt::format("{}={:.4f},{:.4f},{:.4f}", name, at.x, at.y, at.z));
    if (move.turn != 0) out.back() += fmt::format(",{:g}", move.turn);
  }
  if (mover.behind())
    out.emplace_back("# bounces are those of other places");
  else if (mover.any())
    out.push_back(fmt::format("# bounces: {} of {} rows of the cloud, {} of {} of texels made again",
                              mover.bounces()->made.slots, mover.bounces()->slots,
                              mover.bounces()->made.receivers, mover.bounces()->receivers));
  return out;
}

}  // namespace sconce
