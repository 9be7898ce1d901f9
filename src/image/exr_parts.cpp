// SPDX-License-Identifier: Apache-2.0
#include "image/exr_parts.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "image/exr.h"
#include "image/exr_header.h"
#include "image/exr_stream.h"

namespace sconce {

struct ExrAttributes {
  Imf::Header header;
};

namespace {

/// A channel that is read.
struct Wanted {
  int part;
  std::string channel, name;
  bool integer;
};

std::vector<Wanted> wanted_channels(const Imf::MultiPartInputFile& file, std::size_t file_bytes,
                                    std::vector<std::string>& left_out) {
  std::vector<Wanted> all;
  std::size_t seen = 0;
  for (int p = 0; p < file.parts(); ++p) {
    const Imf::Header& header = file.header(p);
    const std::string part = file.parts() > 1 && header.hasName() ? header.name() : "";
    if (header.hasType() && Imf::isDeepData(header.type())) {
      left_out.push_back(part.empty() ? "deep pixels" : part);
      continue;
    }
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++seen;
    check_size(header, seen, file_bytes, false);
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      std::string name = c.name();
      if (!part.empty() && !name.starts_with(part + ".")) name.insert(0, part + ".");
      const bool known =
          std::any_of(all.begin(), all.end(), [&](const Wanted& other) { return other.name == name; });
      if (known || c.channel().xSampling != 1 || c.channel().ySampling != 1)
        left_out.push_back(name);
      else
        all.push_back({p, c.name(), name, c.channel().type == Imf::UINT});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Wanted& a, const Wanted& b) {
    return channel_key(a.name) < channel_key(b.name);
  });
  return all;
}

ExrWindow window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}
Imath::Box2i box_of(const ExrWindow& w) {
  return {{w.x, w.y}, {w.x + w.width - 1, w.y + w.height - 1}};
}

Imf::Slice slice(const Image& image, std::size_t channel, bool integer, const Imath::Box2i& box) {
  const std::size_t pixel = image.stride() * sizeof(float);
  return Imf::Slice::Make(integer ? Imf::UINT : Imf::FLOAT, image.data.data() + channel, box, pixel,
                          pixel * static_cast<std::size_t>(image.width));
}

ExrParts read(const std::string& bytes) {
  check_attributes(bytes);
  ExrInput stream(bytes);
  Imf::MultiPartInputFile file(stream);
  ExrParts out;
  const std::vector<Wanted> wanted = wanted_channels(file, bytes.size(), out.left_out);
  if (wanted.empty()) throw std::runtime_error("has no flat channels");
  Imath::Box2i box;
  std::vector<std::string> names;
  for (const Wanted& w : wanted) {
    box.extendBy(file.header(w.part).dataWindow());
    names.push_back(w.name);
    out.integer.push_back(w.integer);
  }
  const Imf::Header& first = file.header(wanted.front().part);
  out.data = window_of(box);
  out.display = window_of(first.displayWindow());
  // Windows far apart make a box that no part fills.
  Imf::Header whole = first;
  whole.dataWindow() = box;
  check_size(whole, names.size(), bytes.size(), false);
  out.image = Image(out.data.width, out.data.height, names);
  read_attributes(first, out.image);
  out.attributes = std::make_shared<ExrAttributes>(ExrAttributes{first});
  for (int p = 0; p < file.parts(); ++p) {
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (wanted[i].part == p) buffer.insert(wanted[i].channel, slice(out.image, i, wanted[i].integer, box));
    if (buffer.begin() == buffer.end()) continue;
    Imf::InputPart part(file, p);
    part.setFrameBuffer(buffer);
    part.readPixels(part.header().dataWindow().min.y, part.header().dataWindow().max.y);
  }
  return out;
}

Imf::Header make_header(const ExrParts& picture) {
  Imf::Header header = picture.attributes ? picture.attributes->header : Imf::Header();
  for (const char* name : {"name", "type", "view", "multiView", "tiles", "chunkCount", "preview", "version"})
    header.erase(name);
  Image stated;
  read_attributes(header, stated);
  if (const auto& p = picture.image.primaries; p != stated.primaries) {
    Imf::addChromaticities(header, {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}});
    for (const char* name : {"oiio:ColorSpace", "colorInteropID", "acesImageContainerFlag"})
      header.erase(name);
  }
  header.channels() = Imf::ChannelList();
  header.compression() = Imf::ZIP_COMPRESSION;
  header.lineOrder() = Imf::INCREASING_Y;
  header.dataWindow() = box_of(picture.data);
  header.displayWindow() = box_of(picture.display);
  for (std::size_t i = 0; i < picture.integer.size(); ++i)
    header.channels().insert(picture.image.channels[i],
                             Imf::Channel(picture.integer[i] ? Imf::UINT : Imf::FLOAT));
  return header;
}

}  // namespace

ExrParts read_exr_parts(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  if (!is_exr(bytes)) throw NotMyFormat(path.string(), "is not an OpenEXR file");
  try {
    return read(bytes);
  } catch (const std::exception& e) {
    throw Error(path.string(), "damaged or unsupported OpenEXR: " + one_line(e.what()));
  }
}

void write_exr_parts(const std::filesystem::path& path, const ExrParts& picture) {
  ExrOutput stream;
  try {
    const Imath::Box2i box = box_of(picture.data);
    Imf::OutputFile file(stream, make_header(picture));
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < picture.integer.size(); ++i)
      buffer.insert(picture.image.channels[i], slice(picture.image, i, picture.integer[i], box));
    file.setFrameBuffer(buffer);
    file.writePixels(picture.data.height);
  } catch (const std::exception& e) {
    throw Error(path.string(), "cannot be written: " + one_line(e.what()));
  }
  write_file(path, stream.bytes());
}

}  // namespace sconce
