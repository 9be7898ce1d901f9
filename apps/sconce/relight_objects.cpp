// SPDX-License-Identifier: Apache-2.0
#include "relight_objects.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "picture_options.h"

namespace sconce::app {

namespace {

constexpr uint32_t kRays = 32;  // to each lamp from each texel
constexpr double kMostDegrees = 360;
constexpr const char* kOption = "option '--object'";

}  // namespace

ObjectMoves moves_to(const View& home, const std::vector<ObjectPlace>& places) {
  ObjectMoves moves;
  for (const ObjectPlace& p : places)
    moves[p.name] = {p.middle - middle_of_object(home, p.name, kOption), p.turn};
  return moves;
}

ObjectPlace parse_object(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const char* form = "NAME=X,Y,Z or NAME=X,Y,Z,DEGREES";
  if (equals == std::string::npos || equals == 0)
    throw UsageError(kOption, "'" + text + "' is not understood", form);
  ObjectPlace place{text.substr(0, equals), {}};
  std::string point = text.substr(equals + 1);
  if (std::count(point.begin(), point.end(), ',') == 3) {
    const std::size_t comma = point.rfind(',');
    const std::optional<double> turn = parse_number(trim(point.substr(comma + 1)));
    if (!turn || !(std::abs(*turn) <= kMostDegrees))
      throw UsageError(kOption, "'" + point.substr(comma + 1) + "' is no angle", "-360 to 360 degrees");
    place.turn = static_cast<float>(*turn);
    point.resize(comma);
  }
  place.middle = parse_point(point, "--object");
  return place;
}

ObjectsElsewhere::ObjectsElsewhere(const Package& package, const View& home,
                                   const std::vector<ObjectPlace>& places, const Progress& progress)
    : moves_(moves_to(home, places)), objects_(package, home, progress), follower_(package, home, progress) {
  if (home.sees_normal_maps()) progress.warn("with --object surfaces are as smooth as their geometry");
  objects_.place(moves_);
  direct_ = objects_.direct(kRays, progress);
  bounces_ = follower_.follow(moves_, progress);
}

}  // namespace sconce::app
