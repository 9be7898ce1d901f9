// SPDX-License-Identifier: Apache-2.0
#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/files.h"
#include "image/exr.h"
#include "image/exr_header.h"
#include "image/exr_stream.h"
#include "image/io.h"

namespace sconce {

namespace {

constexpr float kLargestHalf = 65504.0f;

/// Luminance and subsampled chroma, rebuilt to R, G, B (and A) in the file's own primaries by OpenEXR's
/// filters.
Image read_luminance_chroma(const std::string& bytes, const Imf::Header& header, bool alpha) {
  ExrInput stream(bytes);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = header.dataWindow();
  Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {"R", "G", "B"});
  if (alpha) image = Image(image.width, image.height, {"R", "G", "B", "A"});
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    const std::ptrdiff_t line = window.min.y + y;
    file.setFrameBuffer(row.data() - window.min.x - line * image.width, 1,
                        static_cast<std::size_t>(image.width));
    file.readPixels(window.min.y + y);
    for (int x = 0; x < image.width; ++x) {
      const Imf::Rgba& p = row[static_cast<std::size_t>(x)];
      image.set_rgb(x, y, {p.r, p.g, p.b});
      if (alpha) image.at(x, y)[3] = p.a;
    }
  }
  return image;
}

/// All channels into one interleaved buffer; a subsampled channel's pixels are repeated.
Image read_channels(Imf::MultiPartInputFile& file, const std::vector<std::string>& names) {
  const Imf::Header& header = file.header(0);
  const Imath::Box2i window = header.dataWindow();
  Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, names);
  const std::size_t pixel = image.stride() * sizeof(float);
  const std::size_t row = pixel * static_cast<std::size_t>(image.width);

  struct Coarse {
    std::size_t index;
    int dx, dy, width;
    std::vector<float> data;
  };
  std::vector<Coarse> coarse;
  coarse.reserve(names.size());
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Imf::Channel& c = header.channels()[names[i].c_str()];
    if (c.xSampling == 1 && c.ySampling == 1) {
      buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, image.data.data() + i, window, pixel, row));
      continue;
    }
    const int width = (image.width + c.xSampling - 1) / c.xSampling + 1;
    const int height = (image.height + c.ySampling - 1) / c.ySampling + 1;
    coarse.push_back({i, c.xSampling, c.ySampling, width, {}});
    coarse.back().data.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, coarse.back().data.data(), window, sizeof(float),
                                             sizeof(float) * static_cast<std::size_t>(width), c.xSampling,
                                             c.ySampling));
  }
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  for (const Coarse& c : coarse)
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.at(x, y)[c.index] =
            c.data[static_cast<std::size_t>(y / c.dy) * static_cast<std::size_t>(c.width) +
                   static_cast<std::size_t>(x / c.dx)];
  return image;
}

Image read_first_part(const std::string& bytes) {
  check_attributes(bytes);
  ExrInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw std::runtime_error("deep pixels are not supported");

  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) names.emplace_back(c.name());
  if (names.empty()) throw std::runtime_error("has no channels");
  check_size(header, names.size(), bytes.size());
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return channel_key(a) < channel_key(b);
  });
  const auto has = [&](const char* name) { return header.channels().findChannel(name) != nullptr; };
  Image image = has("Y") && has("RY") && has("BY") ? read_luminance_chroma(bytes, header, has("A"))
                                                   : read_channels(file, names);
  read_attributes(header, image);
  return image;
}

void check_writable(const std::filesystem::path& path, const Image& image) {
  if (image.width < 1 || image.height < 1 || image.channels.empty())
    throw Error(path.string(), "cannot be written: the image is empty");
  if (image.data.size() != image.pixels() * image.stride())
    throw Error(path.string(), "cannot be written: the image's data does not match its size");
  if (std::set<std::string>(image.channels.begin(), image.channels.end()).size() != image.channels.size())
    throw Error(path.string(), "cannot be written: two channels of one name");
}

Imf::Header make_header(const Image& image, PixelType type) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const auto& p = image.primaries;
  Imf::addChromaticities(header, {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}});
  for (const auto& [name, value] : image.text)
    if (layout_attributes().count(name) == 0) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : image.number)
    if (layout_attributes().count(name) == 0) header.insert(name, Imf::FloatAttribute(value));
  for (const std::string& c : image.channels)
    header.channels().insert(c, Imf::Channel(type == PixelType::half ? Imf::HALF : Imf::FLOAT));
  return header;
}

void write_full(Imf::OutputFile& file, const Image& image) {
  const std::size_t pixel = image.stride() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < image.channels.size(); ++i)
    buffer.insert(image.channels[i],
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(image.data.data() + i)),
                             pixel, pixel * static_cast<std::size_t>(image.width)));
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

void write_half(Imf::OutputFile& file, const Image& image) {
  constexpr int kBand = 64;  // lines converted at a time; a multiple of ZIP's 16
  const std::size_t row = image.stride() * static_cast<std::size_t>(image.width);
  std::vector<half> band(row * kBand);
  for (int y0 = 0; y0 < image.height; y0 += kBand) {
    const int lines = std::min(kBand, image.height - y0);
    const float* from = image.data.data() + static_cast<std::size_t>(y0) * row;
    for (std::size_t i = 0; i < row * static_cast<std::size_t>(lines); ++i)
      band[i] = std::isfinite(from[i]) ? std::clamp(from[i], -kLargestHalf, kLargestHalf) : from[i];
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < image.channels.size(); ++i)
      buffer.insert(image.channels[i],
                    Imf::Slice::Make(Imf::HALF, band.data() + i, Imath::V2i(0, y0), image.width, lines,
                                     image.stride() * sizeof(half), row * sizeof(half)));
    file.setFrameBuffer(buffer);
    file.writePixels(lines);
  }
}

}  // namespace

Image decode_exr(const std::string& bytes, const std::string& where) {
  if (!is_exr(bytes)) throw NotMyFormat(where, "is not an OpenEXR file");
  try {
    return read_first_part(bytes);
  } catch (const std::exception& e) {
    throw Error(where, "damaged or unsupported OpenEXR: " + one_line(e.what()));
  }
}

Image read_exr(const std::filesystem::path& path) {
  return decode_exr(read_file(path), path.string());
}

void write_exr(const std::filesystem::path& path, const Image& image, PixelType type) {
  check_writable(path, image);
  ExrOutput stream;
  try {
    Imf::OutputFile file(stream, make_header(image, type));
    type == PixelType::half ? write_half(file, image) : write_full(file, image);
  } catch (const std::exception& e) {
    throw Error(path.string(), "cannot be written: " + one_line(e.what()));
  }
  write_file(path, stream.bytes());
}

}  // namespace sconce
