// SPDX-License-Identifier: Apache-2.0
// manifest.json as text. Keys: docs/package-format.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "package/package.h"

namespace sconce {

inline constexpr std::string_view kManifestFile = "manifest.json", kLayoutFile = "layout.bin";
inline constexpr std::string_view kPackageFormat = "sconce-package";

/// Readable JSON, keys in a fixed order. @throws Error when a number is not finite (the key is named)
std::string print_manifest(const Manifest& manifest);

/// @throws NotMyFormat when the text is JSON of something else; Error naming `where` and the key, or both
/// versions
Manifest parse_manifest(std::string_view text, const std::string& where);

/// Does the folder hold a manifest of a package, of whatever version or state?
bool is_package(const std::filesystem::path& folder);

/// A file name that cannot leave its folder: not empty, no separators, no leading dot.
bool is_base_name(std::string_view name);

/// Group names as OpenEXR layer names: dots and characters other than letters, digits, `-` and `_` become
/// `_`; what then is the same gets a number. Components of g end in .x, .y, .z.
std::vector<std::string> layer_names(std::span<const GroupInfo> groups, std::size_t coefficient = 0);

/// Folders of the layers and of those before the denoiser.
inline constexpr std::string_view kLayerFolder = "layers", kRawFolder = "raw", kOperatorFolder = "operators";

/// "receivers.0.exr" and the like.
std::string page_file(std::string_view stem, int page, std::string_view extension = ".exr");
/// "sky.exr", "sky.1.exr", ...: the radiance of the n-th sky light.
std::string sky_file(std::size_t index);

}  // namespace sconce
