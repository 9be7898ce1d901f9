// SPDX-License-Identifier: Apache-2.0
#include "detect/sconce_detect.h"

#include <fmt/format.h>

#include <cstring>

#include "core/c_message.h"
#include "core/error.h"
#include "detect/realtime.h"

using namespace sconce;

namespace {

constexpr uint32_t kNone = 0xffffffffu;

/// The host's triangles as a scene: a mesh for each material, whose vertices are those that it uses.
struct HostGeometry {
  Scene scene;
  std::vector<uint32_t> vertices;   ///< per vertex of the world: the host's
  std::vector<uint32_t> triangles;  ///< per triangle of the meshes, one after the other: the host's
  std::vector<uint32_t> first;      ///< per mesh: its first one

  explicit HostGeometry(const sconce_geometry& g) {
    uint32_t materials = 0;
    const auto material = [&](std::size_t t) { return g.materials != nullptr ? g.materials[t] : 0; };
    for (std::size_t t = 0; t < g.triangles; ++t) {
      materials = std::max(materials, material(t) + 1);
      for (std::size_t k = 0; k < 3; ++k)
        if (g.indices[3 * t + k] >= g.vertices)
          throw Error("geometry",
                      "triangle " + std::to_string(t) + " has vertex " + std::to_string(g.indices[3 * t + k]),
                      "less than " + std::to_string(g.vertices));
    }
    if (materials > g.triangles) throw Error("geometry", "more materials than triangles");
    std::vector<std::vector<uint32_t>> of(materials);
    for (std::size_t t = 0; t < g.triangles; ++t) of[material(t)].push_back(static_cast<uint32_t>(t));
    std::vector<uint32_t> local(g.vertices);
    for (uint32_t m = 0; m < materials; ++m) {
      Material named;
      named.name = "material " + std::to_string(m);
      scene.materials.push_back(named);
      Mesh mesh;
      mesh.material = Id<Material>(m);
      std::fill(local.begin(), local.end(), kNone);
      first.push_back(static_cast<uint32_t>(triangles.size()));
      for (const uint32_t t : of[m]) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          const uint32_t v = g.indices[3 * t + k];
          if (local[v] == kNone) {
            local[v] = static_cast<uint32_t>(mesh.positions.size());
            vertices.push_back(v);
            const auto at = [&](const float* all) {
              return Vec3(all[3 * v], all[3 * v + 1], all[3 * v + 2]);
            };
            mesh.positions.push_back(at(g.positions));
            if (g.normals != nullptr) mesh.normals.push_back(at(g.normals));
          }
          triangle.v[k] = local[v];
        }
        mesh.triangles.push_back(triangle);
        triangles.push_back(t);
      }
      scene.meshes.push_back(std::move(mesh));
      Instance instance;
      instance.mesh = Id<Mesh>(m);
      scene.instances.push_back(instance);
    }
  }

  /// The same vertices elsewhere.
  void place(const float* positions, const float* normals) {
    std::size_t next = 0;
    for (Mesh& mesh : scene.meshes)
      for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const std::size_t v = vertices[next++];
        mesh.positions[k] = Vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        if (!mesh.normals.empty() && normals != nullptr)
          mesh.normals[k] = Vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
      }
  }
};

sconce_lobe in_c(const Lobe& lobe) {
  return {lobe.halfway ? SCONCE_LOBE_BLINN : SCONCE_LOBE_PHONG,
          {lobe.diffuse.r, lobe.diffuse.g, lobe.diffuse.b},
          {lobe.strength.r, lobe.strength.g, lobe.strength.b},
          lobe.exponent,
          lobe.roughness(),
          lobe.residual};
}

}  // namespace

struct sconce_gi {
  sconce_gi(const sconce_geometry& g, sconce_draw draw, void* user, const sconce_gi_params& p)
      : geometry(g),
        world(make_world(geometry.scene)),
        tracer(geometry.scene, world),
        vertex_count(g.vertices),
        host{[this, draw, user](const DrawRequest& r) { return call(draw, user, r); },
             static_cast<TargetFormat>(p.target)} {
    if (draw == nullptr) throw Error("draw", "is no function");
    if (p.target < SCONCE_TARGET_LINEAR || p.target > SCONCE_TARGET_POWER8)
      throw Error("target", std::to_string(p.target), "SCONCE_TARGET_LINEAR, _SRGB8, _POWER8");
    const float texel = p.texel > 0 ? p.texel : world.bounds.diagonal() / 256;
    if (p.by_face < 0 || p.by_face > 2) throw Error("by_face", std::to_string(p.by_face), "0, 1, 2");
    detect_params.per = static_cast<DetectParams::Per>(p.by_face);
    detect_params.texel = texel;
    detect_params.lobes = p.lobes != 0;
    detection = detect_materials(geometry.scene, world, host, detect_params);
    TransferParams params;
    params.gather = p.samples > 0 ? static_cast<std::size_t>(p.samples) : 16384;
    if (p.rays > 0) params.rays = p.rays;
    params.keep_sums = true;
    params.movable = movable = p.movable != 0;
    if (p.milliseconds > 0) budget.milliseconds = static_cast<double>(p.milliseconds);
    std::vector<uint32_t> all(world.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const TracedScene traced{geometry.scene, world, tracer};
    radiosity = std::make_unique<RealtimeRadiosity>(traced, vertex_receivers(traced),
                                                    face_cells(all, texels_by_area(world, all, texel, 256)),
                                                    host, detection, params);
  }
  sconce_gi(const sconce_gi&) = delete;
  sconce_gi& operator=(const sconce_gi&) = delete;

  Drawing call(sconce_draw draw, void* user, const DrawRequest& r) const {
    std::vector<uint32_t> faces;
    std::vector<float> corners;
    for (std::size_t i = 0; i < r.triangles.size(); ++i) {
      const uint32_t t = r.triangles[i];
      faces.push_back(
          geometry.triangles[geometry.first[world.materials[t].value] + world.source_triangles[t]]);
      for (const Vec2& corner : r.corners[i]) corners.push_back(corner.x), corners.push_back(corner.y);
    }
    const Vec3& to = r.probe.to_light;
    Drawing drawing;
    drawing.width = r.width, drawing.height = r.height;
    const sconce_draw_request request{static_cast<int>(r.lights),
                                      {to.x, to.y, to.z},
                                      r.probe.intensity,
                                      {r.eye.x, r.eye.y, r.eye.z},
                                      r.white_card ? 1 : 0,
                                      r.background,
                                      r.width,
                                      r.height,
                                      faces.size(),
                                      faces.data(),
                                      corners.data(),
                                      &drawing.read_milliseconds};
    const std::size_t size = 3 * static_cast<std::size_t>(r.width) * static_cast<std::size_t>(r.height);
    void* pixels = nullptr;
    if (host.format == TargetFormat::linear)
      drawing.values.resize(size), pixels = drawing.values.data();
    else
      drawing.codes.resize(size), pixels = drawing.codes.data();
    if (const int code = draw(user, &request, pixels); code != 0)
      throw Error({}, "the function returned " + std::to_string(code), "0");
    return drawing;
  }

  HostGeometry geometry;
  World world;
  Tracer tracer;
  std::size_t vertex_count;
  HostRenderer host;
  DetectParams detect_params;
  FrameBudget budget;
  bool movable = false;
  Detection detection;
  std::unique_ptr<RealtimeRadiosity> radiosity;
};

sconce_gi* sconce_gi_create(const sconce_geometry* geometry, sconce_draw draw, void* user,
                            const sconce_gi_params* params, char* message, size_t message_size) {
  try {
    return new sconce_gi(*geometry, draw, user, params != nullptr ? *params : sconce_gi_params{});
  } catch (const std::exception& e) {
    copy_message(e.what(), message, message_size);
    return nullptr;
  }
}

void sconce_gi_destroy(sconce_gi* gi) {
  delete gi;
}

size_t sconce_gi_material_count(const sconce_gi* gi) {
  return gi->detection.materials.size();
}

void sconce_gi_material(const sconce_gi* gi, size_t material, sconce_material* out) {
  const DetectedMaterial& m = gi->detection.materials.at(material);
  const SurfaceResponse& r = m.response;
  *out = {{r.emission.r, r.emission.g, r.emission.b},
          {r.transmission.r, r.transmission.g, r.transmission.b},
          {r.reflectance.r, r.reflectance.g, r.reflectance.b},
          m.faces,
          m.residual,
          m.lambertian ? 1 : 0,
          m.lobe ? in_c(*m.lobe) : sconce_lobe{}};
}

int sconce_gi_detect(sconce_gi* gi, char* message, size_t message_size) {
  try {
    gi->detection = detect_materials(gi->geometry.scene, gi->world, gi->host, gi->detect_params);
    gi->radiosity->set_materials(gi->detection);
    return 0;
  } catch (const std::exception& e) {
    copy_message(e.what(), message, message_size);
    return 1;
  }
}

int sconce_gi_move(sconce_gi* gi, const float* positions, const float* normals, char* message,
                   size_t message_size) {
  const std::vector<Mesh> before = gi->geometry.scene.meshes;
  try {
    if (!gi->movable) throw UsageError("things that move", "a gi that stays", "sconce_gi_params::movable");
    gi->radiosity->wait();
    gi->geometry.place(positions, normals);
    World moved = make_world(gi->geometry.scene);
    if (moved.size() != gi->world.size())
      throw Error("geometry", fmt::format("{} triangles have an area", moved.size()),
                  fmt::format("as many as before: {}", gi->world.size()));
    gi->world = std::move(moved);
    gi->tracer = Tracer(gi->geometry.scene, gi->world);
    gi->radiosity->follow();
    return 0;
  } catch (const std::exception& e) {
    gi->geometry.scene.meshes = before;
    copy_message(e.what(), message, message_size);
    return 1;
  }
}

int sconce_gi_update(sconce_gi* gi, float* ambient, sconce_frame* frame, char* message, size_t message_size) {
  const FrameReport report = gi->radiosity->update(gi->budget);
  if (frame != nullptr)
    *frame = {report.capture.milliseconds,
              report.capture.read_milliseconds,
              report.solve_milliseconds,
              report.following ? 1 : 0,
              report.coarse,
              report.clipped};
  std::fill(ambient, ambient + 3 * gi->vertex_count, 0.0f);
  const std::span<const Rgb> light = gi->radiosity->ambient();
  // A vertex that several materials use has the light of the last of them.
  for (std::size_t v = 0; v < light.size(); ++v) {
    float* out = ambient + 3 * gi->geometry.vertices[v];
    out[0] = light[v].r, out[1] = light[v].g, out[2] = light[v].b;
  }
  if (report) return 0;
  copy_message(report.fault.c_str(), message, message_size);
  return 1;
}
