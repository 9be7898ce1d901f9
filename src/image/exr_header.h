// SPDX-License-Identifier: Apache-2.0
// What reading and writing OpenEXR files shares.
#pragma once

#include <ImfHeader.h>

#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "image/image.h"

namespace sconce {

/// Attributes that describe the file's own layout; they are not the picture's.
const std::set<std::string, std::less<>>& layout_attributes();
/// A library's message on one line, without the stream's name before it.
std::string one_line(const char* what);
/// Sorts R, G, B, A in this order inside a layer (OpenEXR sorts by letter: A, B, G, R), everything else as in
/// the file.
std::tuple<std::string, int, std::string> channel_key(const std::string& name);
/// Before OpenEXR reads a header: it reserves as much for an attribute as that claims to have, and a table of
/// blocks of up to 8 MB before it looks whether the file has one.
/// @param bytes  of the file @throws std::runtime_error
void check_attributes(std::string_view bytes);
/// Refuses what cannot be true: a small file that claims a picture of many gigabytes.
/// @param alone  false: of several parts together, whose own windows may be small
/// @throws std::runtime_error
void check_size(const Imf::Header& header, std::size_t channels, std::size_t file_bytes, bool alone = true);
/// Strings, floats, primaries.
void read_attributes(const Imf::Header& header, Image& image);

}  // namespace sconce
