// SPDX-License-Identifier: Apache-2.0
// Arrays of numbers made small for the way to a browser, which unpacks deflate by itself.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace sconce::web {

/// zlib of the bytes sorted by their place in the element (all first bytes, then all second ones, ...), each
/// minus its predecessor.
/// @param element  bytes of one; data.size() is a multiple of it
/// @throws Error
std::string pack(std::span<const std::byte> data, std::size_t element);

}  // namespace sconce::web
