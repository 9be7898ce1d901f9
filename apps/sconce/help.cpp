// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "declared.h"

namespace sconce::app {

namespace {

constexpr std::size_t kColumn = 30, kWidth = 100;

/// `left` in the first column, `right` wrapped in the second.
void add_row(std::string& out, const std::string& left, const std::string& right) {
  out += "  " + left;
  std::size_t column = left.size() + 2;
  if (column + 2 > kColumn) {
    out += '\n';
    column = 0;
  }
  out.append(kColumn - column, ' ');
  column = kColumn;
  for (const std::string& word : split(right, ' ')) {
    if (column + word.size() + 1 > kWidth) {
      out += '\n' + std::string(kColumn, ' ');
      column = kColumn;
    }
    if (column > kColumn) out += ' ', ++column;
    out += word;
    column += word.size();
  }
  out += '\n';
}

/// The default as help shows it: nothing where it says nothing, or where the text already says it.
std::string shown_default(const Declared& d) {
  const std::string value = d.is_flag() ? "" : d.show();
  const bool unset = value == "inf" || (value == "0" && d.doc.find("0 =") == std::string::npos);
  return unset || d.doc.find("default:") != std::string::npos ? "" : value;
}

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

}  // namespace

std::string next_step(std::string_view next, std::span<const std::string> files) {
  std::string text;
  std::size_t file = 0;
  for (std::size_t at = 0; at < next.size();) {
    const std::size_t open = next.find('{', at), close = next.find('}', at);
    text += next.substr(at, open - at);
    if (open == next.npos) break;
    text += file < files.size() ? shell_word(files[file++])
                                : std::string(next.substr(open + 1, close - open - 1));
    at = close + 1;
  }
  return text;
}

std::string help_text(const std::string& verb, const std::string& summary, std::span<const Declared> declared,
                      const Guide& guide) {
  std::string usage = "usage: sconce " + verb, positionals, options;
  for (const Declared& d : declared) {
    if (d.positional) {
      const std::string name = upper(d.names) + (d.many ? "..." : "");
      usage += d.required ? " " + name : " [" + name + "]";
      add_row(positionals, name, d.doc);
    } else {
      std::string left = join(split(d.names, ','), ", ");
      if (!d.is_flag()) left += " " + d.placeholder;
      const std::string value = shown_default(d);
      add_row(options, left, value.empty() ? d.doc : fmt::format("{} [{}]", d.doc, value));
    }
  }
  return fmt::format(
      "{} [options]\n\n{}\n\n{}{}options (defaults in brackets):\n{}\nexamples:\n  {}\n  {}\n\nnext: {}\n",
      usage, summary, positionals, positionals.empty() ? "" : "\n", options, guide.first, guide.second,
      next_step(guide.next));
}

}  // namespace sconce::app
