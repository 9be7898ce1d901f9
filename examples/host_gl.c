/* SPDX-License-Identifier: Apache-2.0 */
/* The smallest engine that shows a mixed lightmap: plain OpenGL and sconce.h, nothing else of sconce.
 *
 *   host_gl NAME.sconce OUT.ppm [GROUP=SETTING...]
 *
 * draws page 0 as a white wall would show it. An engine draws its meshes instead, with their lightmap
 * coordinates and albedo. */
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <sconce.h>
#include <stdio.h>
#include <stdlib.h>
enum { SIDE = 512 }; /* pixels of the picture */

/* A triangle that covers the picture; sconce_uv are lightmap coordinates. */
static const char* const vertex_text =
    "#version 450 core\n"
    "out vec2 sconce_uv;\n"
    "void main() {\n"
    "  sconce_uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;\n"
    "  gl_Position = vec4(sconce_uv * 2.0 - 1.0, 0.0, 1.0);\n"
    "}\n";

static void fail(const char* message) {
  fprintf(stderr, "host_gl: %s\n", message);
  exit(1);
}

/* OpenGL 4.5 without a window; an engine has it. */
static void start_opengl(void) {
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API)) fail("there is no OpenGL");
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) fail("there is no OpenGL 4.5");
}

static void attach(GLuint program, GLenum stage, const char* text) {
  const GLuint shader = glCreateShader(stage);
  GLint good = 0;
  glShaderSource(shader, 1, &text, NULL);
  glCompileShader(shader);
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) fail("a shader does not compile");
  glAttachShader(program, shader);
}

/* Uploads what a sampler wants; codes are decoded in the shader. */
static void upload(sconce_shader* shader, size_t index, const sconce_texture* t, const sconce_atlas* atlas) {
  static const GLenum layouts[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA},
                      types[] = {GL_FLOAT, GL_HALF_FLOAT, GL_UNSIGNED_BYTE},
                      formats[3][4] = {{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F},
                                       {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F},
                                       {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8}};
  const int w = atlas->width, h = atlas->height, blocks = t->texels == SCONCE_TEXELS_BC6H;
  const GLenum target = t->array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  const GLenum layout = layouts[t->channels - 1], type = types[blocks ? 0 : t->texels];
  const GLenum format = blocks ? GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT : formats[t->texels][t->channels - 1];
  GLuint texture = 0;
  glCreateTextures(target, 1, &texture);
  if (t->array)
    glTextureStorage3D(texture, 1, format, w, h, t->images);
  else
    glTextureStorage2D(texture, 1, format, w, h);
  for (int i = 0; i < (t->array ? t->images : 1); ++i) { /* of plain textures page 0 */
    size_t bytes;
    const void* texels = sconce_shader_texels(shader, index, i, &bytes);
    if (t->array && blocks)
      glCompressedTextureSubImage3D(texture, 0, 0, 0, i, w, h, 1, format, (GLsizei)bytes, texels);
    else if (t->array)
      glTextureSubImage3D(texture, 0, 0, 0, i, w, h, 1, layout, type, texels);
    else if (blocks)
      glCompressedTextureSubImage2D(texture, 0, 0, 0, w, h, format, (GLsizei)bytes, texels);
    else
      glTextureSubImage2D(texture, 0, 0, 0, w, h, layout, type, texels);
  }
  const GLint filter = t->linear ? GL_LINEAR : GL_NEAREST;
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, filter);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTextureUnit((GLuint)index, texture);
}

int main(int argc, char** argv) {
  char message[512];
  if (argc < 3) fail("usage: host_gl NAME.sconce OUT.ppm [GROUP=SETTING...]");

  /* Once: the package, the shader for its textures, and those. */
  sconce_package* package = sconce_package_open(argv[1], message, sizeof message);
  if (package == NULL) fail(message);
  const sconce_atlas atlas = sconce_package_atlas(package);
  const size_t groups = sconce_package_group_count(package);
  const sconce_shader_params params = {0};
  sconce_shader* shader = sconce_shader_compose(package, &params, message, sizeof message);
  if (shader == NULL) fail(message);

  start_opengl();
  const GLuint program = glCreateProgram();
  attach(program, GL_VERTEX_SHADER, vertex_text);
  attach(program, GL_FRAGMENT_SHADER, sconce_shader_text(shader));
  glLinkProgram(program);
  glUseProgram(program);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  sconce_texture texture;
  for (size_t i = 0; sconce_shader_texture(shader, i, &texture) == 0; ++i) {
    upload(shader, i, &texture, &atlas);
    glUniform1i(glGetUniformLocation(program, texture.sampler), (GLint)i);
  }

  /* When a fader moves: its weight. */
  float* weights = malloc(3 * groups * sizeof *weights);
  if (sconce_package_weights(package, (const char* const*)argv + 3, (size_t)argc - 3, NULL, weights, message,
                             sizeof message) != 0)
    fail(message);
  double mean = 0; /* lux, of a white wall */
  for (size_t i = 0; i < groups; ++i) {
    sconce_group group;
    sconce_package_group(package, i, &group);
    mean += group.mean_lux *
            (0.2126 * weights[3 * i] + 0.7152 * weights[3 * i + 1] + 0.0722 * weights[3 * i + 2]);
  }
  sconce_shader_weights(shader, weights, weights);
  glUniform3fv(glGetUniformLocation(program, "sconce_weight"), (GLsizei)groups, weights);
  glUniform3f(glGetUniformLocation(program, "sconce_albedo"), 1, 1, 1);
  /* The mean becomes middle grey. */
  glUniform1f(glGetUniformLocation(program, "sconce_exposure"),
              mean > 0 ? (float)(0.18 * 3.14159265 / mean) : 1);

  /* Every frame. */
  GLuint target = 0, framebuffer = 0, vertices = 0;
  glCreateRenderbuffers(1, &target);
  glNamedRenderbufferStorage(target, GL_RGBA8, SIDE, SIDE);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  glViewport(0, 0, SIDE, SIDE);
  glGenVertexArrays(1, &vertices); /* empty */
  glBindVertexArray(vertices);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  static unsigned char pixels[3 * SIDE * SIDE]; /* v = 0 is drawn at the bottom and read first */
  glReadPixels(0, 0, SIDE, SIDE, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  FILE* out = fopen(argv[2], "wb");
  if (out == NULL || glGetError() != GL_NO_ERROR) fail("the picture cannot be drawn or written");
  fprintf(out, "P6 %d %d 255\n", SIDE, SIDE);
  if (fwrite(pixels, sizeof pixels, 1, out) != 1 || fclose(out) != 0) fail("the picture cannot be written");
  sconce_shader_free(shader), sconce_package_close(package), free(weights);
  return 0;
}
