// SPDX-License-Identifier: Apache-2.0
#include "package/layer_file.h"

#include "core/error.h"
#include "image/io.h"
#include "image/ktx2.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr const char* kUnit = "sconce:unit";

bool is_float(const Encoding& e) {
  return e.type == TexelType::f32 || e.type == TexelType::f16;
}

KtxFormat ktx_format(const Encoding& e, std::size_t image_channels) {
  if (e.type == TexelType::bc6h) return KtxFormat::bc6h_ufloat;
  constexpr KtxFormat kByChannels[] = {KtxFormat::r8, KtxFormat::rg8, KtxFormat::rgb8, KtxFormat::rgba8};
  return kByChannels[e.channels_of(static_cast<int>(image_channels)) - 1];
}

void check_unit(const std::map<std::string, std::string>& text, const fs::path& file) {
  const auto unit = text.find(kUnit);
  if (unit == text.end() || unit->second != "lux")
    throw Error(file.string(), "lacks the attribute sconce:unit = lux");
}

void check_size(int width, int height, int wanted_width, int wanted_height, const fs::path& file) {
  if (width != wanted_width || height != wanted_height)
    throw Error(file.string(), "has " + std::to_string(width) + " x " + std::to_string(height) +
                                   " texels, the manifest says " + std::to_string(wanted_width) + " x " +
                                   std::to_string(wanted_height));
}

}  // namespace

std::string_view layer_extension(const Encoding& encoding) {
  return is_float(encoding) ? ".exr" : ".ktx2";
}

void write_layer_file(const fs::path& path, const EncodedImage& layer,
                      const std::vector<std::string>& channels, std::map<std::string, std::string> text) {
  text[kUnit] = "lux";
  const Encoding& e = *layer.encoding;
  if (is_float(e)) {
    Image image = decode(layer);
    image.channels = channels;
    image.text = std::move(text);
    return write_exr(path, image, e.type == TexelType::f16 ? PixelType::half : PixelType::full);
  }
  text["sconce:encoding"] = e.name;
  Ktx2 texture{
      ktx_format(e, channels.size()), layer.width, layer.height, e.planes, std::move(text), layer.data};
  write_ktx2(path, texture);
}

EncodedImage read_layer_file(const fs::path& path, const LayerShape& shape) {
  const Encoding& e = *shape.encoding;
  if (is_float(e)) {
    const Image image = read_exr(path);
    check_unit(image.text, path);
    return encode(pick_channels(image, shape.channels, shape.width, shape.height, path), e);
  }
  Ktx2 texture = read_ktx2(path);
  check_unit(texture.text, path);
  check_size(texture.width, texture.height, shape.width, shape.height, path);
  if (texture.format != ktx_format(e, shape.channels.size()) || texture.layers != e.planes)
    throw Error(path.string(), "is no texture of the encoding " + std::string(e.name));
  return {&e,           shape.width,
          shape.height, static_cast<int>(shape.channels.size()),
          shape.gain,   std::move(texture.data)};
}

Image pick_channels(const Image& image, const std::vector<std::string>& names, int width, int height,
                    const fs::path& file) {
  check_size(image.width, image.height, width, height, file);
  std::vector<std::size_t> from;
  for (const std::string& name : names) {
    const int c = image.channel(name);
    if (c < 0) throw Error(file.string(), "lacks the channel " + name);
    from.push_back(static_cast<std::size_t>(c));
  }
  Image out(image.width, image.height, names);
  out.text = image.text;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    for (std::size_t c = 0; c < from.size(); ++c)
      out.data[i * from.size() + c] = image.data[i * image.stride() + from[c]];
  return out;
}

}  // namespace sconce
