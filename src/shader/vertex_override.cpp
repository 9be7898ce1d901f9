// SPDX-License-Identifier: Apache-2.0
#include "shader/vertex_override.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <vector>

#include "core/error.h"

namespace sconce {

namespace {

constexpr std::array kVersions{110, 120, 130, 140, 150, 330, 400, 410, 420, 430, 440, 450, 460};
constexpr std::array kEsVersions{100, 300, 310, 320};
/// Words that only other stages know.
constexpr std::array<std::string_view, 7> kElsewhere{"gl_FragCoord",    "gl_FragColor", "gl_FragData",
                                                     "gl_FrontFacing",  "EmitVertex",   "gl_TessCoord",
                                                     "gl_WorkGroupSize"};

bool begins_word(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool in_word(char c) {
  return begins_word(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// A word, a number or a sign; comments and blanks are between tokens.
struct Token {
  std::string_view text;
  std::size_t at;  ///< its place in the shader
  int line;
  std::string_view directive;  ///< of a line that begins with #: its word, as "if"; # for the sign itself
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void refuse(int line, const std::string& what, const std::string& allowed) const {
    throw Error(fmt::format("{}:{}", name_, line), what, allowed);
  }

  std::vector<Token> tokens() {
    std::vector<Token> all;
    std::string_view directive;
    bool line_start = true;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (starts_with("\\\n") || starts_with("\\\r\n")) {  // the line goes on
        at_ += text_[at_ + 1] == '\r' ? 3 : 2, ++line_;
      } else if (c == '\n') {
        ++line_, ++at_, directive = {}, line_start = true;
      } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        ++at_;
      } else if (starts_with("//")) {
        line_comment();
      } else if (starts_with("/*")) {
        block_comment();
      } else {
        const std::string_view token = next_token();
        if (c == '#' && line_start)
          directive = token;
        else if (directive == "#")
          directive = token;
        line_start = false;
        all.push_back({token, at_, line_, directive});
        at_ += token.size();
      }
    }
    return all;
  }
  int line() const { return line_; }

 private:
  bool starts_with(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  void line_comment() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (text_[end - 1] == '\\' || text_.substr(at_, end - at_).ends_with("\\\r"))
      refuse(line_, "a comment that ends with a backslash: compilers differ on the next line",
             "none at its end");
    at_ = end;
  }
  void block_comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos) refuse(line_, "a comment that does not end", "*/");
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = end + 2;
  }
  std::string_view next_token() const {
    std::size_t end = at_ + 1;
    if (in_word(text_[at_]))
      while (end < text_.size() && in_word(text_[end])) ++end;
    return text_.substr(at_, end - at_);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

struct Dialect {
  int version = 110;
  bool es = false;

  bool attributes() const { return version < 130 && (!es || version == 100); }
};

/// What the shader is written in. @throws Error where that is nothing that we know
Dialect find_dialect(const Reader& reader, const std::vector<Token>& tokens) {
  Dialect dialect;
  if (tokens.size() < 3 || tokens[0].text != "#" || tokens[1].text != "version") return dialect;
  const std::string_view number = tokens[2].text;
  std::from_chars(number.data(), number.data() + number.size(), dialect.version);
  dialect.es = dialect.version == 100 ||
               (tokens.size() > 3 && tokens[3].line == tokens[0].line && tokens[3].text == "es");
  const bool known =
      dialect.es ? std::find(kEsVersions.begin(), kEsVersions.end(), dialect.version) != kEsVersions.end()
                 : std::find(kVersions.begin(), kVersions.end(), dialect.version) != kVersions.end();
  if (!known)
    reader.refuse(tokens[0].line, fmt::format("GLSL version {}", number),
                  "110 to 460, 100, 300 es to 320 es");
  return dialect;
}

void check_branches(const Reader& reader, const std::vector<Token>& tokens) {
  std::vector<int> open;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].directive != "#") continue;
    const std::string_view word = tokens[i + 1].directive;
    if (word == "if" || word == "ifdef" || word == "ifndef") open.push_back(tokens[i].line);
    if (word != "endif") continue;
    if (open.empty()) reader.refuse(tokens[i].line, "#endif without #if", "pairs of them");
    open.pop_back();
  }
  if (!open.empty()) reader.refuse(open.back(), "#if without #endif", "pairs of them");
}

/// Places of main, all of which mean the function. @throws Error where one does not, or none is there
std::vector<std::size_t> find_main(const Reader& reader, const std::vector<Token>& tokens) {
  const auto text = [&](std::size_t i) { return i < tokens.size() ? tokens[i].text : std::string_view(); };
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string_view directive = tokens[i].directive;
    if (tokens[i].text != "main" || directive == "error" || directive == "pragma" || directive == "include")
      continue;
    if (!directive.empty() && (text(i - 1) == "define" || text(i - 1) == "undef"))
      reader.refuse(tokens[i].line, "main is a macro", "the function main, by its name");
    if (text(i + 1) != "(" || (i > 0 && text(i - 1) == "."))
      reader.refuse(tokens[i].line, "main is the name of something else, too", "the function main alone");
    if (i > 0 && text(i - 1) == "void" &&
        !(text(i + 2) == ")" || (text(i + 2) == "void" && text(i + 3) == ")")))
      reader.refuse(tokens[i].line, "main takes parameters", "void main()");
    places.push_back(tokens[i].at);
  }
  if (places.empty())
    reader.refuse(reader.line(), "there is no function main up to here",
                  "the whole vertex shader, with includes put in");
  return places;
}

}  // namespace

std::string override_vertex_position(std::string_view shader, const std::string& name,
                                     const VertexOverride& names) {
  Reader reader(shader, name);
  const std::vector<Token> tokens = reader.tokens();
  const Dialect dialect = find_dialect(reader, tokens);
  check_branches(reader, tokens);
  for (const Token& token : tokens) {
    if (token.text == names.place || token.text == names.enable || token.text == names.host_main)
      reader.refuse(token.line, fmt::format("the name {} is taken", token.text),
                    "a shader not yet rewritten");
    if (std::find(kElsewhere.begin(), kElsewhere.end(), token.text) != kElsewhere.end())
      reader.refuse(token.line, fmt::format("{} is of another stage", token.text), "a vertex shader");
  }

  std::string out;
  std::size_t done = 0;
  for (const std::size_t at : find_main(reader, tokens)) {
    out.append(shader.substr(done, at - done)).append(names.host_main);
    done = at + std::string_view("main").size();
  }
  out.append(shader.substr(done));
  if (out.ends_with('\\')) out += ' ';
  const std::string location =
      names.location < 0 ? std::string() : fmt::format("layout(location = {}) ", names.location);
  // Comparing floats: GLSL 110 has no other uniforms that every host can set.
  out += fmt::format(
      "\n{}{} vec2 {};\nuniform float {};\nvoid main() {{\n  {}();\n"
      "  if ({} > 0.5) gl_Position = vec4(2.0 * {} - 1.0, 0.0, 1.0);\n}}\n",
      location, dialect.attributes() ? "attribute" : "in", names.place, names.enable, names.host_main,
      names.enable, names.place);
  return out;
}

}  // namespace sconce
