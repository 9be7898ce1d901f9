// SPDX-License-Identifier: Apache-2.0
// OBJ and MTL as statements: a keyword and what follows it on its line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sconce {

struct ObjStatement {
  std::string_view keyword, rest;  ///< rest: trimmed, a comment behind it included
  std::size_t line = 0;            ///< from 1
};

class ObjText {
 public:
  /// Lines end with LF, CR LF or CR; a backslash before it continues them.
  explicit ObjText(std::string text);

  /// The next one that is no comment; false at the end. Views live as long as this does.
  bool next(ObjStatement& statement);
  std::size_t done() const { return at_; }
  std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
  std::size_t at_ = 0, line_ = 1;
};

/// Takes the next word off the front; empty at the end or where a comment begins.
std::string_view take_word(std::string_view& rest);

}  // namespace sconce
