// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "mix_options.h"
#include "package/convention.h"
#include "package/manifest.h"
#include "shader/composer.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;
using Form = ShaderSpec::Form;

/// OpenGL's name of a texture of such texels.
std::string internal_format(const EncodingChoice& choice) {
  if (choice.encoding->type == TexelType::bc6h) return "COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT";
  const bool four = choice.luminance || choice.encoding->stored_channels == 4;
  const char* suffix = choice.encoding->type == TexelType::f32   ? "32F"
                       : choice.encoding->type == TexelType::f16 ? "16F"
                                                                 : "8";
  return (four ? "RGBA" : "RGB") + std::string(suffix);
}

/// Whose light a texture holds, by file and channel.
Json texture_json(const Package& package, const LayerTexture& texture, int page) {
  const Manifest& m = package.manifest();
  const LayerInfo& info = package.layer_info(texture.groups.front(), page, texture.coefficient);
  Json groups = Json::array();
  for (const std::size_t g : texture.groups) groups.push_back(m.groups[g].name);
  return {{"file", "layers/" + info.file},
          {"encoding", info.encoding},
          {"groups", groups},
          {"coefficient", texture.coefficient},
          {"channels", texture.channels(layer_names(m.groups, texture.coefficient))},
          {"gain", texture.gain[static_cast<std::size_t>(page)]}};
}

Json samplers_json(const Package& package, const ShaderSpec& spec, const ComposedShader& shader) {
  Json list = Json::array();
  for (const ShaderSampler& sampler : shader.samplers) {
    Json slices = Json::array();
    for (const auto& slice : sampler.slices)
      for (int page = sampler.array ? slice.page : 0; page < (sampler.array ? slice.page + 1 : spec.pages);
           ++page) {
        slices.push_back(texture_json(package, spec.textures[slice.texture], page));
        slices.back()["page"] = page;
        slices.back()["plane"] = slice.plane;
      }
    list.push_back({{"name", sampler.name},
                    {"type", sampler.array ? "sampler2DArray" : "sampler2D"},
                    {"unit", list.size()},
                    {"upload_as", sampler.encoding.name()},
                    {"internal_format", internal_format(sampler.encoding)},
                    {"filter", sampler.linear ? "linear" : "nearest"},
                    {"wrap", "clamp_to_edge"},
                    {sampler.array ? "slices" : "pages", slices}});
  }
  return list;
}

Json uniforms_json(const Package& package, const ShaderSpec& spec) {
  Json weights = Json::array();
  for (const LayerTexture& texture : spec.textures)
    for (const std::size_t g : texture.groups) {
      if (texture.coefficient > 0) continue;
      const GroupInfo& group = package.manifest().groups[g];
      const Rgb c = texture.encoding.luminance ? group.color : Rgb(1);
      weights.push_back({{"index", g}, {"group", group.name}, {"times", {c.r, c.g, c.b}}});
    }
  std::sort(weights.begin(), weights.end(),
            [](const Json& a, const Json& b) { return a["index"] < b["index"]; });
  Json uniforms = {
      {"sconce_weight",
       {{"type", "vec3[]"}, {"meaning", "weight of each group, times its factor below"}, {"of", weights}}}};
  if (spec.form != Form::functions)
    uniforms["sconce_page"] = {{"type", "int"}, {"meaning", "page of the atlas"}};
  if (spec.form == Form::picture) {
    uniforms["sconce_albedo"] = {{"type", "vec3"}, {"meaning", "diffuse albedo, linear Rec. 709"}};
    uniforms["sconce_emission"] = {{"type", "vec3"}, {"meaning", "cd/m2, times its group's weight"}};
    uniforms["sconce_exposure"] = {{"type", "float"},
                                   {"meaning", "1/(cd/m2): what becomes 1 before the curve"}};
    if (spec.tone != nullptr)
      uniforms["sconce_tone"] = {{"type", "ToneParams"},
                                 {"maximum", "largest exposed luminance of the scene"},
                                 {"adaptation", kMiddleGrey},
                                 {"drago_bias", ToneParams{}.drago_bias}};
  }
  return uniforms;
}

}  // namespace

int run_shader(int argc, const char* const* argv) {
  std::string input, output, target = "glsl450", tier = "full", form = "picture", tone = "agx";
  int units = 16;
  Options options(
      "shader",
      "The shader that mixes a package's layers, for another renderer, and a description (JSON) of the "
      "textures and uniforms it wants.",
      {"sconce shader kitchen.sconce --target glsl330",
       "sconce shader kitchen.sconce --form functions --tone none -o mix.glsl",
       "sconce export {PACKAGE} --web site"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  options.option("-o,--output", &output,
                 "shader to write; the description gets .json behind; - is stdout "
                 "(default: NAME.glsl)");
  options.option("--target", &target, "glsl450, glsl330 or glsl300es");
  options.option(
      "--form", &form,
      "picture (fragment shader with tone curve), functions (to be pasted in), atlas (mixes texel by "
      "texel), compute");
  options.option("--tier", &tier,
                 "what textures can do: full, half, unfiltered (floats without filter) or byte");
  options.option("--tone", &tone, "tone curve of a picture; none = linear cd/m2");
  options.option("--units", &units, "texture units of a fragment shader; beyond, textures share arrays");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (units < 8) throw UsageError("--units", fmt::format("{} is out of range", units), "8 or more");
  if (output.empty()) {
    fs::path path(input);
    if (!path.has_filename()) path = path.parent_path();
    output = path.replace_extension(".glsl").string();
  }
  if (output == "-" && options.json) throw UsageError({}, "-o - and --json both want standard output");

  ShaderSpec spec;
  spec.target = &find_shader_target(target);
  spec.tier = &find_shader_tier(tier);
  spec.form = find_shader_form(form);
  spec.tone = tone == "none" ? nullptr : &find_tone_mapper(tone);
  spec.units = units;
  const Package package = Package::open(input);
  // An atlas is mixed for one coefficient; E is what everybody wants.
  const bool by_texel = spec.form == Form::atlas || spec.form == Form::compute;
  for (std::size_t c = 0; c < (by_texel ? 1 : coefficients(package.manifest().basis)); ++c)
    for (LayerTexture& texture : package.textures(c)) spec.textures.push_back(std::move(texture));
  spec.groups = package.manifest().groups.size();
  spec.pages = package.manifest().pages;
  const ComposedShader shader = compose(spec);
  const Json description = {
      {"package", input},
      {"target", target},
      {"form", form},
      {"tier", tier},
      {"atlas",
       {{"width", package.manifest().width}, {"height", package.manifest().height}, {"pages", spec.pages}}},
      {"unit", "lux, linear Rec. 709"},
      {"convention", lightmap_convention(package.manifest().lightmap_set)},
      {"basis", basis_row(package.manifest().basis).name},
      {"samplers", samplers_json(package, spec, shader)},
      {"uniforms", uniforms_json(package, spec)}};
  const std::string text = description.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (output == "-") {
    write_stdout(shader.text);
    return kDone;
  }
  Beside beside(output);
  beside.fill([&](const fs::path& path) { write_file(path, shader.text); });
  write_file(output + ".json", text);
  beside.commit();
  if (options.json)
    fmt::print("{}", text);
  else if (!options.quiet)
    fmt::print("{}, {}.json: {} groups out of {} textures by {} samplers, {}\n", output, output, spec.groups,
               spec.textures.size(), shader.samplers.size(), target);
  options.next({input});
  return kDone;
}

}  // namespace sconce::app
