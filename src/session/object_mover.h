// SPDX-License-Identifier: Apache-2.0
// Objects that are moved while one looks: shadows at once, bounces as soon as an operator has followed them.
#pragma once

#include "relight/moved_objects.h"
#include "relight/object_follower.h"
#include "session/opened.h"

namespace sconce {

class ObjectMover {
 public:
  /// What that needs of a package; made once, beside the window.
  explicit ObjectMover(std::shared_ptr<const Opened> opened, const Progress& progress = {});

  /// The scene with objects where they are, for looking. Rests between calls of place().
  const View& view() const { return objects_.view(); }
  const ObjectMoves& moves() const { return objects_.moves(); }
  bool any() const { return !moves().empty(); }
  const Opened& opened() const { return *opened_; }
  const MovedObjects& objects() const { return objects_; }

  /// Puts objects there and lights them roughly: one ray from each texel. Nobody else may look meanwhile.
  void place(const ObjectMoves& moves);
  /// Whether direct light is by one ray only.
  bool rough() const { return rough_; }
  /// By many rays; thread-safe between calls of place().
  struct Fine {
    ObjectMoves moves;
    std::vector<Rgb> direct;
  };
  Fine refined(const Progress& progress) const;
  /// What is out of date is left aside.
  void take(Fine fine);

  /// Bounces with objects there, in a world of its own: beside all others, one at a time. The first time
  /// makes the operator.
  ObjectBounces follow(const ObjectMoves& moves, const Progress& progress);
  /// They are shown from now on, whether or not objects have moved on since.
  void take(ObjectBounces bounces);
  /// Whether bounces are those of other places.
  bool behind() const { return any() && (!bounces_ || bounces_->moves != moves()); }
  /// Those that are shown; none until there are any.
  const std::optional<ObjectBounces>& bounces() const { return bounces_; }

  /// Counts changes of light.
  uint64_t version() const { return version_; }
  /// Mixed pages with objects where they are. @param pages  of the same mix, as baked
  std::vector<Image> pages(std::vector<Image> pages, const MixSpec& mix) const;

 private:
  std::shared_ptr<const Opened> opened_;
  MovedObjects objects_;
  std::vector<Rgb> direct_;
  bool rough_ = false;
  uint64_t version_ = 0;
  std::unique_ptr<ObjectFollower> follower_;
  std::optional<ObjectBounces> bounces_;
  std::vector<Rgb> nothing_, home_;  ///< bounces before there are any, and with objects at home
};

/// `NAME=X,Y,Z[,DEGREES]` of each, as `sconce relight --object` takes them; and how far the bounces are.
std::vector<std::string> object_options(const ObjectMover& mover);

}  // namespace sconce
