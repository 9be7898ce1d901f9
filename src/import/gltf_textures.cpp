// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_textures.h"

#include "core/error.h"
#include "core/files.h"
#include "import/gltf_parts.h"
#include "import/picture.h"
#include "import/uri.h"

namespace sconce {

namespace {

Texture::Wrap wrap_of(int gl) {
  if (gl == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::clamp;
  if (gl == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Wrap::mirror;
  return Texture::Wrap::repeat;
}

/// What to call a picture in a warning.
std::string title(const GltfImage& image, int index) {
  if (!image.uri.empty() && !is_data_uri(image.uri)) return percent_decoded(image.uri);
  return "images[" + std::to_string(index) + "]" + (image.name.empty() ? "" : " '" + image.name + "'");
}

Bytes encoded(const GltfSource& source, const GltfImage& image, const std::string& place) {
  if (image.uri.empty()) {
    const auto view = source.view(image.buffer_view, place);
    return Bytes(view.begin(), view.end());
  }
  if (is_data_uri(image.uri)) return decode_data_uri(image.uri, source.at(place)).bytes;
  if (has_scheme(image.uri)) throw Error(image.uri, "is no file beside the scene");
  const std::string file = read_file(source.path.parent_path() / percent_decoded(image.uri));
  return Bytes(file.begin(), file.end());
}

/// Of the plain picture where there is one; else of the extensions'. @return -1 where there is none
int picture_of(const tinygltf::Texture& texture) {
  if (texture.source >= 0) return texture.source;
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu"})
    if (const tinygltf::Value* with = extension(texture.extensions, name))
      return static_cast<int>(number_of(*with, "source", -1));
  return -1;
}

}  // namespace

const std::optional<GltfTextures::Picture>& GltfTextures::picture(int index, const std::string& place) {
  if (const auto known = pictures_.find(index); known != pictures_.end()) return known->second;
  const GltfImage& image = element(source_, source_.images, index, place);
  const std::string here = "images[" + std::to_string(index) + "]";
  if (image.uri.empty() && image.buffer_view >= 0) source_.has_view(image.buffer_view, here);
  std::optional<Picture> out;
  try {
    Picture read;
    read.file = encoded(source_, image, here);
    read.pixels = decode_texture(read.file, title(image, index));
    read.mime = picture_mime(read.file);
    if (read.mime.empty()) read.file.clear();
    out = std::move(read);
  } catch (const Error& e) {
    progress_.warn(source_.path.string() + ": texture " + title(image, index) + " is left out: " + e.what());
  }
  return pictures_.emplace(index, std::move(out)).first->second;
}

Id<Texture> GltfTextures::load(int index, const std::string& place) {
  const tinygltf::Texture& texture = element(source_, source_.model.textures, index, place);
  const int source = picture_of(texture);
  if (source < 0) {
    progress_.warn(source_.at(place) + ": textures[" + std::to_string(index) +
                   "] has no picture that can be read");
    return {};
  }
  const std::optional<Picture>& from = picture(source, "textures[" + std::to_string(index) + "]");
  if (!from) return {};
  tinygltf::Sampler sampler;
  if (texture.sampler >= 0)
    sampler =
        element(source_, source_.model.samplers, texture.sampler, "textures[" + std::to_string(index) + "]");
  const auto key = std::tuple(source, sampler.wrapS, sampler.wrapT, sampler.magFilter);
  if (const auto known = made_.find(key); known != made_.end()) return known->second;

  Texture out;
  const GltfImage& image = source_.images[static_cast<std::size_t>(source)];
  out.name = !texture.name.empty() ? texture.name : !image.name.empty() ? image.name : title(image, source);
  out.pixels = from->pixels;
  out.file = from->file;
  out.mime = from->mime;
  out.wrap_u = wrap_of(sampler.wrapS);
  out.wrap_v = wrap_of(sampler.wrapT);
  out.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  const Id<Texture> id(scene_.textures.size());
  scene_.textures.push_back(std::move(out));
  made_.emplace(key, id);
  return id;
}

}  // namespace sconce
