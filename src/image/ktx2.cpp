// SPDX-License-Identifier: Apache-2.0
// Layout: KTX File Format Specification 2.0, sections 3 and 4; data format descriptors: Khronos Data Format
// Specification 1.3, section 5.
#include "image/ktx2.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cstring>

#include "core/error.h"
#include "core/files.h"

namespace sconce {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view kIdentifier{"\xabKTX 20\xbb\r\n\x1a\n", 12};
constexpr uint32_t kZlib = 3;
constexpr std::size_t kHeaderBytes = 80, kLevelBytes = 24;
constexpr int kLargestSide = 1 << 16, kMostLayers = 1 << 12;
constexpr std::size_t kBestDeflate = 1032;  // zlib's own figure of bytes that one byte can become

struct Shape {
  KtxFormat format;
  uint32_t channels;  ///< 0: blocks
};
constexpr Shape kShapes[] = {{KtxFormat::r8, 1},
                             {KtxFormat::rg8, 2},
                             {KtxFormat::rgb8, 3},
                             {KtxFormat::rgba8, 4},
                             {KtxFormat::bc6h_ufloat, 0}};

const Shape* find_shape(KtxFormat format) {
  for (const Shape& shape : kShapes)
    if (shape.format == format) return &shape;
  return nullptr;
}

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// The header after the identifier, and the only level.
struct Header {
  uint32_t format, type_size, width, height, depth, layers, faces, levels, scheme;
  uint32_t descriptor_at, descriptor_bytes, text_at, text_bytes;
  std::array<uint32_t, 4> global;  // two 64-bit numbers: no data for all levels
};
struct Level {
  uint64_t at, bytes, whole_bytes;
};
static_assert(sizeof(Header) == kHeaderBytes - kIdentifier.size() && sizeof(Level) == kLevelBytes);

std::string descriptor(const Shape& shape) {
  const bool blocks = shape.channels == 0;
  const uint32_t samples = blocks ? 1 : shape.channels;
  const uint32_t size = 24 + 16 * samples;
  std::string out;
  append<uint32_t>(out, size + 4);
  append<uint32_t>(out, 0);                                          // Khronos, basic format
  append<uint32_t>(out, 2 | size << 16);                             // version 1.3
  append<uint32_t>(out, (blocks ? 133u : 1u) | 1u << 8 | 1u << 16);  // BC6H or RGBSDA, BT.709, linear
  append<uint32_t>(out, blocks ? 0x0303u : 0u);                      // texels per block - 1
  append<uint32_t>(out, blocks ? 16 : shape.channels);               // bytes per block
  append<uint32_t>(out, 0);
  for (uint32_t c = 0; c < samples; ++c) {
    const uint32_t bits = blocks ? 128 : 8, channel = blocks ? 0x80u : c == 3 ? 15u : c;
    append<uint32_t>(out, c * bits | (bits - 1) << 16 | channel << 24);
    append<uint32_t>(out, 0);
    append<uint32_t>(out, 0);
    append<uint32_t>(out, blocks ? std::bit_cast<uint32_t>(1.0f) : 255u);
  }
  return out;
}

std::string key_values(std::map<std::string, std::string> text) {
  text.emplace("KTXwriter", "sconce");
  std::string out;
  for (const auto& [key, value] : text) {
    append(out, static_cast<uint32_t>(key.size() + value.size() + 2));
    out.append(key).append(1, '\0').append(value).append(1, '\0');
    out.append((4 - out.size() % 4) % 4, '\0');
  }
  return out;
}

std::map<std::string, std::string> parse_key_values(std::string_view bytes, const std::string& where) {
  std::map<std::string, std::string> text;
  while (bytes.size() >= 4) {
    uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    const std::string_view pair = bytes.substr(4, length);
    const std::size_t end = pair.find('\0');
    if (pair.size() != length || end == std::string_view::npos)
      throw Error(where, "is damaged: its key/value data is cut short");
    std::string value(pair.substr(end + 1));
    if (!value.empty() && value.back() == '\0') value.pop_back();
    text.emplace(pair.substr(0, end), std::move(value));
    bytes.remove_prefix(std::min(bytes.size(), 4 + (length + 3) / 4 * std::size_t{4}));
  }
  return text;
}

std::string_view slice(std::string_view file, uint64_t at, uint64_t bytes, const std::string& where) {
  if (at > file.size() || bytes > file.size() - at) throw Error(where, "is damaged: it is cut short");
  return file.substr(at, bytes);
}

void check(const Header& h, const std::string& where) {
  if (find_shape(static_cast<KtxFormat>(h.format)) == nullptr)
    throw Error(where, "has the texture format " + std::to_string(h.format),
                "VkFormat 9, 16, 23, 37 (8-bit channels) or 131 (BC6H)");
  if (h.width < 1 || h.width > kLargestSide || h.height < 1 || h.height > kLargestSide ||
      h.layers > kMostLayers)
    throw Error(where, "is damaged: it says it is " + std::to_string(h.width) + " x " +
                           std::to_string(h.height) + " x " + std::to_string(h.layers));
  if (h.depth != 0 || h.faces != 1 || h.levels != 1 || h.scheme != kZlib)
    throw Error(where, "is no layer of this program", "one level, one face, zlib");
}

}  // namespace

std::size_t Ktx2::bytes() const {
  const Shape* shape = find_shape(format);
  if (shape == nullptr) return 0;
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  const std::size_t one = shape->channels == 0 ? 16 * ((w + 3) / 4) * ((h + 3) / 4) : shape->channels * w * h;
  return one * static_cast<std::size_t>(layers);
}

Ktx2 read_ktx2(const std::filesystem::path& path) {
  const std::string where = path.string(), bytes = read_file(path);
  const std::string_view file = bytes;
  if (!file.starts_with(kIdentifier)) throw NotMyFormat(where, "is no KTX2 texture");
  Header h;
  std::memcpy(&h, slice(file, kIdentifier.size(), sizeof h, where).data(), sizeof h);
  check(h, where);
  Level level;
  std::memcpy(&level, slice(file, kHeaderBytes, sizeof level, where).data(), sizeof level);

  Ktx2 out;
  out.format = static_cast<KtxFormat>(h.format);
  out.width = static_cast<int>(h.width), out.height = static_cast<int>(h.height);
  out.layers = static_cast<int>(std::max(1u, h.layers));
  out.text = parse_key_values(slice(file, h.text_at, h.text_bytes, where), where);
  if (level.whole_bytes != out.bytes()) throw Error(where, "is damaged: its size does not fit its format");
  const std::string_view packed = slice(file, level.at, level.bytes, where);
  if (out.bytes() / kBestDeflate > packed.size())
    throw Error(where, "is damaged: it claims " + std::to_string(out.bytes()) +
                           " bytes of texels, more than " + std::to_string(packed.size()) +
                           " packed bytes can hold");
  out.data.resize(out.bytes());
  uLongf unpacked = out.data.size();
  if (uncompress(reinterpret_cast<Bytef*>(out.data.data()), &unpacked,
                 reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
      unpacked != out.data.size())
    throw Error(where, "is damaged: its texels cannot be unpacked");
  return out;
}

void write_ktx2(const std::filesystem::path& path, const Ktx2& texture) {
  const Shape* shape = find_shape(texture.format);
  if (shape == nullptr || texture.data.size() != texture.bytes())
    throw Error(path.string(), "the texture's data does not fit its size");
  std::string packed(compressBound(texture.data.size()), '\0');
  uLongf size = packed.size();
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(texture.data.data()), texture.data.size(), 6) != Z_OK)
    throw Error(path.string(), "cannot be compressed");
  packed.resize(size);

  const std::string dfd = descriptor(*shape), text = key_values(texture.text);
  Header h{};
  h.format = static_cast<uint32_t>(texture.format);
  h.type_size = 1;
  h.width = static_cast<uint32_t>(texture.width), h.height = static_cast<uint32_t>(texture.height);
  h.layers = texture.layers > 1 ? static_cast<uint32_t>(texture.layers) : 0;
  h.faces = h.levels = 1;
  h.scheme = kZlib;
  h.descriptor_at = kHeaderBytes + kLevelBytes;
  h.descriptor_bytes = static_cast<uint32_t>(dfd.size());
  h.text_at = h.descriptor_at + h.descriptor_bytes;
  h.text_bytes = static_cast<uint32_t>(text.size());
  std::string file(kIdentifier);
  append(file, h);
  append(file, Level{h.text_at + h.text_bytes, packed.size(), texture.data.size()});
  write_file(path, file + dfd + text + packed);
}

}  // namespace sconce
