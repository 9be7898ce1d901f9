// SPDX-License-Identifier: Apache-2.0
#include "gpu/lamp_program.h"

#include <algorithm>
#include <regex>

#include "core/error.h"
#include "core/text.h"
#include "gpu/seen_surfaces.h"
#include "image/io.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kHead =
#include "gpu/lamp_head.glsl.h"
    ;
constexpr std::string_view kFilter =
#include "gpu/shadow_filter.glsl.h"
    ;
constexpr std::string_view kShadow =
#include "gpu/shadow.glsl.h"
    ;
constexpr std::string_view kArriving =
#include "gpu/lamp_arriving.glsl.h"
    ;
constexpr std::string_view kPoints =
#include "gpu/lamp_points.glsl.h"
    ;
constexpr std::string_view kPixels =
#include "gpu/lamp_pixels.glsl.h"
    ;

std::string whole(std::string_view text, const std::string& given, std::string_view end) {
  std::string out(kHead);
  out += "#line " + std::to_string(ShaderPart::kFirstLine) + "\n";
  out += text;
  out += "\n";
  for (const std::string_view more : {std::string_view(given), kFilter, kShadow, kArriving, end}) out += more;
  return out;
}

/// A text without light() would be blamed on ours, which calls it.
const ShaderPart& checked(const ShaderPart& part) {
  static const std::regex light(R"(\bvec3\s+light\s*\(\s*(in\s+)?vec3\s+\w+\s*,\s*(in\s+)?vec3\s+\w+\s*\))");
  if (!std::regex_search(part.text.begin(), part.text.end(), light))
    throw Error(part.file, "defines no light", "vec3 light(vec3 P, vec3 N) { ... }");
  return part;
}

int count_of(GLenum type) {
  switch (type) {
    case GL_FLOAT:
    case GL_INT:
    case GL_BOOL:
      return 1;
    case GL_FLOAT_VEC2:
      return 2;
    case GL_FLOAT_VEC3:
      return 3;
    case GL_FLOAT_VEC4:
      return 4;
    default:
      return 0;
  }
}

Texture picture(const Context& context, const Image& image, const std::string& what) {
  Texture out(context, {.format = GL_RGB32F, .width = image.width, .height = image.height}, what);
  out.upload(GL_RGB, GL_FLOAT, image.data.data());
  return out;
}

Image white() {
  Image one = Image::rgb(1, 1);
  one.set_rgb(0, 0, Rgb(1));
  return one;
}

}  // namespace

LampProgram::LampProgram(const std::string& file, const std::string& text)
    : part_{file, text},
      points_("light on points", whole(checked(part_).text, std::string(octahedral_glsl()), kPoints), &part_),
      pixels_("light on pixels", whole(text, SeenSurfaces::glsl(), kPixels), &part_) {
  part_.text = {};
  for (const ActiveUniform& uniform : points_.uniforms())
    if (!uniform.name.starts_with("lamp_") && !uniform.name.starts_with("sconce_"))
      uniforms_.push_back(uniform);
}

LampValues::LampValues(const Context& context, const LampShader& lamp, const LampProgram& program) {
  std::vector<std::string> known;
  for (const ActiveUniform& uniform : program.uniforms()) {
    known.push_back(uniform.name);
    if (uniform.type == GL_SAMPLER_2D) pictures_.emplace(uniform.name, picture(context, white(), lamp.file));
  }
  for (const LampUniform& given : lamp.uniforms) {
    const std::string where = lamp.file + ": " + given.name;
    const auto it = std::find(known.begin(), known.end(), given.name);
    if (it == known.end())
      throw UsageError(
          lamp.file,
          "has no uniform '" + given.name + "', or does not use it" + did_you_mean(given.name, known),
          known.empty() ? "none" : join(known, ", "));
    const ActiveUniform& uniform = program.uniforms()[static_cast<std::size_t>(it - known.begin())];
    if (uniform.type == GL_SAMPLER_2D) {
      if (given.text.empty() && !given.picture)
        throw UsageError(where, "is a picture", "a file: .png, .jpg, .hdr, .exr");
      const Image image = given.picture ? *given.picture : rgb_of(read_image(given.text));
      pictures_.erase(given.name);
      pictures_.emplace(given.name, picture(context, image, where));
      continue;
    }
    const int count = count_of(uniform.type);
    if (count == 0 || uniform.size != 1)
      throw UsageError(where, "is of a type that cannot be set here",
                       "float, vec2, vec3, vec4, int, bool, sampler2D");
    if (given.numbers.size() != static_cast<std::size_t>(count))
      throw UsageError(where, "'" + given.text + "' does not fit",
                       count == 1 ? "a number" : std::to_string(count) + " numbers");
    numbers_.push_back({uniform, given.numbers});
  }
  context.check("preparing " + lamp.file);
}

void LampValues::bind(const LampShader& lamp, const Program& program, int first_unit) const {
  program.set("lamp_position", Vec3(lamp.frame[3]));
  program.set("lamp_axis", -Vec3(lamp.frame[2]));
  program.set("lamp_intensity", lamp.intensity);
  program.set("lamp_frame", Mat3(lamp.frame));
  for (const Numbers& n : numbers_) program.set(n.uniform, n.values);
  for (const auto& [name, texture] : pictures_) {
    texture.bind(first_unit);
    program.set(name.c_str(), first_unit++);
  }
}

}  // namespace sconce::gpu
