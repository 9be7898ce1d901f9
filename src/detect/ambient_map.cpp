// SPDX-License-Identifier: Apache-2.0
#include "detect/ambient_map.h"

namespace sconce {

namespace {

Atlas one_atlas(const TracedScene& traced, float density) {
  AtlasParams params;
  params.density = density;
  return make_atlas(traced.scene, traced.world, traced.tracer, params);
}

constexpr int kRings = 3;  // of texels around a face

}  // namespace

void add_part(Scene& scene, Id<Material> material, std::vector<Vec3> positions, std::vector<Vec3> normals,
              const Mat4& place) {
  Mesh mesh;
  mesh.material = material;
  for (uint32_t v = 0; v + 2 < positions.size(); v += 3) mesh.triangles.push_back({{v, v + 1, v + 2}});
  const Mat3 turned = glm::transpose(glm::inverse(Mat3(place)));
  for (Vec3& p : positions) p = Vec3(place * glm::vec4(p, 1));
  for (Vec3& n : normals) n = normalize_or(turned * n, Vec3(0, 0, 1));
  mesh.positions = std::move(positions), mesh.normals = std::move(normals);
  Instance instance;
  instance.mesh = Id<Mesh>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(std::move(instance));
}

TransferParams quick_transfer() {
  TransferParams params;
  params.gather = 4096, params.rays = 256, params.lights = 128;
  return params;
}

AmbientMap::AmbientMap(Scene scene, float density)
    : scene_(std::move(scene)),
      world_(make_world(scene_)),
      tracer_(scene_, world_),
      traced_{scene_, world_, tracer_},
      atlas_(one_atlas(traced_, density)),
      space_(atlas_space(atlas_)) {}

PartCorners AmbientMap::corners(std::span<const uint32_t> triangles, std::span<const std::array<Vec2, 3>> at,
                                Vec2 whole, Vec2 others) const {
  PartCorners parts;
  for (const Instance& instance : scene_.instances)
    parts.emplace_back(3 * scene_[instance.mesh].triangles.size(), others);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      parts[world_.instances[triangles[i]].value][3 * world_.source_triangles[triangles[i]] + c] =
          at[i][c] / whole;
  return parts;
}

PartCorners AmbientMap::coordinates() const {
  return corners(space_.triangles, space_.corners, Vec2(space_.width, space_.height), Vec2(0));
}

PartCorners AmbientMap::places(const DrawRequest& request) const {
  return corners(request.triangles, request.corners, Vec2(request.width, request.height), Vec2(2));
}

PartCorners AmbientMap::clip_places(const DrawRequest& request) const {
  PartCorners parts = places(request);
  for (std::vector<Vec2>& part : parts)
    for (Vec2& at : part) at = 2.0f * at - 1.0f;
  return parts;
}

void AmbientMap::start(const HostRenderer& host, TransferParams params, const Progress& progress,
                       const DetectParams& look) {
  params.keep_sums = true;
  host_ = host, look_ = look;
  detection_ = detect_materials(scene_, world_, host, look, progress);
  radiosity_ = std::make_unique<RealtimeRadiosity>(traced_, texel_receivers(traced_, atlas_), space_, host,
                                                   detection_, params, progress);
  spread_reflectance();
}

void AmbientMap::detect(const Progress& progress) {
  detection_ = detect_materials(scene_, world_, host_, look_, progress);
  radiosity_->set_materials(detection_);
  spread_reflectance();
}

void AmbientMap::spread_reflectance() {
  reflectance_.assign(space_.pixels(), Rgb());
  std::vector<std::size_t> known;
  for (std::size_t f = 0; f < space_.triangles.size(); ++f) {
    const auto& [a, b, c] = space_.corners[f];
    const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
    each_pixel(space_, f, [&](std::size_t pixel) {
      reflectance_[pixel] =
          detection_.at(world_, space_.triangles[f], inverse * (pixel_middle(space_, pixel) - a)).reflectance;
      known.push_back(pixel);
    });
  }
  std::vector<uint8_t> done = space_.covered;
  const auto width = static_cast<std::size_t>(space_.width);
  for (int ring = 0; ring < kRings; ++ring)
    for (std::size_t i = 0, end = known.size(); i < end; ++i)
      for (const std::size_t to : {known[i] - 1, known[i] + 1, known[i] - width, known[i] + width})
        if (to < done.size() && !done[to]) {  // below 0 is beyond the end
          done[to] = 1, reflectance_[to] = reflectance_[known[i]];
          known.push_back(to);
        }
}

std::vector<Rgb> AmbientMap::reflected() const {
  std::vector<Rgb> light(texels().begin(), texels().end());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] *= reflectance_[i];
  return light;
}

}  // namespace sconce
