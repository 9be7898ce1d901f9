// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_container.h"

#include <cstdint>

#include "core/error.h"
#include "core/mapped_file.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

uint32_t word(std::string_view bytes, std::size_t at) {
  uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

GltfContainer split_glb(std::string_view bytes, const std::string& where) {
  if (bytes.size() < kHeader + kChunkHeader) throw Error(where, "GLB ends within its header");
  const uint32_t version = word(bytes, 4), length = word(bytes, 8);
  if (version != 2) throw Error(where, "GLB version " + std::to_string(version) + " is not supported", "2");
  if (length > bytes.size())
    throw Error(where,
                "GLB is cut short: " + std::to_string(bytes.size()) + " bytes of " + std::to_string(length));
  if (length < kHeader + kChunkHeader)
    throw Error(where, "GLB length " + std::to_string(length) + " is too small");

  GltfContainer out;
  bool json_seen = false;
  for (std::size_t at = kHeader; at < length;) {
    if (length - at < kChunkHeader)
      throw Error(where, "GLB chunk header cut short at byte " + std::to_string(at));
    const std::size_t size = word(bytes, at);
    const uint32_t type = word(bytes, at + 4);
    at += kChunkHeader;
    if (size > length - at)
      throw Error(where, "GLB chunk at byte " + std::to_string(at) + " reaches beyond the file");
    if (!json_seen) {
      if (type != kJson) throw Error(where, "the first GLB chunk is not JSON");
      out.json = bytes.substr(at, size);
      json_seen = true;
    } else if (type == kBinary && !out.binary) {
      out.binary = bytes.substr(at, size);
    }
    at += size;
  }
  return out;
}

}  // namespace

GltfContainer open_gltf_container(const std::filesystem::path& path) {
  const MappedFile file(path);  // behind a GLB's end there may be gigabytes
  std::string_view text = file.bytes();
  if (text.starts_with("glTF")) return split_glb(text, path.string());

  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::string extension = lower(path.extension().string());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (extension != ".gltf") {
    if (extension == ".glb") throw Error(path.string(), "does not begin with the GLB magic", "glTF");
    if (first == std::string_view::npos || text[first] != '{' ||
        text.find("\"asset\"") == std::string_view::npos)
      throw NotMyFormat(path.string(), "is not glTF");
  } else if (first == std::string_view::npos) {
    throw Error(path.string(), "is empty, expected glTF JSON");
  }
  return {std::string(text), std::nullopt};
}

}  // namespace sconce
