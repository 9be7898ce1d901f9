// SPDX-License-Identifier: Apache-2.0
// Light at points of space, per group: what a lux meter there would show, whatever the faders.
#pragma once

#include <memory>

#include "package/points.h"
#include "picture/render.h"
#include "scene/measuring_plane.h"
#include "session/final_gather.h"
#include "session/standing.h"
#include "solve/solver.h"

namespace sconce {

/// Lux of every group at points, ever more exact with each pass of the path tracer.
struct MeasuredLight {
  std::size_t groups = 0;
  int samples = 0;          ///< paths per point so far
  std::vector<Rgb> values;  ///< [point * groups + g], at unit weight

  std::size_t points() const { return groups == 0 ? 0 : values.size() / groups; }
  Rgb mixed(std::size_t point, const MixSpec& mix) const;
};

/// Points [first, end) of it.
MeasuredLight part_of(const MeasuredLight& light, std::size_t first, std::size_t end);

/// A plane that was measured, and whose name it has in the package.
struct MeasuredPlane {
  std::string name;
  MeasuringPlane grid;
  MeasuredLight light;
};

/// The planes that were baked with the package, by name. @throws Error naming the damaged file
std::vector<MeasuredPlane> baked_planes(const Package& package);

/// Which points no light of any group reaches: those inside of furniture.
std::vector<uint8_t> unreached(const MeasuredLight& light);

class PointMeter {
 public:
  /// @param view  of the package; must outlive it
  PointMeter(const View& view, std::vector<SurfacePoint> points, ReceiverKind kind);
  /// Of lamps and objects where they are. Groups are those of the package.
  PointMeter(std::shared_ptr<const StandingScene> scene, std::vector<SurfacePoint> points, ReceiverKind kind);
  PointMeter(PointMeter&&) noexcept;
  ~PointMeter();
  /// Lamps beside those that rays know. @param view  must outlive it: with objects as the scene has them
  void add(const View& view, std::vector<KnownLamp> lamps);
  /// `samples` more paths at every point. @throws Cancelled; nothing of the pass counts then
  void pass(int samples, const Progress& progress);
  const MeasuredLight& light() const { return light_; }

 private:
  struct World;
  /// Where no path finds light, what leaks into furniture and through walls is none.
  void add_known(const KnownLamp& lamp, int samples, const SolveContext& context, const Progress& progress,
                 std::vector<Rgb>& sum) const;
  PointMeter(std::unique_ptr<World> world, std::vector<SurfacePoint> points, ReceiverKind kind);
  std::unique_ptr<World> world_;
  std::vector<SurfacePoint> points_;
  ReceiverKind kind_;
  const View* view_ = nullptr;  ///< of what is added
  std::vector<KnownLamp> added_;
  MeasuredLight light_;
  uint32_t passes_ = 0;
};

/// What a lighting report gives of a plane.
struct LuxStatistics {
  double minimum = 0, average = 0, maximum = 0;
  double uniformity() const { return average > 0 ? minimum / average : 0; }  ///< U0 of EN 12464-1
  double diversity() const { return maximum > 0 ? minimum / maximum : 0; }   ///< Ud
};
LuxStatistics lux_statistics(std::span<const float> lux);
/// Luminance of the mix at every point.
/// @param left_out  per point: 1 = not given; may be empty
std::vector<float> lux_of(const MeasuredLight& light, const MixSpec& mix,
                          std::span<const uint8_t> left_out = {});
/// Of a plane: all of its points but the unreached.
LuxStatistics plane_statistics(const MeasuredLight& light, const MixSpec& mix);

}  // namespace sconce
