// SPDX-License-Identifier: Apache-2.0
// What lux meters show: planes and goals, of lamps and objects as they stand.
#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "viewer/viewer.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

void Viewer::measure() {
  Plane& plane = state_.plane;
  const bool away = state_.away();
  std::vector<std::vector<SurfacePoint>> sets;
  if (plane.shown && plane.measured.name.empty()) sets.push_back(plane.measured.grid.points());
  if (away) {
    for (const MeasuredPlane& baked : state_.opened->planes) sets.push_back(baked.grid.points());
    std::vector<SurfacePoint>& goals = sets.emplace_back();
    for (const Goal& goal : state_.goals) goals.push_back({goal.position, goal.normal, goal.normal});
  }
  std::vector<SurfacePoint> points;
  std::vector<std::size_t> ends;
  for (const auto& set : sets) {
    points.insert(points.end(), set.begin(), set.end());
    ends.push_back(points.size());
  }
  if (points.empty()) return measuring_.stop();
  measuring_.start([opened = state_.opened, view = &rays(), mover = state_.objects.mover, away,
                    lamps = state_.movers().standing(), known = state_.movers().known(points), points,
                    ends](const Progress& progress, const auto& publish) {
    PointMeter meter =
        away
            ? PointMeter(std::make_shared<StandingScene>(standing_scene(view->scene(), view->world(), lamps)),
                         points, ReceiverKind::plane)
            : PointMeter(*view, points, ReceiverKind::plane);
    meter.add(*view, known);
    for (int samples = 64; samples <= 2048; samples *= 2) {
      meter.pass(samples, progress);
      std::vector<MeasuredLight> parts;
      for (std::size_t set = 0, first = 0; set < ends.size(); first = ends[set++])
        parts.push_back(part_of(meter.light(), first, ends[set]));
      publish(parts);
    }
  });
}

void Viewer::take_measured(std::vector<MeasuredLight> parts) {
  auto part = parts.begin();
  Plane& plane = state_.plane;
  if (plane.shown && plane.measured.name.empty() && part != parts.end())
    plane.measured.light = std::move(*part++);
  if (!state_.away() || parts.end() - part != static_cast<std::ptrdiff_t>(state_.planes.size()) + 1) return;
  for (MeasuredPlane& baked : state_.planes) {
    baked.light = std::move(*part++);
    if (plane.shown && plane.measured.name == baked.name) plane.measured = baked;
  }
  const std::size_t groups = part->groups;
  for (std::size_t i = 0; i < std::min(part->points(), state_.goals.size()); ++i) {
    const auto first = part->values.begin() + static_cast<std::ptrdiff_t>(i * groups);
    state_.goals[i].lux.assign(first, first + static_cast<std::ptrdiff_t>(groups));
  }
}

void Viewer::follow_moves() {
  if (!state_.opened || state_.dragging() || objects_pending()) return;
  if (state_.lamps.mover && state_.lamps.mover->rough()) return;
  const uint64_t version = state_.movers().version();
  const std::pair now{state_.session->mood().moved, state_.session->mood().objects};
  if (now == state_.measured && version == state_.measured_version) return;
  const bool stood = now == state_.measured && state_.objects.mover != nullptr;
  state_.measured = now, state_.measured_version = version;
  if (stood && measuring_.running()) return;  // bounces have followed: rays knew them already
  if (state_.look == LookKind::reference)
    refine_reference();
  else
    tracing_.stop(), reference_.reset(), coming_.reset(), traced_.reset();
  if (!state_.away()) {
    state_.planes = state_.opened->planes;
    for (Goal& goal : state_.goals) goal.lux = goal.baked;
    for (const MeasuredPlane& baked : state_.planes)
      if (state_.plane.shown && state_.plane.measured.name == baked.name) state_.plane.measured = baked;
  }
  measure();
}

void Viewer::show_plane() {
  Plane& plane = state_.plane;
  plane.shown = true;
  plane.measured = {
      {}, horizontal_plane(state_.opened->rays.world().bounds, plane.height, plane.spacing), {}};
  measure();
}

void Viewer::show_plane(const MeasuredPlane& baked) {
  state_.plane.shown = true;
  state_.plane.measured = baked;
}

void Viewer::write_figures(const fs::path& file) const {
  std::string lines = "plane,points,minimum,average,maximum,uniformity\n";
  const auto line = [&](const std::string& name, const MeasuredLight& light) {
    const LuxStatistics s = plane_statistics(light, state_.session->mix());
    lines += fmt::format("{},{},{},{},{},{}\n", name, light.points(), s.minimum, s.average, s.maximum,
                         s.uniformity());
  };
  for (const MeasuredPlane& plane : state_.planes) line(plane.name, plane.light);
  const Plane& shown = state_.plane;
  if (shown.shown && shown.measured.name.empty())
    line(fmt::format("{} m", shown.height), shown.measured.light);
  for (std::size_t i = 0; i < state_.goals.size(); ++i) {
    const std::vector<Rgb>& lux = state_.goals[i].lux;
    line(fmt::format("goal {}", i + 1), {lux.size(), 1, lux});
  }
  write_file(file, lines);
}

}  // namespace sconce::viewer
