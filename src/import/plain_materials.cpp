// SPDX-License-Identifier: Apache-2.0
#include "import/plain_materials.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/picture.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr float kMissingTextureGrey = 0.5f;
constexpr unsigned char kNothing = 16;  // opacity codes so near to 0 or 255 are meant so

}  // namespace

fs::path find_beside(const fs::path& scene, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path given = scene.parent_path() / name;
  if (is_file(given)) return given;
  std::error_code ec;
  const std::string last = lower(given.filename().string());
  for (const fs::directory_entry& entry :
       fs::directory_iterator(scene.has_parent_path() ? scene.parent_path() : ".", ec))
    if (lower(entry.path().filename().string()) == last && is_file(entry.path())) return entry.path();
  return given;
}

std::vector<unsigned char> picture_beside(const fs::path& scene, const std::string& name) {
  const std::string bytes = read_file(find_beside(scene, name));
  return {bytes.begin(), bytes.end()};
}

Id<Texture> PlainMaterials::texture(const std::string& name) {
  if (const auto found = known_.find(name); found != known_.end()) return found->second;
  Id<Texture> id;
  try {
    Texture out;
    out.name = name;
    out.file = pictures_(name);
    out.pixels = decode_texture(out.file, name);
    out.mime = picture_mime(out.file);
    if (out.mime.empty()) out.file.clear();
    id = Id<Texture>(scene_.textures.size());
    scene_.textures.push_back(std::move(out));
  } catch (const Error& e) {
    progress_.warn(file_.string() + ": texture " + name + " is left out: " + e.what());
  }
  return known_[name] = id;
}

Id<Texture> PlainMaterials::cut_out(Id<Texture> color, const Texture& opacity, bool& halves) {
  Texture out = color ? scene_[color] : opacity;
  out.name += color ? " cut out by " + opacity.name : "";
  out.file.clear(), out.mime.clear();
  const Image8 &mask = opacity.pixels, *seen = color ? &scene_[color].pixels : nullptr;
  const bool by_alpha = mask.channels == 4 &&
                        std::any_of(mask.data.begin(), mask.data.end(),
                                    [&, i = 0](unsigned char v) mutable { return i++ % 4 == 3 && v < 255; });
  Image8& pixels = out.pixels;
  pixels = {
      std::max(mask.width, seen ? seen->width : 0), std::max(mask.height, seen ? seen->height : 0), 4, {}};
  // The texel of `image` at the place of (x, y).
  const auto at = [&](const Image8& image, int x, int y) {
    const int u = x * image.width / pixels.width, v = y * image.height / pixels.height;
    return &image.data[static_cast<std::size_t>((v * image.width + u) * image.channels)];
  };
  std::size_t between = 0;
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const unsigned char alpha = at(mask, x, y)[by_alpha ? 3 : 0];
      for (int c = 0; c < 3; ++c)
        pixels.data.push_back(seen != nullptr ? at(*seen, x, y)[c] : static_cast<unsigned char>(255));
      pixels.data.push_back(alpha);
      between += alpha > kNothing && alpha < 255 - kNothing ? 1 : 0;
    }
  halves = between > pixels.data.size() / 4 / 10;
  scene_.textures.push_back(std::move(out));
  return Id<Texture>(scene_.textures.size() - 1);
}

bool PlainMaterials::use(const PlainMaterial::Map& map, TextureUse& use) {
  if (map.file.empty()) return true;
  use.texture = texture(map.file);
  if (use.texture && map.clamped)
    scene_.textures[use.texture.value].wrap_u = scene_.textures[use.texture.value].wrap_v =
        Texture::Wrap::clamp;
  return use.texture.valid();
}

void PlainMaterials::add(const PlainMaterial& m) {
  Material out;
  out.name = m.name;
  out.base_color = m.diffuse, out.emission = m.emissive;
  out.alpha = m.opacity;
  if (out.alpha < 1) out.alpha_mode = Material::Alpha::blend;
  if (out.alpha <= 0) {  // mostly a share of transparency taken for one of opacity
    out.alpha = 1, out.alpha_mode = Material::Alpha::opaque;
    progress_.warn(file_.string() + ": material '" + out.name +
                   "' would be invisible; it is treated as opaque");
  }
  if (!m.diffuse_map.file.empty()) {
    // Exporters write Kd 0 beside a map that is meant to be seen.
    if (out.base_color.is_black()) out.base_color = Rgb(1);
    if (!use(m.diffuse_map, out.base_color_texture)) out.base_color *= kMissingTextureGrey;
  }
  if (out.emits()) use(m.emissive_map, out.emission_texture);
  TextureUse opacity;
  if (!out.emits() && use(m.opacity_map, opacity) && opacity.texture) {
    bool halves = false;
    out.base_color_texture.texture =
        cut_out(out.base_color_texture.texture, Texture(scene_[opacity.texture]), halves);
    out.alpha_mode = halves || out.alpha < 1 ? Material::Alpha::blend : Material::Alpha::mask;
  }
  // Winding in such files is a matter of luck; lamps keep their front, so that their flux is what Ke says.
  out.double_sided = !out.emits();
  scene_.materials.push_back(std::move(out));
}

void PlainMaterials::drop_unused_textures() {
  std::vector<Id<Texture>> moved(scene_.textures.size());
  std::vector<Texture> kept;
  for (Material& m : scene_.materials)
    for (TextureUse* use : {&m.base_color_texture, &m.emission_texture}) {
      if (!use->texture) continue;
      Id<Texture>& to = moved[use->texture.value];
      if (!to) {
        to = Id<Texture>(kept.size());
        kept.push_back(std::move(scene_.textures[use->texture.value]));
      }
      use->texture = to;
    }
  scene_.textures = std::move(kept);
  known_.clear();
}

}  // namespace sconce
