// SPDX-License-Identifier: Apache-2.0
// Indirect light for a foreign renderer, frame by frame: its direct light is read from its own picture, all
// bounces come by the transfer operator, and what returns is an ambient term (Hrbek 2006, step three).
#pragma once

#include <future>
#include <memory>

#include "detect/tinted_bounces.h"
#include "relight/operator_parts.h"

namespace sconce {

/// What a frame did.
struct FrameReport {
  std::string fault;  ///< of the renderer; empty: none. Else the ambient term is 0: it goes on without
  CaptureCost capture;
  double solve_milliseconds = 0;
  std::size_t coarse = 0;   ///< receivers whose light is right only in the mean of their cluster, so far
  bool following = false;   ///< things moved, and rows are still being made for their new places
  std::size_t clipped = 0;  ///< points whose light is brighter than the target can hold

  explicit operator bool() const { return fault.empty(); }
};

/// Light is in the renderer's unit: 1 is what it shows as 1. A surface shows
/// emission + reflectance x (its own direct light + ambient).
class RealtimeRadiosity {
 public:
  /// Follows rays, once; those that meet what lets light through go on behind it, and both of its sides send
  /// light on. Of backs that the renderer lights, the light is drawn, too.
  /// @param traced     must outlive it, as what the receivers refer to
  /// @param detection  its transmissions are taken by material, and stay; coloured ones take an operator per
  ///                   channel, three times the work and the bytes
  /// @param direct   where faces are drawn to see their light; the faces of all that sends light on
  /// @param params   of `cluster` no more than a 256th of the receivers
  /// @throws UsageError, Cancelled, as make_operator()
  RealtimeRadiosity(const TracedScene& traced, const RelightReceivers& receivers, TextureSpace direct,
                    HostRenderer host, const Detection& detection, TransferParams params = {},
                    const Progress& progress = {});

  /// Reflectances by texel, face or material. Without rays: after a change of the renderer's materials, too.
  void set_materials(const Detection& detection);
  /// Lets the renderer draw its direct light and solves. The first frame after any change has all bounces:
  /// nothing is carried over from frame to frame. Within a budget, all clusters of receivers have the right
  /// mean in each frame; how light differs within them follows, some clusters a frame, as long as light
  /// rests.
  FrameReport update(const FrameBudget& budget = {});
  /// After triangles moved in the World, and the Tracer was made anew at its place: makes those rows again
  /// that saw them, in the background. Until then update() answers with the old ones, and says so; the World
  /// and the Tracer must rest. @pre TransferParams::movable; as many vertices as before. @throws UsageError,
  /// as OperatorParts::follow()
  void follow();
  bool following() const { return next_.valid(); }
  /// Waits until it is done.
  void wait();

  /// Light by reflection, per texel (page x height x width + y x width + x; those around receivers have their
  /// neighbours') or vertex, linear. To be multiplied by the surface's own reflectance and added.
  std::span<const Rgb> ambient() const { return ambient_; }
  /// The operator; of red, where channels have their own.
  const Operator& transfer() const { return now_->bounces.op(); }
  const TextureSpace& direct_space() const { return direct_; }
  /// Points that stand for the light of the surfaces, and those of them that no drawn face covers: black.
  std::size_t points() const { return now_->blends.size(); }
  std::size_t uncovered() const { return now_->uncovered; }

 private:
  struct Copy {
    uint32_t to, from;
  };
  struct OnFace {
    uint32_t triangle = 0xffffffffu;  ///< or none
    Vec2 barycentric{0};
  };
  /// The operators, and how they see the renderer's drawings.
  struct Solver {
    TintedBounces bounces;
    std::vector<OnFace> faces;       ///< per lit point: where it is
    std::vector<PixelBlend> blends;  ///< per lit point: what it reads, of fronts and then of backs
    std::size_t uncovered = 0;
  };
  std::unique_ptr<Solver> make_solver(std::vector<Operator> operators, const Detection& detection) const;
  void find_faces(Solver& solver) const;
  void set_albedo(Solver& solver, const Detection& detection) const;
  void find_backs(const Detection& detection);
  void find_copies();

  const World& world_;
  const Tracer& tracer_;
  TextureSpace direct_, backs_;  ///< fronts, and faces whose backs the renderer lights
  HostRenderer host_;
  Detection detection_;
  std::vector<std::unique_ptr<OperatorParts>> parts_;  ///< of what may move, per operator
  std::unique_ptr<Solver> now_;
  std::vector<Copy> copies_;  ///< texels around receivers
  std::vector<Rgb> ambient_;
  std::future<std::unique_ptr<Solver>> next_;  ///< last: what it uses lives as long
};

}  // namespace sconce
