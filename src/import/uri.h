// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

/// Bytes of a `data:` URI and its media type ("" where it names none).
struct DataUri {
  std::string mime;
  std::vector<unsigned char> bytes;
};

bool is_data_uri(std::string_view uri);

/// @param where  for the error's place
/// @throws Error when the base64 is damaged
DataUri decode_data_uri(std::string_view uri, const std::string& where);

/// As data URIs hold bytes, padded.
std::string encode_base64(std::span<const unsigned char> bytes);

/// `%20` and the like resolved; a `+` stays a `+`.
std::string percent_decoded(std::string_view text);

/// Has the URI a scheme ("https:")? Then it is no file beside the scene.
bool has_scheme(std::string_view uri);

/// Is it a file that is there? Never throws.
bool is_file(const std::filesystem::path& path);

/// Is this the text that Git LFS leaves in place of a file that was not fetched?
bool is_lfs_pointer(std::string_view bytes);

}  // namespace sconce
