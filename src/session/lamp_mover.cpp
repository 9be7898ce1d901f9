// SPDX-License-Identifier: Apache-2.0
#include "session/lamp_mover.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "relight/package_operator.h"

namespace sconce {

Movable::Movable(std::shared_ptr<const Opened> opened_, const Progress& progress)
    : opened(std::move(opened_)),
      view(opened->rays),
      op(find_operator(opened->package, "")),
      bounces(std::make_shared<const FoldedBounces>(op)),
      atlas(package_atlas(opened->package, opened->rays)),
      texels(texel_receivers(opened->rays.traced(), atlas, progress)),
      lamps(opened->rays.scene(), opened->rays.world()),
      names(lamp_names(lamps)) {}

Movable::Movable(std::shared_ptr<const Opened> opened_, const View& view_, const ObjectBounces& bounces_,
                 Atlas atlas_, RelightReceivers texels_)
    : opened(std::move(opened_)),
      view(view_),
      op(*bounces_.op),
      bounces(bounces_.folded),
      atlas(std::move(atlas_)),
      texels(std::move(texels_)),
      lamps(view.scene(), view.world()),
      names(lamp_names(lamps)) {}

Mat4 Movable::motion(std::size_t lamp, const MovedLamp& to) const {
  return motion_to(lamps, {&lamp, 1}, {to.at, to.target}, names[lamp], "target");
}

MovedLamps Movable::alone(std::size_t lamp, const std::optional<MovedLamp>& to) const {
  const Lamp& shape = lamps.all()[lamp];
  LampMove move{{lamp}, {shape.group}, Mat4(1.0f)};
  if (to) move.motion = motion(lamp, *to);
  const MovedGroup group{shape.group, Rgb(1), {lamp}};
  return MovedLamps(view.scene(), view.world(), view.tracer(), {}, {&group, 1},
                    {&move, to ? std::size_t{1} : 0});
}

MovedLamps Movable::alone(const MoreLights& others) const {
  return MovedLamps(view.scene(), view.world(), view.tracer(), others, {});
}

std::vector<Rgb> Movable::light(const MovedLamps& lamp, bool fine, const Progress& progress) const {
  return with_indirect(fine ? direct_over_texels(op, texels, lamp, progress) : direct_at_middles(op, lamp),
                       opened->package, view, op, *bounces, lamp);
}

std::vector<SceneLamp> movable_lamps(const Opened& opened) {
  if (!std::filesystem::exists(operator_path(opened.package.path(), ""))) return {};
  const Lamps lamps(opened.rays.scene(), opened.rays.world());
  const std::vector<std::string> names = lamp_names(lamps);
  std::vector<SceneLamp> out;
  for (std::size_t i = 0; i < lamps.size(); ++i) out.push_back({names[i], place_of(lamps.all()[i])});
  return out;
}

std::vector<std::size_t> LampMover::find(const std::string& name, const std::string& where) const {
  return find_lamps(movable_->view.scene(), movable_->lamps, name, where).lamps;
}

std::optional<Vec3> LampMover::place(std::size_t lamp, const MovedPlaces& moved) const {
  const auto it = moved.find(lamp);
  return it != moved.end() ? it->second.at : place_of(movable_->lamps.all().at(lamp));
}

void LampMover::set_movable(std::shared_ptr<const Movable> movable) {
  movable_ = std::move(movable);
  for (auto& [lamp, entry] : moved_) entry.before = {}, entry.now.stale = true;
}

void LampMover::follow(const MovedPlaces& moved) {
  version_ += std::erase_if(moved_, [&](const auto& item) { return !moved.contains(item.first); });
  for (const auto& [lamp, state] : moved) {
    Moved& entry = moved_[lamp];
    if (entry.before.light.empty()) entry.before.light = movable_->light(movable_->alone(lamp, {}), false);
    const bool again = std::exchange(entry.now.stale, false);
    if (!again && entry.wrong == state) continue;
    if (!again && !entry.now.light.empty() && entry.now.state == state) {
      entry.wrong.reset();
      continue;
    }
    try {
      entry.now = lit(lamp, state);
      entry.wrong.reset();
    } catch (const Error& error) {
      entry.wrong = state, entry.why = error.what();
      if (entry.now.light.empty()) entry.now = lit(lamp, {state.at});
    }
    ++version_;
  }
}

LampMover::Lit LampMover::lit(std::size_t lamp, const MovedLamp& state) const {
  Lit made;
  made.state = state;
  if (state.kind.empty() || !other_) {
    made.light = movable_->light(movable_->alone(lamp, state), false);
    return made;
  }
  OtherLamp other = other_(lamp, state);
  if (auto* prelit = std::get_if<PrelitLamp>(&other)) {
    made.light = std::move(prelit->light), made.direct = std::move(prelit->direct), made.fine = true;
    return made;
  }
  made.other = std::get<MoreLights>(std::move(other));
  made.light = movable_->light(movable_->alone(*made.other), false);
  return made;
}

std::string LampMover::problem() const {
  for (const auto& [lamp, entry] : moved_)
    if (entry.wrong) return entry.why;
  return {};
}

std::optional<LampMover::Task> LampMover::rough() const {
  for (const auto& [lamp, entry] : moved_)
    for (const Lit* lit : {&entry.now, &entry.before})
      if (!lit->fine) return Task{lamp, lit->state, lit->other};
  return std::nullopt;
}

LampMover::Fine LampMover::light(const Movable& movable, const Task& task, const Progress& progress) {
  const MovedLamps lamp = task.other ? movable.alone(*task.other) : movable.alone(task.lamp, task.state);
  return {task, movable.light(lamp, true, progress), task.state && !lamp.buried().empty()};
}

void LampMover::refine(const Fine& fine) {
  const auto it = moved_.find(fine.task.lamp);
  if (it == moved_.end()) return;
  for (Lit* lit : {&it->second.now, &it->second.before})
    if (lit->state == fine.task.state && !lit->stale) lit->light = fine.light, lit->fine = true, ++version_;
}

std::vector<StandingLamp> LampMover::standing() const {
  std::vector<StandingLamp> out;
  for (const auto& [lamp, entry] : moved_)
    if (entry.now.state) {
      const bool itself = entry.now.state->kind.empty();
      out.push_back(
          {lamp, itself ? movable_->motion(lamp, *entry.now.state) : Mat4(1.0f), itself, entry.now.other});
    }
  return out;
}

std::vector<KnownLamp> LampMover::known(std::span<const SurfacePoint> points) const {
  std::vector<KnownLamp> out;
  for (const auto& [lamp, entry] : moved_)
    if (entry.now.direct)
      out.push_back({movable_->lamps.all()[lamp].group.value, entry.now.direct(points),
                     to_pages(movable_->atlas, movable_->op, entry.now.light)});
  return out;
}

std::vector<MovedGroup> LampMover::taken(MixSpec& mix) const {
  std::vector<LampMove> moves;
  for (const auto& [lamp, entry] : moved_)
    moves.push_back({{lamp}, {movable_->lamps.all()[lamp].group}, Mat4(1.0f)});
  return take_lamps(movable_->lamps, {}, moves, false, mix);
}

std::vector<Image> LampMover::pages(const std::function<std::vector<Image>(const MixSpec&)>& mixed,
                                    const MixSpec& mix) const {
  MixSpec layers = mix;
  std::vector<Rgb> leaves(movable_->op.places.size());
  const std::vector<MovedGroup> groups = taken(layers), parts = in_part(groups);
  for (const auto& [lamp, entry] : moved_) {
    const Id<LightGroup> group = movable_->lamps.all()[lamp].group;
    const Rgb weight = mix.weights[group.value];
    const bool stays =
        std::any_of(parts.begin(), parts.end(), [&](const MovedGroup& p) { return p.group == group; });
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      leaves[i] -= weight * entry.now.light[i];
      if (stays) leaves[i] += weight * entry.before.light[i];
    }
  }
  std::vector<Image> pages = mixed(layers);
  take_share(movable_->atlas, movable_->op, leaves, pages);
  return pages;
}

std::vector<std::string> move_options(const LampMover& mover, const MovedPlaces& moved) {
  std::vector<std::string> out;
  const auto vector = [](const Vec3& v) { return fmt::format("{:.4f},{:.4f},{:.4f}", v.x, v.y, v.z); };
  for (const auto& [lamp, state] : moved)
    out.push_back(mover.movable().names[lamp] + "=" + vector(state.at) +
                  (state.target ? ",target=" + vector(*state.target) : "") +
                  (state.kind.empty() ? "" : "  # as " + state.kind));
  return out;
}

}  // namespace sconce
