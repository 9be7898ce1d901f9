// SPDX-License-Identifier: Apache-2.0
#include "image/stroke_font.h"

#include <algorithm>
#include <array>

namespace sconce {

namespace {

struct Glyph {
  char32_t sign;
  const char*
      strokes;  ///< points as x, y of two base-36 digits; blanks part strokes; ~ rounds the corners of one
};

// Drawn for this file. Capitals stand from y = 0 to the base line at 12, small letters from 4, tails end
// at 16.
constexpr Glyph kGlyphs[] = {
    {U'A', "0c408c 1878"},
    {U'B', "000c ~00707606 ~06868c0c"},
    {U'C', "~8380000c8c89"},
    {U'D', "000c ~00808c0c"},
    {U'E', "80000c8c 0666"},
    {U'F', "80000c 0666"},
    {U'G', "~8380000c8c86 8656"},
    {U'H', "000c 808c 0686"},
    {U'I', "000c"},
    {U'J', "~606c0c09"},
    {U'K', "000c 8007 358c"},
    {U'L', "000c8c"},
    {U'M', "0c0048808c"},
    {U'N', "0c008c80"},
    {U'O', "~40808c0c0040"},
    {U'P', "000c ~00808707"},
    {U'Q', "~40808c0c0040 598d"},
    {U'R', "000c ~00808707 478c"},
    {U'S', "~82800006868c0c0a"},
    {U'T', "0080 404c"},
    {U'U', "~000c8c80"},
    {U'V', "004c80"},
    {U'W', "002c536c80"},
    {U'X', "008c 800c"},
    {U'Y', "004680 464c"},
    {U'Z', "00800c8c"},
    {U'a', "646c ~6664040c6c6a"},
    {U'b', "000c ~0604646c0c0a"},
    {U'c', "~6664040c6c6a"},
    {U'd', "606c ~6664040c6c6a"},
    {U'e', "0868 ~6864040c6c6a"},
    {U'f', "~50202c 0454"},
    {U'g', "~6664040c6c6a ~646g0g0e"},
    {U'h', "000c ~0704646c"},
    {U'i', "040c 0001"},
    {U'j', "~242g0g 2021"},
    {U'k', "000c 6409 286c"},
    {U'l', "000c"},
    {U'm', "040c ~0704545c ~5754a4ac"},
    {U'n', "040c ~0704646c"},
    {U'o', "~34646c0c0434"},
    {U'p', "040g ~0604646c0c0a"},
    {U'q', "646g ~6664040c6c6a"},
    {U'r', "040c ~07044454"},
    {U's', "~65640408686c0c0b"},
    {U't', "~202c5c 0454"},
    {U'u', "~040c6c69 646c"},
    {U'v', "043c64"},
    {U'w', "042c466c84"},
    {U'x', "046c 640c"},
    {U'y', "043c 641g"},
    {U'z', "04640c6c"},
    {U'0', "~30707c0c0030"},
    {U'1', "03303c"},
    {U'2', "~030070750c 0c7c"},
    {U'3', "~0200707636 ~36767c0c0a"},
    {U'4', "5c500878"},
    {U'5', "700005 ~05757c0c0a"},
    {U'6', "~7270000c7c750508"},
    {U'7', "00703c"},
    {U'8', "~307076060030 ~36767c0c0636"},
    {U'9', "~0a0c7c7000077774"},
    {U'.', "0b0c"},
    {U',', "0b0e"},
    {U':', "0506 0b0c"},
    {U';', "0506 0b0e"},
    {U'-', "0747"},
    {U'–', "0787"},
    {U'+', "0868 353b"},
    {U'/', "0d50"},
    {U'(', "~30030d3g"},
    {U')', "~00333d0g"},
    {U'[', "30000g3g"},
    {U']', "00303g0g"},
    {U'%', "0c80 ~103034040010 ~78888c5c5878"},
    {U'°', "~204044040020"},
    {U'²', "~01004042 4206 0646"},
    {U'×', "056b 650b"},
    {U'·', "0708"},
    {U'=', "0666 0a6a"},
    {U'_', "0d6d"},
    {U'\'', "0003"},
    {U'"', "0003 2023"},
    {U'*', "353b 066a 0a66"},
    {U'<', "64086c"},
    {U'>', "04680c"},
    {U'!', "0008 0b0c"},
    {U'?', "~0200606437 3739 3b3c"},
    {U'|', "000g"},
    {U'#', "202c 606c 0484 0888"},
    {U'&', "~8c1310505308090c6c87"},
    {U'@', "~8c0c00808a5a5484"},
};

constexpr double kBase = 12, kGap = 3.2, kBlank = 4;  // units; between letters; of a blank

/// Base letters of U+00C0 to U+00FF.
constexpr std::string_view kLatin = "AAAAAAACEEEEIIIIDNOOOOO\xd7OUUUUYTsaaaaaaaceeeeiiiidnooooo\xf7ouuuuyty";

char32_t plain(char32_t sign) {
  if (sign == 0xd7 || sign < 0xc0 || sign > 0xff) return sign;
  return static_cast<unsigned char>(kLatin[sign - 0xc0]);
}

std::vector<char32_t> decoded(std::string_view text) {
  std::vector<char32_t> out;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    char32_t sign = more == 0 ? first : first & (0x3fu >> more);
    ++i;
    for (int k = 0; k < more && i < text.size(); ++k, ++i)
      sign = sign << 6 | (static_cast<unsigned char>(text[i]) & 0x3fu);
    out.push_back(plain(sign));
  }
  return out;
}

double digit(char c) {
  return c <= '9' ? c - '0' : c - 'a' + 10;
}

using Stroke = std::vector<glm::dvec2>;

/// Corners cut to a quarter, again and again; ends stay.
Stroke rounded(Stroke points) {
  for (int turn = 0; turn < 3; ++turn) {
    Stroke next{points.front()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const glm::dvec2 a = points[i], b = points[i + 1];
      if (i > 0) next.push_back(0.75 * a + 0.25 * b);
      if (i + 2 < points.size()) next.push_back(0.25 * a + 0.75 * b);
    }
    next.push_back(points.back());
    points = std::move(next);
  }
  return points;
}

std::vector<Stroke> strokes_of(const Glyph& glyph) {
  std::vector<Stroke> out;
  std::string_view all = glyph.strokes;
  while (!all.empty()) {
    std::string_view one = all.substr(0, all.find(' '));
    all.remove_prefix(std::min(all.size(), one.size() + 1));
    const bool round = one.front() == '~';
    if (round) one.remove_prefix(1);
    Stroke points;
    for (std::size_t i = 0; i + 1 < one.size(); i += 2) points.emplace_back(digit(one[i]), digit(one[i + 1]));
    out.push_back(round ? rounded(std::move(points)) : std::move(points));
  }
  return out;
}

const Glyph* find(char32_t sign) {
  const auto* found = std::ranges::find(kGlyphs, sign, &Glyph::sign);
  return found == std::end(kGlyphs) ? nullptr : found;
}

double width_of(const std::vector<Stroke>& strokes) {
  double out = 0;
  for (const Stroke& stroke : strokes)
    for (const glm::dvec2& p : stroke) out = std::max(out, p.x);
  return out;
}

double unit_of(double size) {
  return 0.73 * size / kBase;
}

}  // namespace

std::vector<Stroke> strokes_of(std::string_view text, double size) {
  std::vector<Stroke> out;
  double x = 0;
  for (const char32_t sign : decoded(text)) {
    const Glyph* glyph = find(sign);
    if (glyph == nullptr) {
      x += kBlank + kGap;
      continue;
    }
    std::vector<Stroke> strokes = strokes_of(*glyph);
    const double width = width_of(strokes);
    for (Stroke& stroke : strokes) {
      for (glm::dvec2& p : stroke) p = unit_of(size) * (p + glm::dvec2(x, -kBase));
      out.push_back(std::move(stroke));
    }
    x += width + kGap;
  }
  return out;
}

double stroke_text_width(std::string_view text, double size) {
  double x = 0;
  for (const char32_t sign : decoded(text)) {
    const Glyph* glyph = find(sign);
    x += (glyph == nullptr ? kBlank : width_of(strokes_of(*glyph))) + kGap;
  }
  return unit_of(size) * std::max(0.0, x - kGap);
}

}  // namespace sconce
