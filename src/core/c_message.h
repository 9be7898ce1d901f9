// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>

namespace sconce {

/// A line to a C caller's buffer, cut where it is too long. @param message  may be null
inline void copy_message(const char* line, char* message, std::size_t size) {
  if (message == nullptr || size == 0) return;
  std::strncpy(message, line, size - 1);
  message[size - 1] = '\0';
}

}  // namespace sconce
