// SPDX-License-Identifier: Apache-2.0
#include "detect/materials.h"

#include <fmt/format.h>

#include "core/error.h"
#include "detect/axes.h"
#include "detect/backs.h"
#include "detect/lambertian.h"
#include "detect/patches.h"
#include "detect/placement.h"
#include "detect/slope.h"

namespace sconce {

namespace {

using Lights = DrawRequest::Lights;

constexpr float kDrawn = 0.999f;     // transmission from which a face counts as not drawn
constexpr float kAnswers = 1e-3f;    // of a white card under a light of 1: less is no answer
constexpr float kPlacement = 0.05f;  // share of light that may depend on a face's place
constexpr float kThrough = 0.01f;    // transmission that is no rounding
constexpr float kCleared = 0.25f;    // how far the mean of pixels outside may be from the background

/// Largest first, the first few of each material; all of them by face.
std::vector<uint32_t> choose_faces(const Scene& scene, const World& world, const DetectParams& params) {
  std::vector<uint32_t> all(world.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  if (params.per != DetectParams::Per::material) return all;
  std::stable_sort(all.begin(), all.end(),
                   [&](uint32_t a, uint32_t b) { return world.area(a) > world.area(b); });
  std::vector<int> counts(scene.materials.size(), 0);
  std::erase_if(all, [&](uint32_t t) { return ++counts[world.materials[t].value] > params.faces; });
  std::sort(all.begin(), all.end());
  return all;
}

void check_cleared(const TextureSpace& space, const Captured& captured, float background,
                   const std::string& what) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < space.pixels(); ++i)
    if (space.covered[i] == 0) sum += static_cast<double>(luminance(captured.light[i])), ++count;
  if (count > 0 && std::abs(sum / static_cast<double>(count) - static_cast<double>(background)) > kCleared)
    throw Error("the renderer's drawing of " + what,
                fmt::format("is {:.2g} outside the faces", sum / static_cast<double>(count)),
                fmt::format("the background that was asked for, {}", background));
}

class Detector {
 public:
  Detector(const Scene& scene, const World& world, const HostRenderer& host, const DetectParams& params,
           const Progress& progress)
      : scene_(scene), world_(world), host_(host), params_(params), progress_(progress) {}

  Detection run() {
    const std::vector<uint32_t> chosen = choose_faces(scene_, world_, params_);
    const bool by_texel = params_.per == DetectParams::Per::texel;
    space_ = face_cells(chosen, by_texel ? texels_by_area(world_, chosen, params_.texel, params_.most_texels)
                                         : std::vector<int>(chosen.size(), params_.texels));
    patches_ = Patches(space_, by_texel);
    unlit();
    reflections();
    by_face();
    if (by_texel) by_texels();
    by_material();
    backs();
    held_out();
    placement();
    return std::move(out_);
  }

 private:
  Captured draw(const DrawRequest& request, const std::string& what) {
    progress_.check();
    Captured captured = capture(host_, space_, request, what);
    out_.cost += captured.cost;
    progress_.at("materials", out_.cost.draws, 0);
    return captured;
  }

  /// Emission is what is seen on black; transmission is the slope over white and, in codes, greys, as of
  /// reflections.
  void unlit() {
    DrawRequest request;
    request.eye = far_eye(world_, axis_direction(4));
    const std::string on_black = "unlit faces on black", on_white = "unlit faces on white";
    bool clipped = false;
    const Captured black = draw(request, on_black);
    check_cleared(space_, black, 0, on_black);
    std::vector<Slope> slopes(patches_.size());
    responses_.resize(patches_.size());
    for (std::size_t p = 0; p < patches_.size(); ++p)
      slopes[p].add(Rgb(), responses_[p].emission = patches_.mean(p, black, clipped));
    const int backgrounds = host_.format == TargetFormat::linear ? 1 : 24;
    for (int k = 0; k < backgrounds; ++k) {
      request.background = k == 0 ? 1 : decode_code(host_.format, static_cast<uint8_t>(255 - 7 * k));
      const Captured grey = draw(request, on_white);
      check_cleared(space_, grey, request.background, on_white);
      for (std::size_t p = 0; p < patches_.size(); ++p) {
        clipped = false;
        // What the target cannot hold still tells something where there is nothing else.
        const Rgb shown = patches_.mean(p, grey, clipped);
        if (!clipped || k + 1 == backgrounds) slopes[p].add(Rgb(request.background), shown);
      }
    }
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      const Rgb through = slopes[p].value();
      responses_[p].transmission = Rgb(std::clamp(through.r, 0.0f, 1.0f), std::clamp(through.g, 0.0f, 1.0f),
                                       std::clamp(through.b, 0.0f, 1.0f));
    }
  }

  void reflections() {
    std::vector<Slope> slopes(patches_.size());
    for (std::size_t p = 0; p < slopes.size(); ++p) slopes[p].add(Rgb(), responses_[p].emission);
    std::array<bool, kAxes> wanted{};
    for (const uint32_t t : space_.triangles) wanted[facing_axis(world_.face_normals[t])] = true;
    for (std::size_t axis = 0; axis < wanted.size(); ++axis)
      if (wanted[axis]) add_light(axis, slopes);
    drawn_.resize(patches_.size()), answered_.resize(patches_.size());
    cards_.assign(space_.triangles.size(), 0);
    for (std::size_t p = 0; p < slopes.size(); ++p) {
      float& card = cards_[patches_.face(p)];
      card = std::max(card, slopes[p].most());
      drawn_[p] = luminance(responses_[p].transmission) < kDrawn ? 1 : 0;
      if (!(slopes[p].most() > kAnswers)) continue;
      answered_[p] = drawn_[p];
      limit(slopes[p].value(), responses_[p]);
    }
  }

  /// Means over the patches of each face, as far as they answered.
  void by_face() {
    std::size_t answers = 0;
    for (std::size_t p = 0; p < patches_.size();) {
      const uint32_t face = patches_.face(p);
      SurfaceResponse all, known;
      float count = 0, counted = 0;
      bool drawn = false;
      const auto add = [](SurfaceResponse& sum, const SurfaceResponse& r, float weight) {
        sum.emission += weight * r.emission, sum.transmission += weight * r.transmission;
        sum.reflectance += weight * r.reflectance;
      };
      for (; p < patches_.size() && patches_.face(p) == face; ++p) {
        add(all, responses_[p], 1), ++count;
        drawn = drawn || drawn_[p] != 0;
        if (answered_[p] != 0) add(known, responses_[p], 1), ++counted;
      }
      SurfaceResponse mean;
      add(mean, counted > 0 ? known : all, 1 / (counted > 0 ? counted : count));
      if (!drawn) ++out_.undrawn;
      if (counted > 0) ++answers;
      known_.push_back(counted > 0 ? 1 : 0);
      out_.faces.push_back({space_.triangles[face], mean});
    }
    if (out_.undrawn == out_.faces.size())
      throw Error("the renderer", fmt::format("drew none of {} faces: white stays white", out_.faces.size()));
    if (answers == 0)
      throw Error("the renderer",
                  "shows a white card under one light as black, or as bright as its target can",
                  "a diffuse card of reflectance 1, lit by one light of the intensity that was asked for");
  }

  void by_texels() {
    out_.texels.resize(space_.pixels());
    for (std::size_t p = 0; p < patches_.size(); ++p)
      for (const uint32_t pixel : patches_.pixels(p))
        out_.texels[pixel] = answered_[p] != 0 ? responses_[p] : out_.faces[patches_.face(p)].response;
    out_.space = space_;
  }

  /// Rounded readings differ with the intensity, and so their mean is finer than a code; more of them where
  /// each is of a single texel.
  void add_light(std::size_t axis, std::vector<Slope>& slopes) {
    static constexpr std::array kIntensities{1.0f, 1.6f, 1.5f, 1.4f, 1.3f, 1.2f,
                                             1.1f, 0.9f, 0.8f, 0.7f, 0.5f, 0.3f};
    DrawRequest request;
    request.lights = Lights::probe;
    request.probe.to_light = axis_direction(axis);
    request.eye =
        far_eye(world_, normalize_or(Frame(request.probe.to_light).x + 0.4f * request.probe.to_light, {}));
    const bool floats = host_.format == TargetFormat::linear;
    const std::size_t rounds = params_.per == DetectParams::Per::texel ? 3 : 2;
    for (std::size_t k = 0; k < (floats ? 1 : rounds * kIntensities.size()); ++k) {
      const auto round = static_cast<float>(k / kIntensities.size());
      request.probe.intensity = kIntensities[k % kIntensities.size()] * (1 - 0.03f * round);
      request.white_card = false;
      const Captured faces = draw(request, "faces under one light");
      request.white_card = true;
      const Captured card = draw(request, "a white card under one light");
      for (std::size_t p = 0; p < slopes.size(); ++p) {
        if (facing_axis(world_.face_normals[space_.triangles[patches_.face(p)]]) != axis) continue;
        bool clipped = false;
        const Rgb lit = patches_.mean(p, faces, clipped), white = patches_.mean(p, card, clipped);
        if (!clipped) slopes[p].add(white, lit);
      }
    }
  }

  /// Light must die out, whatever was read.
  void limit(const Rgb& rho, SurfaceResponse& r) const {
    const auto channel = [&](float reflected, float& through) {
      reflected = std::max(reflected, 0.0f);
      const float scale = std::min(1.0f, params_.most_reflected / std::max(reflected + through, 1e-6f));
      through *= scale;
      return reflected * scale;
    };
    r.reflectance.r = channel(rho.r, r.transmission.r);
    r.reflectance.g = channel(rho.g, r.transmission.g);
    r.reflectance.b = channel(rho.b, r.transmission.b);
  }

  void by_material() {
    out_.materials.resize(scene_.materials.size());
    std::vector<float> areas(scene_.materials.size(), 0);
    for (std::size_t i = 0; i < out_.faces.size(); ++i) {
      if (known_[i] == 0) continue;
      const DetectedFace& face = out_.faces[i];
      const uint32_t m = world_.materials[face.triangle].value;
      const float area = world_.area(face.triangle);
      DetectedMaterial& material = out_.materials[m];
      ++material.faces;
      areas[m] += area;
      material.response.emission += area * face.response.emission;
      material.response.transmission += area * face.response.transmission;
      material.response.reflectance += area * face.response.reflectance;
    }
    for (std::size_t m = 0; m < areas.size(); ++m)
      if (areas[m] > 0)
        for (Rgb* sum : {&out_.materials[m].response.emission, &out_.materials[m].response.transmission,
                         &out_.materials[m].response.reflectance})
          *sum *= 1 / areas[m];
    for (std::size_t i = 0; i < out_.faces.size(); ++i) {
      DetectedFace& face = out_.faces[i];
      DetectedMaterial& material = out_.materials[world_.materials[face.triangle].value];
      if (known_[i] == 0) {
        face.response = material.response;
        continue;
      }
      const Rgb d = face.response.reflectance - material.response.reflectance;
      material.spread = std::max({material.spread, std::abs(d.r), std::abs(d.g), std::abs(d.b)});
    }
    report_unknown();
    if (params_.per == DetectParams::Per::material)
      for (std::size_t m = 0; m < out_.materials.size(); ++m)
        if (out_.materials[m].spread > params_.spread_above)
          out_.findings.push_back(
              fmt::format("{} is not uniform: its faces differ by {:.0f} %; detect by face",
                          scene_.materials[m].name, 100 * out_.materials[m].spread));
  }

  void backs() {
    std::vector<CardedFace> asked;
    for (std::size_t i = 0; i < out_.faces.size(); ++i) {
      const uint32_t m = world_.materials[out_.faces[i].triangle].value;
      if (known_[i] != 0 && (scene_.materials[m].double_sided || out_.materials[m].lets_through()))
        asked.push_back({&out_.faces[i], cards_[i]});
    }
    if (asked.empty()) return;
    const std::vector<uint8_t> lit =
        lit_backs(world_, host_, asked, scene_.materials.size(), params_.texels, progress_, out_.cost);
    for (std::size_t m = 0; m < lit.size(); ++m) out_.materials[m].two_sided = lit[m] != 0;
  }

  void report_unknown() {
    std::vector<uint8_t> worn(scene_.materials.size(), 0);
    for (const Id<Material> m : world_.materials) worn[m.value] = 1;
    for (std::size_t m = 0; m < worn.size(); ++m)
      if (worn[m] != 0 && out_.materials[m].faces == 0)
        out_.findings.push_back(
            fmt::format("nothing is known of {}: no face of it was drawn, or all are too bright",
                        scene_.materials[m].name));
    if (out_.undrawn > 0)
      out_.findings.push_back(fmt::format("{} of {} faces were not drawn", out_.undrawn, out_.faces.size()));
  }

  void held_out() {
    std::vector<DetectedFace> known;
    for (std::size_t i = 0; i < out_.faces.size(); ++i)
      if (known_[i] != 0) known.push_back(out_.faces[i]);
    const std::vector<HeldOut> found =
        held_out_residuals(world_, host_, known, scene_.materials.size(), params_.texels, params_.flag_above,
                           progress_, out_.cost);
    for (std::size_t m = 0; m < found.size(); ++m) {
      DetectedMaterial& material = out_.materials[m];
      material.residual = found[m].residual;
      material.lambertian = found[m].holds;
      if (material.lambertian) continue;
      std::string finding =
          fmt::format("{} is not Lambertian: {:.0f} %", scene_.materials[m].name, 100 * material.residual);
      if (params_.lobes) {
        const DetectedFace& face = *std::find_if(known.begin(), known.end(), [&](const DetectedFace& f) {
          return world_.materials[f.triangle].value == m;
        });
        material.lobe =
            fit_lobe(world_, host_, face.triangle, face.response.emission, params_.texels, out_.cost);
        if (material.lobe)
          finding += fmt::format("; a lobe of {:.2f}, roughness {:.2f}, leaves {:.1f} %",
                                 luminance(material.lobe->strength), material.lobe->roughness(),
                                 100 * material.lobe->residual);
      }
      out_.findings.push_back(std::move(finding));
    }
  }

  void placement() {
    out_.placement = placement_residual(host_, space_.triangles, params_.texels, out_.cost);
    if (out_.placement > kPlacement)
      out_.findings.push_back(fmt::format(
          "the light on a face depends on where it is drawn, by {:.0f} %: renderers that look lights up by "
          "the screen (clusters, tiles) do not fit",
          100 * out_.placement));
  }

  const Scene& scene_;
  const World& world_;
  const HostRenderer& host_;
  const DetectParams& params_;
  const Progress& progress_;
  TextureSpace space_;
  Patches patches_{TextureSpace(), false};
  std::vector<SurfaceResponse> responses_;  ///< per patch
  std::vector<uint8_t> drawn_, answered_;   ///< per patch: 1 where it was drawn, where its card answers, too
  std::vector<float> cards_;                ///< per face: its brightest white card
  std::vector<uint8_t> known_;              ///< per face: 1 where it was drawn and its card answers
  Detection out_;
};

}  // namespace

bool DetectedMaterial::lets_through() const {
  return response.transmission.max() > kThrough;
}

const SurfaceResponse& Detection::of(const World& world, uint32_t triangle) const {
  const auto it = std::lower_bound(faces.begin(), faces.end(), triangle,
                                   [](const DetectedFace& f, uint32_t t) { return f.triangle < t; });
  if (it != faces.end() && it->triangle == triangle) return it->response;
  return materials[world.materials[triangle].value].response;
}

SurfaceResponse Detection::at(const World& world, uint32_t triangle, Vec2 barycentric) const {
  if (!texels.empty()) {
    const auto it = std::lower_bound(space.triangles.begin(), space.triangles.end(), triangle);
    const auto& [a, b, c] = space.corners[static_cast<std::size_t>(it - space.triangles.begin())];
    if (const auto blend = blend_at(space, a + barycentric.x * (b - a) + barycentric.y * (c - a))) {
      SurfaceResponse sum;
      for (std::size_t k = 0; k < 4; ++k) {
        const SurfaceResponse& r = texels[blend->pixels[k]];
        sum.emission += blend->weights[k] * r.emission;
        sum.transmission += blend->weights[k] * r.transmission;
        sum.reflectance += blend->weights[k] * r.reflectance;
      }
      return sum;
    }
  }
  return of(world, triangle);
}

Detection detect_materials(const Scene& scene, const World& world, const HostRenderer& host,
                           const DetectParams& params, const Progress& progress) {
  if (params.texels < 1 || params.faces < 1 || params.most_texels < 1 || !(params.texel > 0))
    throw UsageError("material detection", "no texels or no faces", "1 or more of each, larger than 0 m");
  return Detector(scene, world, host, params, progress).run();
}

Scene with_detected(Scene scene, const Detection& detection) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (detection.materials[m].faces == 0) continue;
    Material plain;
    plain.name = scene.materials[m].name;
    plain.double_sided = scene.materials[m].double_sided;
    plain.base_color = detection.materials[m].response.reflectance;
    plain.emission = detection.materials[m].response.emission;
    scene.materials[m] = plain;
  }
  return scene;
}

}  // namespace sconce
