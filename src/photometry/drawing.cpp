// SPDX-License-Identifier: Apache-2.0
#include "photometry/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/stroke_font.h"

namespace sconce {

namespace {

constexpr double kPen = 0.085, kRim = 0.36;  // widths of letters' lines and of the rim, of a font's size

std::string hex(const Color8& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string escaped_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// Dashes have round ends, which add the width of the line to them.
double straight(const Drawing::Line& line) {
  return std::max(0.01, line.dash - line.width);
}

/// What lines cover of each pixel of a rectangle, 0 to 1.
class Coverage {
 public:
  /// @param low, high  of the rectangle, pixels; what of it lies outside of the picture is left out
  Coverage(const Image8& picture, const glm::dvec2& low, const glm::dvec2& high)
      : left_(std::clamp(static_cast<int>(std::floor(low.x)), 0, picture.width)),
        top_(std::clamp(static_cast<int>(std::floor(low.y)), 0, picture.height)),
        width_(std::clamp(static_cast<int>(std::ceil(high.x)), left_, picture.width) - left_),
        height_(std::clamp(static_cast<int>(std::ceil(high.y)), top_, picture.height) - top_),
        shares_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0f) {}

  void add(const glm::dvec2& from, const glm::dvec2& to, double width) {
    const glm::dvec2 corner(left_, top_), a = from - corner, b = to - corner;
    const double reach = 0.5 * width + 1;
    const auto first = [&](double v) { return std::max(0, static_cast<int>(v - reach)); };
    for (int y = first(std::min(a.y, b.y)); y < std::min<double>(height_, std::max(a.y, b.y) + reach); ++y)
      for (int x = first(std::min(a.x, b.x)); x < std::min<double>(width_, std::max(a.x, b.x) + reach); ++x) {
        const glm::dvec2 p(x + 0.5, y + 0.5), along = b - a;
        const double length2 = glm::dot(along, along);
        const double t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
        const double share = std::clamp(0.5 * width + 0.5 - glm::length(p - a - t * along), 0.0, 1.0);
        float& kept = shares_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x)];
        kept = std::max(kept, static_cast<float>(share));
      }
  }
  void paint(Image8& picture, const Color8& color) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float share = shares_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                    static_cast<std::size_t>(x)];
        unsigned char* to =
            &picture.data[3 * (static_cast<std::size_t>(top_ + y) * static_cast<std::size_t>(picture.width) +
                               static_cast<std::size_t>(left_ + x))];
        for (std::size_t c = 0; c < 3 && share > 0; ++c)
          to[c] = static_cast<unsigned char>(
              std::lround(static_cast<float>(to[c]) +
                          share * (static_cast<float>(color[c]) - static_cast<float>(to[c]))));
      }
  }

 private:
  int left_, top_, width_, height_;
  std::vector<float> shares_;
};

void trace(Coverage& coverage, const Drawing::Line& line, const std::vector<glm::dvec2>& points,
           double scale) {
  double walked = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 a = points[i], b = points[i + 1];
    const double length = glm::length(b - a);
    if (!(line.dash > 0) || !(length > 0)) {
      coverage.add(scale * a, scale * b, scale * line.width);
      continue;
    }
    const double dash = straight(line), period = line.dash + line.gap;
    for (double at = 0; at < length;) {
      const double phase = std::fmod(walked + at, period);
      const bool drawn = phase < dash;
      const double end = std::min(length, at + (drawn ? dash : period) - phase + 1e-9);
      if (drawn)
        coverage.add(scale * (a + (b - a) * (at / length)), scale * (a + (b - a) * (end / length)),
                     scale * line.width);
      at = end;
    }
    walked += length;
  }
}

}  // namespace

void Drawing::arc(const glm::dvec2& center, double radius, double from, double to, const Color8& color) {
  constexpr int kSides = 120;
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= kSides; ++i) {
    const double a = (from + (to - from) * i / kSides) * std::numbers::pi / 180;
    points.push_back(center + radius * glm::dvec2(std::sin(a), std::cos(a)));
  }
  lines.push_back({{std::move(points)}, color});
}

std::string svg_of(const Drawing& drawing) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      drawing.width, drawing.height);
  for (const Drawing::Line& line : drawing.lines) {
    std::string path;
    for (const std::vector<glm::dvec2>& points : line.strokes)
      for (std::size_t i = 0; i < points.size(); ++i)
        path += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "M" : "L", points[i].x, points[i].y);
    out += fmt::format(
        "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{} d=\"{}\"/>\n", hex(line.color), line.width,
        line.dash > 0 ? fmt::format(" stroke-linecap=\"round\" stroke-dasharray=\"{:.3g} {:.3g}\"",
                                    straight(line), line.dash + line.gap - straight(line))
                      : "",
        path);
  }
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  for (const Drawing::Label& label : drawing.labels)
    out += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" font-size=\"{:g}\" text-anchor=\"{}\"{}>{}</text>\n",
        label.at.x, label.at.y, hex(label.color), label.size,
        kAnchors[static_cast<std::size_t>(label.anchor)],
        label.over ? " stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\""
                   : "",
        escaped_xml(label.text));
  return out + "</svg>\n";
}

Image8 picture_of(const Drawing& drawing, int scale) {
  Image8 out{static_cast<int>(std::ceil(drawing.width * scale)),
             static_cast<int>(std::ceil(drawing.height * scale)),
             3,
             {}};
  out.data.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 3, 255);
  for (const Drawing::Line& line : drawing.lines) {
    Coverage coverage(out, glm::dvec2(0), glm::dvec2(out.width, out.height));
    for (const std::vector<glm::dvec2>& points : line.strokes) trace(coverage, line, points, scale);
    coverage.paint(out, line.color);
  }
  for (const Drawing::Label& label : drawing.labels) {
    const double size = label.size * scale, width = stroke_text_width(label.text, size);
    const glm::dvec2 begin(
        scale * label.at.x - (label.anchor == Drawing::Label::Anchor::start    ? 0
                              : label.anchor == Drawing::Label::Anchor::middle ? 0.5 * width
                                                                               : width),
        scale * label.at.y);
    const glm::dvec2 low = begin - glm::dvec2(size), high = begin + glm::dvec2(width + size, size);
    Coverage letters(out, low, high), rim(out, low, high);
    for (const std::vector<glm::dvec2>& stroke : strokes_of(label.text, size))
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
        letters.add(begin + stroke[i], begin + stroke[i + 1], std::max(1.0, kPen * size));
        if (label.over) rim.add(begin + stroke[i], begin + stroke[i + 1], kRim * size);
      }
    rim.paint(out, {255, 255, 255});
    letters.paint(out, label.color);
  }
  return out;
}

}  // namespace sconce
