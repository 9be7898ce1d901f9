// SPDX-License-Identifier: Apache-2.0
// A renderer by OpenGL with shaders of its own, as a host of `detect`: it answers as the same renderer on the
// processor does, its shaders may change while it runs, its state stays its own, and what goes wrong is told
// while it goes on.
#include <epoxy/egl.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "detect/realtime.h"
#include "detect/synthetic_host.h"
#include "gpu/framebuffer.h"
#include "gpu/kept_state.h"
#include "gpu/program.h"
#include "scene/shapes.h"
#include "shader/vertex_override.h"

namespace sconce {
namespace {

const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat3 camera;
out vec3 at, n, rho;
void main() {
  at = position, n = normal, rho = color;
  vec3 seen = camera * position;
  gl_Position = vec4(seen.xy, 0.1 * seen.z, -seen.z);
}
)";

// Lamps are looked up by the pixel's tile where `tiled` is 1, as clustered renderers do.
const char* kFragment = R"(#version 330 core
in vec3 at, n, rho;
uniform vec3 lamp, strength, probe;
uniform float probe_strength, white_card, tiled;
uniform sampler2D lists;
out vec4 shown;
float falloff(float distance) { return 1.0; }
void main() {
  vec3 to = lamp - at;
  float distance = length(to);
  bool listed = tiled < 0.5 || texelFetch(lists, ivec2(gl_FragCoord.xy) / 16, 0).r > 0.5;
  vec3 light = probe_strength * vec3(max(dot(n, probe), 0.0));
  if (listed) light += strength * max(dot(n, to) / distance, 0.0) * falloff(distance);
  shown = vec4(light * mix(rho, vec3(1.0), white_card), 1.0);
}
)";

constexpr int kTiles = 64;  // a side

class GlHost {
 public:
  GlHost(const gpu::Context& context, const World& world, std::vector<Rgb> colors)
      : context_(context),
        world_(world),
        colors_(std::move(colors)),
        lists_(context, {.format = GL_R32F, .width = kTiles, .height = kTiles}, "lists") {
    // The one lamp is in the lists of some tiles around the screen's middle: a tenth of all.
    std::vector<float> listed(kTiles * kTiles);
    for (int i = 0; i < kTiles * kTiles; ++i)
      listed[static_cast<std::size_t>(i)] =
          std::hypot(i % kTiles - kTiles / 2, i / kTiles - kTiles / 2) < 0.18 * kTiles ? 1 : 0;
    lists_.upload(GL_RED, GL_FLOAT, listed.data());
    glGenVertexArrays(1, &array_), glGenBuffers(1, &buffer_);
  }

  std::string vertex = kVertex, fragment = kFragment;
  Vec3 lamp{0.5f, 0.5f, 0.5f};
  float strength = 1;
  bool tiled = false, idle = false;
  std::function<void()> spoil = [] {};  ///< done in every drawing

  Drawing draw(const DrawRequest& request) const {
    const gpu::Program program("walls", override_vertex_position(vertex, "walls.vert", {.location = 3}),
                               fragment);
    std::vector<float> vertices;
    for (std::size_t i = 0; i < request.triangles.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const uint32_t t = request.triangles[i];
        const Vec3 &p = world_.positions[world_.triangles[t].v[c]], &n = world_.face_normals[t];
        const Rgb& color = colors_[world_.materials[t].value];
        const Vec2 place = request.corners[i][c] / Vec2(request.width, request.height);
        vertices.insert(vertices.end(),
                        {p.x, p.y, p.z, n.x, n.y, n.z, color.r, color.g, color.b, place.x, place.y});
      }
    const gpu::Texture picture(
        context_, {.format = GL_RGBA32F, .width = request.width, .height = request.height}, "faces");
    const gpu::Framebuffer target(picture, 0);
    target.use();
    glClearColor(request.background, request.background, request.background, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST), glDisable(GL_CULL_FACE), glDisable(GL_BLEND), glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
                 GL_STREAM_DRAW);
    for (GLuint k = 0; k < 4; ++k) {
      glEnableVertexAttribArray(k);
      glVertexAttribPointer(k, k < 3 ? 3 : 2, GL_FLOAT, GL_FALSE, 11 * sizeof(float),
                            reinterpret_cast<const void*>(3 * k * sizeof(float)));
    }
    program.use();
    lists_.bind(0);
    program.set("lists", 0), program.set("tiled", tiled ? 1.0f : 0.0f);
    program.set("sconce_in_faces", 1.0f), program.set("white_card", request.white_card ? 1.0f : 0.0f);
    program.set("lamp", lamp), program.set("probe", request.probe.to_light);
    program.set("strength", request.lights == DrawRequest::Lights::all ? Vec3(strength) : Vec3(0));
    program.set("probe_strength",
                request.lights == DrawRequest::Lights::probe ? request.probe.intensity : 0.0f);
    if (!idle) glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * request.triangles.size()));
    Drawing drawing{request.width, request.height, std::vector<float>(3 * request.pixels()), {}};
    target.read(GL_RGB, GL_FLOAT, drawing.values.data());
    spoil();
    return drawing;
  }
  HostRenderer renderer() const {
    return {[this](const DrawRequest& r) { return gpu::keep_state([&] { return draw(r); }); }};
  }

 private:
  const gpu::Context& context_;
  const World& world_;
  std::vector<Rgb> colors_;
  gpu::Texture lists_;
  GLuint array_ = 0, buffer_ = 0;
};

class GlRenderer : public testing::Test {
 protected:
  static Scene room() {
    Scene scene;
    add_box(scene, "room", add_material(scene, "walls", Rgb(0.5f)), Vec3(0), Vec3(1), true);
    add_box(scene, "crate", add_material(scene, "crate", Rgb(0.5f)), Vec3(0.1f, 0, 0.1f),
            Vec3(0.4f, 0.3f, 0.5f), false);
    return scene;
  }
  GlRenderer() {
    twin_.unit = 1, twin_.attenuation = false;
    twin_.lamps = {{host_.lamp, Rgb(1)}};
  }
  std::unique_ptr<RealtimeRadiosity> radiosity(const HostRenderer& renderer) {
    const TracedScene& traced = traced_;
    std::vector<uint32_t> all(world_.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    TransferParams params;
    params.gather = 1024, params.rays = 64, params.lights = 48, params.keep_sums = true, params.cluster = 64;
    return std::make_unique<RealtimeRadiosity>(traced, vertex_receivers(traced),
                                               face_cells(all, texels_by_area(world_, all, 0.1f, 64)),
                                               renderer, detect_materials(scene_, world_, renderer), params);
  }
  static double mean(const RealtimeRadiosity& radiosity) {
    double sum = 0;
    for (const Rgb& light : radiosity.ambient()) sum += static_cast<double>(light.r + light.g + light.b);
    return sum;
  }
  static void expect_alike(const RealtimeRadiosity& a, const RealtimeRadiosity& b) {
    ASSERT_GT(mean(b), 0);
    for (std::size_t i = 0; i < b.ambient().size(); ++i)
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
        ASSERT_NEAR(a.ambient()[i].*channel, b.ambient()[i].*channel,
                    2e-3f * b.ambient()[i].*channel + 1e-5f);
  }

  const std::vector<Rgb> colors_{Rgb(0.7f, 0.5f, 0.3f), Rgb(0.2f, 0.6f, 0.4f)};
  const Scene scene_ = room();
  const World world_ = make_world(scene_);
  const Tracer tracer_{scene_, world_};
  const TracedScene traced_{scene_, world_, tracer_};
  gpu::Context context_;
  GlHost host_{context_, world_, colors_};
  SyntheticHost twin_{world_, {{{Rgb(), Rgb(), colors_[0]}}, {{Rgb(), Rgb(), colors_[1]}}}};
};

TEST_F(GlRenderer, AnswersAsItsTwinAndShadersMayChange) {
  const auto here = radiosity(host_.renderer()), there = radiosity(twin_.renderer());
  ASSERT_TRUE(here->update()) << here->update().fault;
  ASSERT_TRUE(there->update());
  expect_alike(*here, *there);
  const double before = mean(*here);
  // Another shader, and nothing is made again.
  const std::string even = "return 1.0;";
  host_.fragment.replace(host_.fragment.find(even), even.size(), "return 1.0 / (distance * distance);");
  twin_.attenuation = true;
  ASSERT_TRUE(here->update());
  ASSERT_TRUE(there->update());
  expect_alike(*here, *there);
  EXPECT_GT(mean(*here), 1.5 * before);
  context_.check("drawing");
}

// The light of a face depends on where it is drawn, whatever its material: detected, and told.
TEST_F(GlRenderer, ListsByTheScreenDoNotFit) {
  const Detection fits = detect_materials(scene_, world_, host_.renderer());
  EXPECT_TRUE(fits.findings.empty()) << fits.findings.front();
  EXPECT_LT(fits.placement, 1e-3f);
  host_.tiled = true;
  const Detection found = detect_materials(scene_, world_, host_.renderer());
  EXPECT_GT(found.placement, 0.5f);
  ASSERT_EQ(found.findings.size(), 1u);
  EXPECT_NE(
      found.findings[0].find("renderers that look lights up by the screen (clusters, tiles) do not fit"),
      std::string::npos);
}

TEST_F(GlRenderer, KeepsItsState) {
  const auto made = radiosity(host_.renderer());
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glViewport(1, 2, 3, 4);
  glEnable(GL_DEPTH_TEST), glEnable(GL_BLEND);
  glUseProgram(0);
  ASSERT_TRUE(made->update());
  const auto number = [](GLenum name) {
    GLint values[4]{};
    glGetIntegerv(name, values);
    return values[0];
  };
  EXPECT_EQ(number(GL_VERTEX_ARRAY_BINDING), static_cast<GLint>(array));
  EXPECT_EQ(number(GL_VIEWPORT), 1);
  EXPECT_EQ(number(GL_DRAW_FRAMEBUFFER_BINDING), 0);
  EXPECT_EQ(number(GL_CURRENT_PROGRAM), 0);
  EXPECT_EQ(number(GL_TEXTURE_BINDING_2D), 0);
  EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST) && glIsEnabled(GL_BLEND));
}

TEST_F(GlRenderer, GoesOnWithoutBounces) {
  const auto made = radiosity(host_.renderer());
  ASSERT_TRUE(made->update());
  const double lit = mean(*made);
  const auto fault = [&](const std::string& line, const std::function<void()>& begin,
                         const std::function<void()>& end) {
    begin();
    const FrameReport report = made->update();
    EXPECT_EQ(report.fault.substr(0, line.size()), line);
    EXPECT_EQ(report.fault.find('\n'), std::string::npos);
    EXPECT_EQ(mean(*made), 0) << line;
    end();
    ASSERT_TRUE(made->update());
    EXPECT_EQ(mean(*made), lit) << line;
  };
  const std::string of = "the renderer's drawing of direct light: ";
  const EGLDisplay display = eglGetCurrentDisplay();
  const EGLContext context = eglGetCurrentContext();
  const auto well = [&] { host_.spoil = [] {}; };
  fault(
      of + "the OpenGL context: is lost, or another one was made current",
      [&] { host_.spoil = [&] { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }; },
      [&] { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), well(); });
  fault(
      of + "walls.vert:7: main takes parameters (allowed: void main())",
      [&] { host_.vertex.replace(host_.vertex.find("main()"), 6, "main(int x)"); },
      [&] { host_.vertex = kVertex; });
  fault(
      of + "shader 'walls': line ", [&] { host_.fragment += "nonsense"; },
      [&] { host_.fragment = kFragment; });
  fault(
      of + "shows none of the faces", [&] { host_.idle = true; }, [&] { host_.idle = false; });
  fault(
      of + "out of memory", [&] { host_.spoil = [] { throw std::runtime_error("out of memory"); }; }, well);
  fault(
      of + "has the value ", [&] { host_.strength = NAN; }, [&] { host_.strength = 1; });
}

}  // namespace
}  // namespace sconce
