// SPDX-License-Identifier: Apache-2.0
// Objects of a package elsewhere, for `--object`.
#pragma once

#include "relight/moved_objects.h"
#include "relight/object_follower.h"

namespace sconce::app {

struct ObjectPlace {
  std::string name;
  Vec3 middle;     ///< m
  float turn = 0;  ///< ObjectMove
};
/// `NAME=X,Y,Z[,DEGREES]`. @throws UsageError
ObjectPlace parse_object(const std::string& text);

/// Before an operator is made for them. @throws UsageError: no such object
ObjectMoves moves_to(const View& home, const std::vector<ObjectPlace>& places);

class ObjectsElsewhere {
 public:
  /// Package and view must outlive it. @throws UsageError, Cancelled
  ObjectsElsewhere(const Package& package, const View& home, const std::vector<ObjectPlace>& places,
                   const Progress& progress);
  const View& view() const { return objects_.view(); }
  const Operator& transfer() const { return *bounces_.op; }
  void add_to(std::vector<Image>& pages, const MixSpec& mix) const {
    objects_.add_to(pages, mix, direct_, bounces_.light, follower_.home().light);
  }

 private:
  ObjectMoves moves_;
  MovedObjects objects_;
  ObjectFollower follower_;
  std::vector<Rgb> direct_;
  ObjectBounces bounces_;
};

}  // namespace sconce::app
