// SPDX-License-Identifier: Apache-2.0
#include "import/obj_text.h"

#include <algorithm>

namespace sconce {

namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr char kContinued = '\v';  // stands for a line's end that ends no statement

std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string_view()
                                         : s.substr(first, s.find_last_not_of(kBlanks) - first + 1);
}

std::string_view until_blank(std::string_view s) {
  return s.substr(0, s.find_first_of(kBlanks));
}

}  // namespace

ObjText::ObjText(std::string text) : text_(std::move(text)) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    char& c = text_[i];
    const bool last = i + 1 == text_.size();
    if (c == '\v' || c == '\0') c = ' ';
    if (c == '\r') c = !last && text_[i + 1] == '\n' ? ' ' : '\n';
    const bool windows = c == ' ' && !last && text_[i + 1] == '\n' && i > 0;
    if (windows && text_[i - 1] == '\\') text_[i - 1] = ' ', text_[i + 1] = kContinued;
    if (c == '\n' && i > 0 && text_[i - 1] == '\\') text_[i - 1] = ' ', c = kContinued;
  }
}

bool ObjText::next(ObjStatement& statement) {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view whole = std::string_view(text_).substr(at_, end - at_);
    statement.line = line_;
    line_ += 1 + static_cast<std::size_t>(std::count(whole.begin(), whole.end(), kContinued));
    at_ = end + 1;
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#') continue;
    statement.keyword = until_blank(line);
    statement.rest = trimmed(line.substr(statement.keyword.size()));
    return true;
  }
  return false;
}

std::string_view take_word(std::string_view& rest) {
  rest = trimmed(rest);
  if (rest.empty() || rest.front() == '#') return {};
  const std::string_view word = until_blank(rest);
  rest.remove_prefix(word.size());
  return word;
}

}  // namespace sconce
