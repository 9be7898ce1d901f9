// SPDX-License-Identifier: Apache-2.0
#include "relight_objects.h"

#include "core/error.h"
#include "picture_options.h"

namespace sconce::app {

namespace {

constexpr uint32_t kRays = 32;  // to each lamp from each texel
constexpr const char* kOption = "option '--object'";

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
    : objects_(package, home, progress), follower_(package, home, progress) {
  if (home.sees_normal_maps()) progress.warn("with --object surfaces are as smooth as their geometry");
  ObjectMoves moves;
  for (const auto& [name, to] : places) moves[name] = to - objects_.middle(name, kOption);
  objects_.place(moves);
  direct_ = objects_.direct(kRays, progress);
  bounces_ = follower_.follow(moves, progress);
}

}  // namespace sconce::app
