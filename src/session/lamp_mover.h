// SPDX-License-Identifier: Apache-2.0
// Lamps that leave their layers and are moved while one looks: `sconce relight --move` with their direct
// light on texels, so that every look, exposure and camera follows.
#pragma once

#include <functional>
#include <variant>

#include "mix/mixer.h"
#include "relight/object_follower.h"
#include "relight/texel_light.h"
#include "session/opened.h"
#include "session/session.h"
#include "session/standing.h"

namespace sconce {

/// What that needs of a package; made once, beside the window.
struct Movable {
  /// @throws Error when the package has no operator for its lightmap
  explicit Movable(std::shared_ptr<const Opened> opened, const Progress& progress = {});
  /// Of the same package with objects elsewhere, as the view has them.
  /// @param view, bounces  of the package; the view must outlive it, and rest while its light is asked for
  /// @param texels         those of the view
  Movable(std::shared_ptr<const Opened> opened, const View& view, const ObjectBounces& bounces, Atlas atlas,
          RelightReceivers texels);
  Movable(const Movable&) = delete;
  Movable& operator=(const Movable&) = delete;

  /// Its way from where it was baked. @throws UsageError: a target for what points nowhere
  Mat4 motion(std::size_t lamp, const MovedLamp& to) const;
  /// A lamp alone, at unit weight.
  /// @param to  where it is; none: where it was baked
  /// @throws UsageError: a target for what points nowhere
  MovedLamps alone(std::size_t lamp, const std::optional<MovedLamp>& to) const;
  /// One that is none of the scene's.
  MovedLamps alone(const MoreLights& others) const;
  /// Its light on the operator's texels, direct and indirect, lux.
  /// @param fine  by many shadow rays for each texel, else by one
  std::vector<Rgb> light(const MovedLamps& lamp, bool fine, const Progress& progress = {}) const;

  std::shared_ptr<const Opened> opened;
  const View& view;
  Operator op;
  std::shared_ptr<const FoldedBounces> bounces;
  Atlas atlas;
  RelightReceivers texels;
  Lamps lamps;
  std::vector<std::string> names;  ///< of each lamp, its own
};

/// A lamp that rays do not know, at unit weight.
struct PrelitLamp {
  std::vector<Rgb> light;                                                 ///< on the operator's texels, lux
  std::function<std::vector<Rgb>(std::span<const SurfacePoint>)> direct;  ///< at points, lux
};
/// What a lamp has become.
using OtherLamp = std::variant<MoreLights, PrelitLamp>;

/// The lamps that a preset can move; none where the package has no operator.
std::vector<SceneLamp> movable_lamps(const Opened& opened);

class LampMover {
 public:
  /// @param other  makes lamps of other kinds; throws Error where the kind is not understood
  explicit LampMover(std::shared_ptr<const Movable> movable,
                     std::function<OtherLamp(std::size_t, const MovedLamp&)> other = {})
      : movable_(std::move(movable)), other_(std::move(other)) {}
  const Movable& movable() const { return *movable_; }
  /// Objects or bounces are elsewhere now: all light is made anew.
  void set_movable(std::shared_ptr<const Movable> movable);
  const std::shared_ptr<const Movable>& shared() const { return movable_; }

  /// Lamps of one name, or of a group. @throws UsageError naming those that there are
  std::vector<std::size_t> find(const std::string& name, const std::string& where) const;
  /// The middle of a lamp; none where it shines from everywhere.
  std::optional<Vec3> place(std::size_t lamp, const MovedPlaces& moved) const;

  /// Lights lamps that went elsewhere or became others since, roughly. What cannot be made stays as it was
  /// last.
  void follow(const MovedPlaces& moved);
  /// The kind of this lamp is made anew: a file of it has changed.
  void remake(std::size_t lamp) { moved_[lamp].now.stale = true; }
  /// Why a lamp is not what it is asked to be; empty where all are.
  std::string problem() const;
  /// What is only roughly lit; none where nothing is.
  struct Task {
    std::size_t lamp;
    std::optional<MovedLamp> state;  ///< none: as it was baked
    std::optional<MoreLights> other{};
  };
  std::optional<Task> rough() const;
  struct Fine {
    Task task;
    std::vector<Rgb> light;
    bool inside = false;  ///< it stands inside something
  };
  /// A task, done by many rays; thread-safe.
  static Fine light(const Movable& movable, const Task& task, const Progress& progress);
  /// What is out of date is left aside.
  void refine(const Fine& fine);

  bool any() const { return !moved_.empty(); }
  /// Those that are elsewhere, or others, for rays.
  std::vector<StandingLamp> standing() const;
  /// Those that rays do not know, at points. On the thread that made them.
  std::vector<KnownLamp> known(std::span<const SurfacePoint> points) const;
  /// Counts changes of light.
  uint64_t version() const { return version_; }

  /// The mixed lightmap with moved lamps where they are: they leave layers that stay, and groups that went as
  /// a whole leave the mix.
  /// @param mixed  the pages of a mix with all lamps at home
  std::vector<Image> pages(const std::function<std::vector<Image>(const MixSpec&)>& mixed,
                           const MixSpec& mix) const;

 private:
  struct Lit {
    std::optional<MovedLamp> state;
    std::optional<MoreLights> other;
    decltype(PrelitLamp::direct) direct;  ///< where rays do not know it
    std::vector<Rgb> light;
    bool fine = false, stale = false;
  };
  struct Moved {
    Lit before, now;
    std::optional<MovedLamp> wrong;  ///< what it was asked to be in vain
    std::string why;
  };
  Lit lit(std::size_t lamp, const MovedLamp& state) const;
  std::vector<MovedGroup> taken(MixSpec& mix) const;

  std::shared_ptr<const Movable> movable_;
  std::function<OtherLamp(std::size_t, const MovedLamp&)> other_;
  std::map<std::size_t, Moved> moved_;
  uint64_t version_ = 0;
};

/// `LAMP=X,Y,Z[,target=X,Y,Z]` of each, as `sconce relight --move` takes them.
std::vector<std::string> move_options(const LampMover& mover, const MovedPlaces& moved);

}  // namespace sconce
