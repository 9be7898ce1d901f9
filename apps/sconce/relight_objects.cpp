// SPDX-License-Identifier: Apache-2.0
#include "relight_objects.h"

#include "core/error.h"
#include "picture_options.h"

namespace sconce::app {

namespace {

constexpr uint32_t kRays = 32;  // to each lamp from each texel
constexpr const char* kOption = "option '--object'";

/// Before an operator is made for them. @throws UsageError
ObjectMoves moves_to(const View& home, const std::vector<std::pair<std::string, Vec3>>& places) {
  ObjectMoves moves;
  for (const auto& [name, to] : places) moves[name] = to - middle_of_object(home, name, kOption);
  return moves;
}

}  // namespace

std::pair<std::string, Vec3> parse_object(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(kOption, "'" + text + "' is not understood", "NAME=X,Y,Z");
  return {text.substr(0, equals), parse_point(text.substr(equals + 1), "--object")};
}

ObjectsElsewhere::ObjectsElsewhere(const Package& package, const View& home,
                                   const std::vector<std::pair<std::string, Vec3>>& places,
                                   const Progress& progress)
    : moves_(moves_to(home, places)), objects_(package, home, progress), follower_(package, home, progress) {
  if (home.sees_normal_maps()) progress.warn("with --object surfaces are as smooth as their geometry");
  objects_.place(moves_);
  direct_ = objects_.direct(kRays, progress);
  bounces_ = follower_.follow(moves_, progress);
}

}  // namespace sconce::app
