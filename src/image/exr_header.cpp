// SPDX-License-Identifier: Apache-2.0
#include "image/exr_header.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFloatAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace sconce {

const std::set<std::string, std::less<>>& layout_attributes() {
  static const std::set<std::string, std::less<>> kNames{"name", "type", "view", "pixelAspectRatio",
                                                         "screenWindowWidth"};
  return kNames;
}

std::string one_line(const char* what) {
  std::string text = what;
  const std::string_view stream = "\"memory\". ";
  if (const auto at = text.find(stream); at != std::string::npos) text.erase(0, at + stream.size());
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

std::tuple<std::string, int, std::string> channel_key(const std::string& name) {
  const auto dot = name.rfind('.');
  const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot + 1);
  const std::string leaf = name.substr(layer.size());
  const auto rank = leaf.size() == 1 ? std::string_view("RGBA").find(leaf[0]) : std::string_view::npos;
  return {layer, rank == std::string_view::npos ? 4 : static_cast<int>(rank), leaf};
}

namespace {

/// Blocks of a part that its table of places has at least, 8 bytes each.
class Blocks {
 public:
  void see(std::string_view name, std::string_view value) {
    if (name == "dataWindow") read(value, window_);
    if (name == "tiles") read(value, tile_);
    if (name == "chunkCount") read(value, stated_);
    if (name == "compression" && !value.empty()) {
      constexpr int kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};  // by Imf::Compression
      const auto kind = static_cast<unsigned char>(value[0]);
      lines_ = kind < std::size(kLines) ? kLines[kind] : 256;
    }
  }
  /// @throws std::runtime_error
  void check(std::size_t file_bytes) const {
    const int64_t width = int64_t{window_[2]} - window_[0] + 1, height = int64_t{window_[3]} - window_[1] + 1;
    const auto parts = [](int64_t all, int64_t one) {
      return all > 0 && one > 0 ? (all + one - 1) / one : 0;
    };
    const double blocks =
        tile_.x > 0 ? static_cast<double>(parts(width, tile_.x)) * static_cast<double>(parts(height, tile_.y))
                    : static_cast<double>(parts(height, lines_));
    if (8 * std::max(blocks, static_cast<double>(stated_)) > static_cast<double>(file_bytes))
      throw std::runtime_error("claims " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels in more blocks than its " + std::to_string(file_bytes) +
                               " bytes can hold");
  }

 private:
  template <class T>
  static void read(std::string_view value, T& to) {
    if (value.size() >= sizeof to) std::memcpy(&to, value.data(), sizeof to);
  }
  struct Tile {
    uint32_t x = 0, y = 0;
  };
  std::array<int32_t, 4> window_{0, 0, 0, 0};  ///< least x and y, largest
  Tile tile_;
  int32_t stated_ = 0;
  int lines_ = 1;
};

/// Fit to be shown.
bool plain(const std::string& name) {
  return name.size() < 64 && std::all_of(name.begin(), name.end(), [](char c) { return c > 32 && c < 127; });
}

}  // namespace

// OpenEXR file layout: attributes are name, type, bytes (int32), value; an empty name ends a part's header.
void check_attributes(std::string_view bytes) {
  constexpr std::size_t kHead = 8;  // magic, version and flags
  constexpr uint32_t kManyParts = 0x1000;
  std::size_t at = kHead;
  const auto text = [&] {
    const std::size_t from = std::min(at, bytes.size()), end = bytes.find('\0', from);
    if (end == std::string_view::npos) throw std::runtime_error("the header is cut short");
    at = end + 1;
    return std::string(bytes.substr(from, end - from));
  };
  uint32_t flags = 0;
  if (bytes.size() >= kHead) std::memcpy(&flags, bytes.data() + 4, sizeof flags);
  do {
    Blocks blocks;
    for (std::string name = text(); !name.empty(); name = text()) {
      text();  // its type
      int32_t size = -1;
      if (bytes.size() - at >= sizeof size) std::memcpy(&size, bytes.data() + at, sizeof size);
      at = std::min(at + sizeof size, bytes.size());
      if (size < 0 || static_cast<std::size_t>(size) > bytes.size() - at)
        throw std::runtime_error(plain(name) ? "attribute '" + name + "' reaches beyond the file"
                                             : "an attribute reaches beyond the file");
      blocks.see(name, bytes.substr(at, static_cast<std::size_t>(size)));
      at += static_cast<std::size_t>(size);
    }
    blocks.check(bytes.size());
  } while ((flags & kManyParts) != 0 && at < bytes.size() && bytes[at] != '\0');
}

void check_size(const Imf::Header& header, std::size_t channels, std::size_t file_bytes, bool alone) {
  const Imath::Box2i window = header.dataWindow();
  const auto file = static_cast<double>(file_bytes);
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  const int64_t height = int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > (1 << 24) || height > (1 << 24))
    throw std::runtime_error("data window of " + std::to_string(width) + " x " + std::to_string(height));
  // Deflate reaches 1:1032 on halves, which become floats here; runs, PIZ and B44 reach less. DWA makes
  // nearly nothing of black, and subsampled channels have fewer pixels than are counted here.
  bool strict =
      alone && header.compression() != Imf::DWAA_COMPRESSION && header.compression() != Imf::DWAB_COMPRESSION;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    strict = strict && c.channel().xSampling == 1 && c.channel().ySampling == 1;
  const double bytes =
      4.0 * static_cast<double>(width) * static_cast<double>(height) * static_cast<double>(channels);
  if (bytes > (strict ? 64e3 + 2100.0 * file : 64e6 + 4096.0 * file))
    throw std::runtime_error("claims " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, more than its " + std::to_string(file_bytes) + " bytes can hold");
  if (!header.hasTileDescription()) return;
  const Imf::TileDescription& tile = header.tileDescription();
  if (4.0 * tile.xSize * tile.ySize * static_cast<double>(channels) > 256e6 + 4096.0 * file)
    throw std::runtime_error("tiles of " + std::to_string(tile.xSize) + " x " + std::to_string(tile.ySize));
}

void read_attributes(const Imf::Header& header, Image& image) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string name = it.name();
    if (layout_attributes().count(name) != 0) continue;
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      image.text[name] = s->value();
    if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&it.attribute()))
      image.number[name] = f->value();
  }
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  image.primaries = {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
}

}  // namespace sconce
