// SPDX-License-Identifier: Apache-2.0
// The smallest renderer that mixes a package's light groups itself: plain OpenGL, one triangle.
//
//   gl_mix NAME.sconce OUT.png [WEIGHT...]
//
// draws page 0 of the lightmap with the given weights (one per light group, in the order of `sconce info`),
// as a white wall would show it. A real renderer draws its meshes instead, with their lightmap coordinates
// and albedo.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "gpu/context.h"
#include "image/io.h"
#include "package/package.h"
#include "shader/composer.h"

using namespace sconce;

namespace {

constexpr int kSide = 512;  // pixels of the picture

// A triangle that covers the picture; sconce_uv are lightmap coordinates.
constexpr const char* kVertexShader = R"(#version 450 core
out vec2 sconce_uv;
void main() {
  sconce_uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  gl_Position = vec4(sconce_uv * 2.0 - 1.0, 0.0, 1.0);
})";

GLuint compile(GLenum stage, const std::string& text) {
  const GLuint shader = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) throw Error({}, "a shader does not compile");
  return shader;
}

// Step 2: a texture as the shader wants it. What is stored is what is uploaded; codes are decoded in the
// shader.
GLuint upload(const EncodedImage& image, int plane, bool linear) {
  const Encoding& e = *image.encoding;
  const std::size_t channels = e.channels_of(image.channels);
  const std::byte* data = image.data.data() + static_cast<std::size_t>(plane) *
                                                  e.plane_bytes(image.width, image.height, image.channels);
  constexpr GLenum kLayouts[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr GLenum kBytes[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
  constexpr GLenum kHalves[] = {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F};
  constexpr GLenum kFloats[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  switch (e.type) {
    case TexelType::u8:
      glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kBytes[channels - 1]), image.width, image.height, 0,
                   kLayouts[channels - 1], GL_UNSIGNED_BYTE, data);
      break;
    case TexelType::f16:
      glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kHalves[channels - 1]), image.width, image.height, 0,
                   kLayouts[channels - 1], GL_HALF_FLOAT, data);
      break;
    case TexelType::f32:
      glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(kFloats[channels - 1]), image.width, image.height, 0,
                   kLayouts[channels - 1], GL_FLOAT, data);
      break;
    case TexelType::bc6h:
      glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, image.width,
                             image.height, 0, static_cast<GLsizei>(image.data.size()), data);
      break;
  }
  const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

void run(const std::string& input, const std::string& output, const std::vector<float>& weights) {
  const Package package = Package::open(input);
  const Manifest& m = package.manifest();

  // Step 1: the shader for just these textures. Offline, `sconce shader` writes the same text.
  ShaderSpec spec;
  spec.textures = package.textures();
  spec.groups = m.groups.size();
  spec.pages = m.pages;
  spec.target = &find_shader_target("glsl450");
  spec.tier = &find_shader_tier("full");
  spec.tone = &find_tone_mapper("agx");
  spec.units = 1 << 10;  // one plain texture each
  const ComposedShader shader = compose(spec);

  const gpu::Context context;  // your renderer has one
  const GLuint program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, kVertexShader));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, shader.text));
  glLinkProgram(program);
  glUseProgram(program);

  for (std::size_t i = 0; i < shader.samplers.size(); ++i) {
    const ShaderSampler& sampler = shader.samplers[i];
    const ShaderSampler::Slice& slice = sampler.slices.front();
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    upload(package.encoded(spec.textures[slice.texture], 0), slice.plane, sampler.linear);
    glUniform1i(glGetUniformLocation(program, sampler.name.c_str()), static_cast<GLint>(i));
  }

  // Step 3: what a fader changes. A group whose luminance is packed brings its colour along.
  double mean = 0;
  for (const LayerTexture& texture : spec.textures)
    for (const std::size_t g : texture.groups) {
      const float w = g < weights.size() ? weights[g] : 1.0f;
      const Rgb c = (texture.encoding.luminance ? m.groups[g].color : Rgb(1)) * w;
      mean += static_cast<double>(w) * m.groups[g].mean_lux;
      const std::string name = fmt::format("sconce_weight[{}]", g);
      glUniform3f(glGetUniformLocation(program, name.c_str()), c.r, c.g, c.b);
    }
  // A white wall, the mean exposed to middle grey.
  const float exposure = mean > 0 ? kMiddleGrey * 3.14159265f / static_cast<float>(mean) : 1.0f;
  glUniform3f(glGetUniformLocation(program, "sconce_albedo"), 1, 1, 1);
  glUniform1f(glGetUniformLocation(program, "sconce_exposure"), exposure);

  // Step 4: draw.
  GLuint target = 0, framebuffer = 0, vertices = 0;
  glGenRenderbuffers(1, &target);
  glBindRenderbuffer(GL_RENDERBUFFER, target);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kSide, kSide);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  glViewport(0, 0, kSide, kSide);
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  Image8 picture{kSide, kSide, 3, std::vector<unsigned char>(3 * kSide * kSide)};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kSide, kSide, GL_RGB, GL_UNSIGNED_BYTE, picture.data.data());
  context.check("drawing");
  write_png(output, picture);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3) throw UsageError({}, "usage: gl_mix NAME.sconce OUT.png [WEIGHT...]");
    std::vector<float> weights;
    for (int i = 3; i < argc; ++i) weights.push_back(std::stof(argv[i]));
    run(argv[1], argv[2], weights);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "gl_mix: {}\n", e.what());
    return 1;
  }
}
