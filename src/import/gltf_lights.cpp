// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "core/error.h"
#include "core/finite.h"
#include "import/gltf_parts.h"

namespace sconce {

Mat4 rigid(const Mat4& m) {
  const Vec3 z = normalize_or(Vec3(m[2]), Vec3(0, 0, 1));
  const Vec3 x = normalize_or(glm::cross(Vec3(m[1]), z), Frame(z).x);
  Mat4 out(1.0f);
  out[0] = glm::vec4(x, 0);
  out[1] = glm::vec4(glm::cross(z, x), 0);
  out[2] = glm::vec4(z, 0);
  out[3] = glm::vec4(Vec3(m[3]), 1);
  return out;
}

namespace {

/// As `export --scene` writes them (docs/side-file.md).
ProjectorLight projector(const GltfSource& source, const tinygltf::Value& v, const std::string& place) {
  const auto number = [&](const char* key) {
    const double value = number_of(v, key, 0);
    if (!(value > 0 && value <= 1 << 16))
      throw Error(source.at(place + "." + key), "is out of range", "above 0");
    return value;
  };
  const auto width = static_cast<std::size_t>(number("width")),
             height = static_cast<std::size_t>(number("height"));
  const auto bytes = source.view(static_cast<int>(number_of(v, "bufferView", -1)), place);
  if (bytes.size() != width * height * sizeof(Rgb))
    throw Error(source.at(place + ".bufferView"), "does not hold as many pixels as the slide has");
  Image slide = Image::rgb(static_cast<int>(width), static_cast<int>(height));
  std::memcpy(slide.data.data(), bytes.data(), bytes.size());
  if (!all_light(slide.data))
    throw Error(source.at(place + ".bufferView"), "has pixels that are negative or no numbers");
  return {std::make_shared<Image>(std::move(slide)), static_cast<float>(number("yfov")),
          static_cast<float>(number("aspect"))};
}

}  // namespace

Light read_gltf_light(const GltfSource& source, int index, const GltfNode& node, const std::string& place) {
  const tinygltf::Light& l = element(source, source.model.lights, index, place);
  const std::string here = "lights[" + std::to_string(index) + "]";
  Light out;
  out.name = !node.name.empty() ? node.name : l.name;
  out.light_name = !node.light_name.empty() ? node.light_name : extra_string(l.extras, "light");
  out.frame = rigid(node.transform);
  out.group_name = !node.light_group.empty() ? node.light_group : extra_string(l.extras, "light_group");
  out.intensity = Rgb(static_cast<float>(l.intensity));
  if (const auto c = numbers(source, l.color, 3, here + ".color"))
    out.intensity *=
        Rgb(static_cast<float>((*c)[0]), static_cast<float>((*c)[1]), static_cast<float>((*c)[2]));
  if (l.range < 0) throw Error(source.at(here + ".range"), "is negative", "metres, or absent for no limit");
  const auto range = static_cast<float>(l.range);
  if (l.type == "point") {
    out.shape = PointLight{range};
  } else if (l.type == "spot") {
    SpotLight spot{static_cast<float>(l.spot.innerConeAngle), static_cast<float>(l.spot.outerConeAngle),
                   range};
    if (!(spot.inner >= 0 && spot.inner <= spot.outer && spot.outer > 0 && spot.outer <= kPi / 2 + 1e-5f))
      throw Error(source.at(here + ".spot"), "cone angles are out of range", "0 <= inner < outer <= pi/2");
    out.shape = spot;
    if (l.extras.IsObject() && l.extras.Has("projector"))
      out.shape = projector(source, l.extras.Get("projector"), here + ".extras.projector");
  } else if (l.type == "directional") {
    out.shape = SunLight{};
  } else {
    throw Error(source.at(here + ".type"), "'" + l.type + "' is unknown", "point, spot, directional");
  }
  return out;
}

}  // namespace sconce
