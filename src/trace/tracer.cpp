// SPDX-License-Identifier: Apache-2.0
#include "trace/tracer.h"

#include <embree3/rtcore.h>

#include <array>
#include <cassert>
#include <cstring>

#include "core/error.h"

namespace sconce {

struct Tracer::State {
  const Scene* scene = nullptr;
  const World* world = nullptr;
  RTCDevice device = nullptr;
  RTCScene rtc = nullptr;
  /// Embree primitive -> World triangle; geometry 0 is opaque, geometry 1 alpha-masked.
  std::array<std::vector<uint32_t>, 2> triangles;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (rtc != nullptr) rtcReleaseScene(rtc);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void add(const std::vector<uint32_t>& primitives, bool masked);
  static void filter(const RTCFilterFunctionNArguments* args);
};

void Tracer::State::add(const std::vector<uint32_t>& primitives, bool masked) {
  if (primitives.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // An own copy: Embree reads 16 bytes at the last vertex, and pads its own buffers.
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), world->positions.size()));
  auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), primitives.size()));
  if (vertices == nullptr || indices == nullptr) throw Error("rays", "out of memory");
  for (std::size_t i = 0; i < world->positions.size(); ++i) {
    // Vertices of dropped triangles may be anything; Embree asserts finite ones.
    const Vec3& p = world->positions[i];
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    const Vec3 q = finite ? p : Vec3(0);
    std::memcpy(vertices + 3 * i, &q, sizeof q);
  }
  for (std::size_t i = 0; i < primitives.size(); ++i)
    std::memcpy(indices + 3 * i, world->triangles[primitives[i]].v.data(), sizeof(Triangle));
  if (masked) {
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryIntersectFilterFunction(geometry, &State::filter);
    rtcSetGeometryOccludedFilterFunction(geometry, &State::filter);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(rtc, geometry, masked ? 1 : 0);
  rtcReleaseGeometry(geometry);
}

void Tracer::State::filter(const RTCFilterFunctionNArguments* args) {
  const auto& self = *static_cast<const State*>(args->geometryUserPtr);
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const uint32_t triangle = self.triangles[1][RTCHitN_primID(args->hit, 1, 0)];
  const Vec2 b(RTCHitN_u(args->hit, 1, 0), RTCHitN_v(args->hit, 1, 0));
  const Material& material = (*self.scene)[self.world->materials[triangle]];
  if (shade(*self.scene, *self.world, triangle, b).alpha < material.alpha_cutoff) args->valid[0] = 0;
}

Tracer::Tracer(const Scene& scene, const World& world) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.scene = &scene;
  s.world = &world;
  s.device = rtcNewDevice(nullptr);
  if (s.device == nullptr) throw Error("rays", "Embree cannot be started");
  s.rtc = rtcNewScene(s.device);
  // Without ROBUST rays leak along the diagonals of large quads.
  rtcSetSceneFlags(s.rtc, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(s.rtc, RTC_BUILD_QUALITY_HIGH);
  for (uint32_t t = 0; t < world.size(); ++t) {
    const Material& material = scene[world.materials[t]];
    s.triangles[material.alpha_mode == Material::Alpha::mask ? 1 : 0].push_back(t);
  }
  s.add(s.triangles[0], false);
  s.add(s.triangles[1], true);
  rtcCommitScene(s.rtc);
  panes_ = std::any_of(world.materials.begin(), world.materials.end(),
                       [&](Id<Material> m) { return scene.passes(scene[m]); });
  if (rtcGetDeviceError(s.device) != RTC_ERROR_NONE)
    throw Error("rays", "Embree cannot build the scene (out of memory?)");
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

namespace {

bool valid(const Ray& ray) {
  const auto finite = [](const Vec3& v) { return std::isfinite(v.x + v.y + v.z); };
  return finite(ray.origin) && finite(ray.direction) && ray.far >= 0 && ray.near >= 0;
}

void fill(RTCRay& out, const Ray& ray) {
  out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
  out.tnear = ray.near, out.tfar = ray.far;
  out.time = 0, out.mask = 0xffffffffu, out.id = 0, out.flags = 0;
}

}  // namespace

Hit Tracer::closest(const Ray& ray) const {
  if (!valid(ray)) return {};  // Debian's Embree aborts on such rays
  RTCRayHit query;
  fill(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->rtc, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  Hit hit;
  hit.triangle = state_->triangles[query.hit.geomID][query.hit.primID];
  hit.barycentric = Vec2(query.hit.u, query.hit.v);
  hit.distance = query.ray.tfar;
  hit.back = glm::dot(state_->world->face_normals[hit.triangle], ray.direction) > 0;
  return hit;
}

bool Tracer::occluded(const Ray& ray) const {
  if (!valid(ray)) return false;
  RTCRay query;
  fill(query, ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->rtc, &context, &query);
  return query.tfar < 0;
}

Passing Tracer::passing_pane(const Hit& hit) const {
  const Scene& scene = *state_->scene;
  const Material& material = scene[state_->world->materials[hit.triangle]];
  if (!scene.passes(material)) return {};
  return sconce::passing(material, shade(scene, *state_->world, hit.triangle, hit.barycentric));
}

Ray Tracer::beyond(const Ray& ray, const Hit& hit) const {
  Ray rest = ray;
  // As offset_origin() moves: by what rounding may be off there, so that no pane is met twice.
  const Vec3 at = glm::abs(ray.origin) + hit.distance * glm::abs(ray.direction);
  rest.near = hit.distance + std::max({at.x, at.y, at.z, 1e-2f}) * 0x1p-19f;
  return rest;
}

Rgb Tracer::through_panes(Ray ray) const {
  Rgb product(1.0f);
  while (!product.is_black() && ray.near < ray.far) {
    const Hit hit = closest(ray);
    if (!hit) return product;
    product *= passing_pane(hit).rgb();
    ray = beyond(ray, hit);
  }
  return product;
}

Passage Tracer::onwards(Ray ray, Hit hit, float u) const {
  Passage out;
  for (; hit; hit = closest(ray)) {
    const Passing pass = passing_pane(hit);
    const float share = pass.share();
    if (!(u < share)) {
      out.hit = hit;
      break;
    }
    u = std::min(u / share, 0x1.fffffep-1f);
    out.factor *= pass.rgb() * (1 / share);
    ray = beyond(ray, hit);
  }
  return out;
}

std::string isa() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) return "x86-64 + avx512";
  if (__builtin_cpu_supports("avx2")) return "x86-64 + avx2";
  if (__builtin_cpu_supports("avx")) return "x86-64 + avx";
  return __builtin_cpu_supports("sse4.2") ? "x86-64 + sse4.2" : "x86-64 + sse2";
}

Vec3 offset_origin(const Vec3& position, const Vec3& face_normal, const Vec3& direction) {
  const float size = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z), 1e-2f});
  const Vec3 away = glm::dot(face_normal, direction) < 0 ? -face_normal : face_normal;
  // 2^-19 of the coordinates: some 16 ulps, which covers interpolation and Embree's own rounding.
  return position + away * (size * 0x1p-19f);
}

}  // namespace sconce
