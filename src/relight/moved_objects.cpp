// SPDX-License-Identifier: Apache-2.0
#include "relight/moved_objects.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr uint32_t kStream = 0x6f626a74u;

std::vector<SurfacePoint> middles_of(const RelightReceivers& receivers) {
  std::vector<SurfacePoint> out(receivers.source.count);
  parallel_for(out.size(), 256,
               [&](std::size_t i) { out[i] = receivers.source.footprint(i).sample(Vec2(0.5f)); });
  return out;
}

/// Nothing of it is on the edge of a box that it touches.
Bounds widened(Bounds box, float by) {
  box.lo -= by, box.hi += by;
  return box;
}

bool inside(const Bounds& box, const Vec3& p) {
  return glm::all(glm::greaterThanEqual(p, box.lo)) && glm::all(glm::lessThanEqual(p, box.hi));
}

}  // namespace

std::vector<MovedGroup> all_groups(const Package& package) {
  std::vector<MovedGroup> groups;
  for (std::size_t g = 0; g < package.manifest().groups.size(); ++g)
    groups.push_back({Id<LightGroup>(g), Rgb(1)});
  return groups;
}

Vec3 middle_of_object(const View& view, const std::string& name, const std::string& where) {
  const Bounds box = object_bounds(view.scene(), view.world(), name);
  if (!box.empty()) return box.center();
  const std::vector<std::string> names = object_names(view.scene());
  throw UsageError(where, "no object '" + name + "'" + did_you_mean(name, names), join(names, ", "));
}

MovedObjects::MovedObjects(const Package& package, const View& home, const Progress& progress)
    : package_(package),
      home_(home),
      view_(package, home.shown()),
      places_of_objects_(view_.scene(), view_.world()),
      atlas_(package_atlas(package, home)),
      texels_(all_texels(view_.traced(), atlas_, progress)),
      middles_(middles_of(texels_.receivers)),
      placements_(view_.scene().instances.size()),
      lamps_at_home_(home.scene(), home.world(), home.tracer(), {}, all_groups(package)) {
  // Those that layers have no light of: the lightmap's own receivers are the others.
  const std::vector<uint32_t> baked = texel_receivers(view_.traced(), atlas_, progress).places;
  for (const uint32_t place : places())
    covered_at_home_.push_back(std::binary_search(baked.begin(), baked.end(), place) ? 0 : 1);
  covered_ = covered_at_home_;
}

void MovedObjects::place(const ObjectMoves& moves, const std::string& where) {
  for (const auto& [name, move] : moves) middle_of_object(view_, name, where);
  boxes_.clear();
  view_.place(places_of_objects_, moves);
  for (const View* view : {&home_, static_cast<const View*>(&view_)})
    for (const auto& [name, move] : moves)
      boxes_.push_back(widened(object_bounds(view->scene(), view->world(), name),
                               1e-4f * home_.world().bounds.diagonal()));
  moves_ = moves;
  placements_ = places_of_objects_.placements(view_.scene(), moves);
  lamps_.emplace(view_.scene(), view_.world(), view_.tracer(), MoreLights{}, all_groups(package_));
  find_covered();
}

// Only below what has moved anything may have changed.
void MovedObjects::find_covered() {
  parallel_for(covered_.size(), 256, [&](std::size_t i) {
    const Placement& to = placements_[view_.world().instances[texels_.texels->triangle(i)].value];
    const Vec3 at = to.point(middles_[i].position);
    const bool near =
        std::any_of(boxes_.begin(), boxes_.end(), [&](const Bounds& box) { return inside(box, at); });
    covered_[i] = covered_at_home_[i];
    if (near && (covered_at_home_[i] != 0 || to == Placement()))
      covered_[i] = texels_.texels->covered(i) ? 1 : 0;
  });
}

std::vector<Rgb> MovedObjects::direct(uint32_t rays, const Progress& progress) const {
  const std::size_t groups = package_.manifest().groups.size(), count = middles_.size();
  std::vector<Rgb> out(count * groups);
  if (moves_.empty()) return out;
  const Bounds everywhere{Vec3(-1e30f), Vec3(1e30f)};
  constexpr std::size_t kBlock = 1024;
  parallel_for((count + kBlock - 1) / kBlock, 1, [&](std::size_t block) {
    progress.check();
    std::vector<Rgb> now(groups), before(groups);
    for (std::size_t i = kBlock * block; i < std::min(count, kBlock * (block + 1)); ++i) {
      if (covered_[i] != 0) continue;
      const Placement& to = placements_[view_.world().instances[texels_.texels->triangle(i)].value];
      const uint32_t stream = mix32(kStream, places()[i]);
      const std::span<const Bounds> boxes =
          covered_at_home_[i] != 0 ? std::span(&everywhere, 1) : std::span<const Bounds>(boxes_);
      const auto look = [&](const SurfacePoint& at, uint32_t r) {
        lamps_->add_light_through(boxes, at, stream, r, now);
        if (covered_at_home_[i] == 0) lamps_at_home_.add_light_through(boxes, to.home(at), stream, r, before);
      };
      std::fill(now.begin(), now.end(), Rgb()), std::fill(before.begin(), before.end(), Rgb());
      if (rays == 1) {
        look(to.there(middles_[i]), 0);
      } else {
        const Footprint texel = texels_.receivers.source.footprint(i);
        for (uint32_t r = 0; r < rays; ++r) look(texel.sample(sobol_pair(r, 0, stream)), r);
      }
      for (std::size_t g = 0; g < groups; ++g)
        out[groups * i + g] = (now[g] - before[g]) * (1.0f / static_cast<float>(rays));
    }
  });
  return out;
}

void MovedObjects::add_to(std::vector<Image>& pages, const MixSpec& mix, std::span<const Rgb> direct,
                          std::span<const Rgb> now, std::span<const Rgb> home) const {
  const std::size_t groups = mix.weights.size();
  const std::size_t page_size =
      static_cast<std::size_t>(atlas_.width) * static_cast<std::size_t>(atlas_.height);
  std::vector<uint32_t> seen;
  std::vector<Rgb> light;
  for (std::size_t i = 0; i < middles_.size(); ++i) {
    if (covered_[i] != 0) continue;
    const bool fresh = covered_at_home_[i] != 0;
    Rgb sum;
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t k = groups * i + g;
      sum += mix.weights[g] * (direct[k] + now[k] - (fresh ? Rgb() : home[k]));
    }
    if (fresh) {
      const std::size_t at = places()[i] % page_size;
      sum -= pages[places()[i] / page_size].rgb_at(static_cast<int>(at) % atlas_.width,
                                                   static_cast<int>(at) / atlas_.width);
    }
    seen.push_back(places()[i]);
    light.push_back(sum);
  }
  add_to_pages(atlas_, seen, light, pages);
  for (Image& page : pages)
    for (float& v : page.data) v = std::max(v, 0.0f);
}

}  // namespace sconce
