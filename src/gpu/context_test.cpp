// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include "core/error.h"
#include "gpu/test_context.h"

namespace sconce::gpu {
namespace {

class Gl : public GlTest {
 protected:
  template <class F>
  static void expect_error(F f, const std::string& said) {
    try {
      f();
      ADD_FAILURE() << "no error; expected: " << said;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(said), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
};

TEST_F(Gl, TellsWhatItCanDo) {
  const Capabilities& can = context_.capabilities();
  EXPECT_FALSE(can.renderer.empty());
  // What OpenGL 4.5 guarantees.
  EXPECT_GE(can.max_texture_size, 16384);
  EXPECT_GE(can.max_array_layers, 2048);
  EXPECT_GE(can.max_units, 16);
  EXPECT_TRUE(can.float_linear && can.float_target && can.half_target && can.bc6h);
}

TEST_F(Gl, ShadersThatDoNotCompileShowTheLine) {
  const std::string text = "#version 450 core\nout vec4 color;\nvoid main() {\n  color = nonsense(1.0);\n}\n";
  expect_error([&] { Program("mix", whole_target_vertex(), text); },
               "shader 'mix': line 4: `color = nonsense(1.0);`: ");
}

TEST_F(Gl, ShadersThatDoNotLinkSaySo) {
  const std::string text =
      "#version 450 core\nin vec3 missing;\nout vec4 color;\nvoid main() { color = missing.xyzz; }\n";
  expect_error([&] { Program("mix", whole_target_vertex(), text); }, "shader 'mix': cannot be linked: ");
}

TEST_F(Gl, TexturesAboveTheLimitSaySo) {
  const int limit = context_.capabilities().max_texture_size;
  expect_error([&] { Texture(context_, {.width = limit + 1}, "lightmap"); },
               "lightmap: " + std::to_string(limit + 1) + " x 1 is too large for ");
  const int layers = context_.capabilities().max_array_layers;
  expect_error([&] { Texture(context_, {.layers = layers + 1}, "lightmap"); },
               std::to_string(layers + 1) + " layers are too many for ");
}

TEST_F(Gl, MisuseIsAnErrorOnce) {
  glEnable(0xdead);
  expect_error([&] { context_.check("testing"); }, "error 1280 while testing");
  context_.check("testing");
}

// libepoxy's functions are variables: a device that is lost, for once.
TEST_F(Gl, LostDeviceIsAnError) {
  const auto real = epoxy_glGetGraphicsResetStatus;
  epoxy_glGetGraphicsResetStatus = []() -> GLenum { return GL_UNKNOWN_CONTEXT_RESET; };
  expect_error([&] { context_.check("mixing"); },
               "OpenGL: the graphics device was lost (reset or removed) while mixing");
  epoxy_glGetGraphicsResetStatus = real;
}

TEST_F(Gl, TargetsGiveBackWhatWasDrawn) {
  const std::vector<Rgb> colors{{1, 2, 3}, {-4, 1e-6f, 1e6f}};
  EXPECT_EQ(apply("vec3 apply(vec3 c) { return 2.0 * c; }", colors),
            (std::vector<Rgb>{{2, 4, 6}, {-8, 2e-6f, 2e6f}}));
}

}  // namespace
}  // namespace sconce::gpu
