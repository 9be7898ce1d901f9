// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/error.h"
#include "core/kelvin.h"
#include "import/gltf_luminaires.h"
#include "import/gltf_parts.h"
#include "import/uri.h"
#include "photometry/formats.h"

namespace sconce {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIes = "EXT_lights_ies";
constexpr std::string_view kExtraKeys[] = {"file", "flux", "cct", "dim", "exact_below"};

std::string text_of(const tinygltf::Value& object, const char* key) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : std::string();
}

/// A node shines along its -y (it hangs), C0 along its x; in the frame of a Light that is -z.
Mat4 hanging(const Mat4& node) {
  Mat4 turn(1.0f);
  turn[1] = glm::vec4(0, 0, -1, 0);
  turn[2] = glm::vec4(0, 1, 0, 0);
  return rigid(node * turn);
}

}  // namespace

Id<Luminaire> GltfLuminaires::profile(int index, const std::string& place) {
  if (const auto found = profiles_.find(index); found != profiles_.end()) return found->second;
  const tinygltf::Value* all = extension(source_.model.extensions, kIes);
  const bool there = all != nullptr && all->Has("lights") && all->Get("lights").IsArray() && index >= 0 &&
                     static_cast<std::size_t>(index) < all->Get("lights").ArrayLen();
  if (!there)
    throw Error(source_.at(place),
                "names the light profile " + std::to_string(index) + ", which is not there");
  const tinygltf::Value& entry = all->Get("lights").Get(static_cast<std::size_t>(index));
  const std::string here = std::string(kIes) + ".lights[" + std::to_string(index) + "]",
                    uri = text_of(entry, "uri");
  std::string name = text_of(entry, "name");
  if (name.empty()) name = "profile " + std::to_string(index);
  Id<Luminaire> id;
  if (entry.Has("bufferView") && entry.Get("bufferView").IsNumber()) {
    const auto bytes = source_.view(entry.Get("bufferView").GetNumberAsInt(), here);
    id = files_.add(name,
                    parse_ies({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, source_.at(here)));
  } else if (is_data_uri(uri)) {
    const DataUri data = decode_data_uri(uri, source_.at(here));
    id = files_.add(name, parse_ies({reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()},
                                    source_.at(here)));
  } else if (!uri.empty() && !has_scheme(uri)) {
    id = files_.load(source_.path.parent_path() / percent_decoded(uri));
  } else {
    throw Error(source_.at(here), "has no profile that can be read",
                "uri of a file beside the scene, or bufferView");
  }
  profiles_[index] = id;
  return id;
}

std::optional<Light> GltfLuminaires::read(const tinygltf::Node& node, const GltfNode& here,
                                          const std::string& place) {
  LuminaireStrength strength;
  Mat4 frame = rigid(here.transform);
  Id<Luminaire> id;
  std::string file = luminaire_of_node_name(node.name);
  if (const tinygltf::Value* use = extension(node.extensions, kIes)) {
    if (!use->Has("light") || !use->Get("light").IsInt())
      throw Error(source_.at(place), std::string(kIes) + " without an index `light`");
    id = profile(use->Get("light").Get<int>(), place);
    strength.dim = number_of(*use, "multiplier", 1);
    if (use->Has("color")) {
      std::vector<double> color;
      for (std::size_t i = 0; i < use->Get("color").ArrayLen(); ++i)
        color.push_back(use->Get("color").Get(i).GetNumberAsDouble());
      if (const auto c = numbers(source_, color, 3, place + ".color"))
        strength.color =
            Rgb(static_cast<float>((*c)[0]), static_cast<float>((*c)[1]), static_cast<float>((*c)[2]));
    }
  } else {
    if (node.extras.IsObject() && node.extras.Has("luminaire")) {
      const tinygltf::Value& extra = node.extras.Get("luminaire");
      if (extra.IsString()) {
        file = extra.Get<std::string>();
      } else if (extra.IsObject()) {
        for (const std::string& key : extra.Keys())
          if (std::ranges::find(kExtraKeys, key) == std::end(kExtraKeys))
            throw Error(source_.at(place + ".extras.luminaire"), "has the unknown key '" + key + "'",
                        "file, flux, cct, dim, exact_below");
        file = text_of(extra, "file");
        strength.dim = number_of(extra, "dim", 1);
        if (extra.Has("flux")) strength.flux = number_of(extra, "flux", 0);
        if (extra.Has("exact_below")) strength.exact_below = number_of(extra, "exact_below", 0);
        if (extra.Has("cct")) {
          const double cct = number_of(extra, "cct", 0);
          if (!(cct >= kKelvinMin && cct <= kKelvinMax))
            throw Error(source_.at(place + ".extras.luminaire.cct"), "is out of range", "1000 to 11000");
          strength.color = kelvin_color(cct);
        }
      }
      if (file.empty())
        throw Error(source_.at(place + ".extras.luminaire"), "names no file",
                    "a file name, or {\"file\": ...}");
    }
    if (file.empty()) return std::nullopt;
    const auto path = find_luminaire_file(source_.path.parent_path(), file);
    if (!path)
      throw Error(source_.at(place), "names the luminaire '" + file + "', which is not there",
                  "an .ies, .ldt or light field (.exr) beside the scene");
    id = files_.load(*path);
    // In place of a lamp it shines as that would.
    if (extension(node.extensions, "KHR_lights_punctual") == nullptr) frame = hanging(here.transform);
  }
  if (!(strength.dim >= 0) || strength.flux.value_or(0) < 0 || strength.exact_below.value_or(0) < 0)
    throw Error(source_.at(place), "has a negative number",
                "multiplier, dim, flux and exact_below from 0 on");
  Light light = make_luminaire_light(scene_, id, frame, strength, source_.at(place));
  if (!here.name.empty() && luminaire_of_node_name(here.name).empty()) light.name = here.name;
  light.group_name = here.light_group;
  light.light_name = here.light_name;
  return light;
}

}  // namespace sconce
