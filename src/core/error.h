// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace sconce {

/// The one exception at borders. `what()` is one line: "where: what (allowed: ...)".
class Error : public std::runtime_error {
 public:
  /// @param where    file, file:line or key; may be empty
  /// @param what     what is wrong
  /// @param allowed  what would have been right; may be empty
  Error(const std::string& where, const std::string& what, const std::string& allowed = {})
      : std::runtime_error((where.empty() ? "" : where + ": ") + what +
                           (allowed.empty() ? "" : " (allowed: " + allowed + ")")) {}
};

/// The input is not in this reader's format; another reader may take it. "Not mine" is not "broken".
class NotMyFormat : public Error {
 public:
  using Error::Error;
};

/// The caller asked for something that does not exist: an option, a group, a name. Exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The user cancelled (std::stop_token). Exit code 1, nothing half-written.
class Cancelled : public Error {
 public:
  Cancelled() : Error({}, "cancelled") {}
};

}  // namespace sconce
