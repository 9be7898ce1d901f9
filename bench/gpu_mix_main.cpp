// SPDX-License-Identifier: Apache-2.0
// The mix on whatever OpenGL draws here, against the bandwidth of the same device in the same run, and table
// 2 of system A's paper. Makes its own layers; needs neither a scene nor a display.
//   gpu_mix [SIDE]      side of the atlas in texels, default 2048
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "gpu/mix.h"
#include "layers.h"
#include "tone/tone.h"

using namespace sconce;

namespace {

constexpr int kWidth = 1920, kHeight = 1080;  // of the picture
constexpr double kSeconds = 0.5;              // spent on each row

/// Seconds of one of many in a row, best of some rows. Timer queries mean nothing where the processor draws.
template <class F>
double device_seconds(const gpu::Context& context, F work) {
  using Clock = std::chrono::steady_clock;
  const int row = context.capabilities().software ? 1 : 50;
  double best = 1e9, spent = 0;
  for (int round = 0; round < 100 && (round < 3 || spent < kSeconds); ++round) {
    glFinish();
    const auto start = Clock::now();
    for (int i = 0; i < row; ++i) work();
    glFinish();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    best = std::min(best, seconds / row);
    spent += seconds;
  }
  return best;
}

/// Bytes read and written per second by a copy of buffers larger than any cache: by the shader units, whose
/// copy engines may be slower.
double copy_bandwidth(const gpu::Context& context) {
  const GLsizeiptr bytes = context.capabilities().software ? 1 << 26 : 1 << 30;
  constexpr GLsizeiptr kPerGroup = 256 * 16;
  GLuint buffers[2];
  glCreateBuffers(2, buffers);
  for (GLuint i = 0; i < 2; ++i) {
    glNamedBufferStorage(buffers[i], bytes, nullptr, 0);
    glClearNamedBufferData(buffers[i], GL_R32F, GL_RED, GL_FLOAT, nullptr);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
  }
  const gpu::Program copy("copy", R"(#version 450 core
layout(local_size_x = 256) in;
layout(binding = 0) readonly buffer From { uvec4 from[]; };
layout(binding = 1) writeonly buffer To { uvec4 to[]; };
void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 256u + gl_LocalInvocationID.x;
  to[i] = from[i];
}
)");
  copy.use();
  constexpr GLuint kAcross = 1024;
  const auto groups = static_cast<GLuint>(bytes / kPerGroup);
  const double seconds = device_seconds(context, [&] { glDispatchCompute(kAcross, groups / kAcross, 1); });
  glDeleteBuffers(2, buffers);
  context.check("copying");
  return 2 * static_cast<double>(bytes) / seconds;
}

/// A picture that fills the target from page 0, toned as in the paper.
class Screen {
 public:
  explicit Screen(const gpu::Context& context)
      : context_(context),
        color_(context, {.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "picture"),
        target_(color_, 0) {
    glGenVertexArrays(1, &nothing_);
  }
  double seconds(const gpu::LightSource& light, bool toned) const {
    const std::string show = toned ? tone_glsl(find_tone_mapper("drago2006")) : "";
    const gpu::Program program(
        "picture", gpu::whole_target_vertex(),
        "#version 450 core\n" + light.glsl() + show + R"(
out vec4 color;
void main() {
  vec3 light = illuminance(gl_FragCoord.xy / vec2(1920.0, 1080.0), 0);
  color = vec4()" +
            (toned ? "linear_to_srgb(tone_map(light * 0.05, ToneParams(16.0, 0.18, 0.85)))" : "light") +
            ", 1.0);\n}\n");
    light.bind(program, 0);
    target_.use();
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(nothing_);
    program.use();
    return device_seconds(context_, [&] { glDrawArrays(GL_TRIANGLES, 0, 3); });
  }

 private:
  const gpu::Context& context_;
  gpu::Texture color_;
  gpu::Framebuffer target_;
  GLuint nothing_ = 0;
};

/// What the fallback hands to hardware without shaders.
class ByteLightmap : public gpu::LightSource {
 public:
  ByteLightmap(const gpu::Context& context, int side)
      : texture_(context, {.format = GL_RGBA8, .width = side, .height = side}, "lightmap") {}
  std::string glsl() const override {
    return "uniform sampler2D lightmap;\nvec3 illuminance(vec2 uv, int page) {\n  return texture(lightmap, "
           "uv).rgb;\n}\n";
  }
  void bind(const gpu::Program& program, int unit) const override {
    texture_.bind(unit);
    program.set("lightmap", unit);
  }

 private:
  gpu::Texture texture_;
};

void print_row(const std::string& what, double seconds, double moved, double bandwidth) {
  fmt::print("| {:<52} | {:8.3f} | {:7.1f} | {:7.0f} | {:6.2f} |\n", what, 1e3 * seconds, 1e-6 * moved,
             1e-9 * moved / seconds, seconds * bandwidth / moved);
}

void mix_table(const gpu::Context& context, double bandwidth, int side) {
  const ShaderTier& tier = find_shader_tier("half");
  fmt::print(
      "\n| mix                                                  | ms       | MB      | GB/s    | x copy |\n"
      "|---|---|---|---|---|\n");
  const Screen screen(context);
  for (const std::size_t groups : {4, 16})
    for (const char* encoding : {"f16", "rgbe8", "exp8", "lum:f16"}) {
      const std::vector<Rgb> weights(groups, Rgb(0.5f, 1, 0.75f));
      // Bytes as stored, read once; a picture or a page of halves written.
      const EncodedLayers at_screen = make_layers(groups, parse_encoding(encoding), kWidth, kHeight);
      const double moved = static_cast<double>(at_screen.bytes()) + 8.0 * kWidth * kHeight;
      const std::string name = fmt::format("{} x {}", groups, encoding);
      const gpu::AtlasMix drawn(context, at_screen, tier);
      print_row(name + ", 1920 x 1080 texels, fragment", device_seconds(context, [&] { drawn.mix(weights); }),
                moved, bandwidth);
      const gpu::AtlasMix computed(context, at_screen, tier, gpu::AtlasMix::Form::compute);
      print_row(name + ", 1920 x 1080 texels, compute",
                device_seconds(context, [&] { computed.mix(weights); }), moved, bandwidth);
      const EncodedLayers layers = make_layers(groups, parse_encoding(encoding), side, side);
      gpu::PixelMix pixel(context, layers, tier);
      pixel.set(weights);
      // A pixel looks at about one texel of each layer.
      const double seen =
          static_cast<double>(layers.bytes()) / side / side * kWidth * kHeight + 4.0 * kWidth * kHeight;
      print_row(name + fmt::format(", {}^2 atlas, per pixel of 1920 x 1080", side),
                screen.seconds(pixel, false), seen, bandwidth);
      const gpu::AtlasMix atlas(context, layers, tier, gpu::AtlasMix::Form::compute);
      print_row(name + fmt::format(", {}^2 atlas, compute", side),
                device_seconds(context, [&] { atlas.mix(weights); }),
                static_cast<double>(layers.bytes()) + 8.0 * side * side, bandwidth);
    }
}

void paper_table(const gpu::Context& context, int side) {
  const ShaderTier& tier = find_shader_tier("full");
  const Screen screen(context);
  const auto pixel = [&](std::size_t groups, const char* encoding) {
    gpu::PixelMix light(context, make_layers(groups, parse_encoding(encoding), side, side), tier);
    light.set(std::vector<Rgb>(groups, Rgb(1)));
    return screen.seconds(light, true);
  };
  fmt::print(
      "\n| table 2 of the paper, {}^2 atlas, 1920 x 1080   | texture memory | ms     | fps    "
      "|\n|---|---|---|---|\n",
      side);
  const auto row = [](const char* what, double memory, double seconds) {
    fmt::print("| {:<47} | {:14.1f} | {:6.3f} | {:6.0f} |\n", what, memory, 1e3 * seconds, 1 / seconds);
  };
  row("1: one group, 1 x RGBA16F", 1, pixel(1, "f16"));
  row("2: four groups, 4 x RGBA16F", 4, pixel(4, "f16"));
  row("3: four groups packed, 1 x RGBA16F", 1, pixel(4, "lum:f16"));
  row("4: toned on the CPU, 1 x RGBA8", 0.5, screen.seconds(ByteLightmap(context, side), false));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int side = argc > 1 ? std::stoi(argv[1]) : 2048;
    const gpu::Context context({.debug = false});
    const gpu::Capabilities& can = context.capabilities();
    const double bandwidth = copy_bandwidth(context);
    fmt::print("{}, OpenGL {}; copying a buffer: {:.0f} GB/s\n", can.renderer, can.version, 1e-9 * bandwidth);
    mix_table(context, bandwidth, side);
    paper_table(context, side);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "gpu_mix: {}\n", e.what());
    return 1;
  }
}
