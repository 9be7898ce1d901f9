// SPDX-License-Identifier: Apache-2.0
// The mix on whatever OpenGL draws here, against the bandwidth of the same device in the same run, and table
// 2 of system A's paper. Makes its own layers; needs neither a scene nor a display.
//   gpu_mix [SIDE]      side of the atlas in texels, default 2048
#include <fmt/format.h>

#include "device.h"
#include "gpu/mix.h"
#include "layers.h"
#include "tone/tone.h"

using namespace sconce;

namespace {

constexpr int kWidth = 1920, kHeight = 1080;  // of the picture

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
  vec3 light = illuminance(gl_FragCoord.xy / vec2(1920.0, 1080.0), 0, vec3(0.0));
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
    return "uniform sampler2D lightmap;\nvec3 illuminance(vec2 uv, int page, vec3 offset) {\n  return "
           "texture(lightmap, "
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
      const gpu::AtlasMix drawn(context, at_screen, tier, gpu::AtlasMix::Form::fragment);
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
