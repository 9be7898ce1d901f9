// SPDX-License-Identifier: Apache-2.0
#include "photometry/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sconce {

namespace {

constexpr double kGap = 2.0 / 3;  // of a dash

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

/// What a line covers of each pixel, 0 to 1.
class Coverage {
 public:
  Coverage(int width, int height) : width_(width), height_(height), shares_(area(), 0.0f) {}

  void add(const glm::dvec2& a, const glm::dvec2& b, double width) {
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
    for (std::size_t i = 0; i < shares_.size(); ++i)
      for (std::size_t c = 0; c < 3 && shares_[i] > 0; ++c) {
        unsigned char& to = picture.data[3 * i + c];
        to = static_cast<unsigned char>(std::lround(
            static_cast<float>(to) + shares_[i] * (static_cast<float>(color[c]) - static_cast<float>(to))));
      }
  }

 private:
  std::size_t area() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  int width_, height_;
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
    const double period = line.dash * (1 + kGap);
    for (double at = 0; at < length;) {
      const double phase = std::fmod(walked + at, period);
      const bool drawn = phase < line.dash;
      const double end = std::min(length, at + (drawn ? line.dash : period) - phase + 1e-9);
      if (drawn)
        coverage.add(scale * (a + (b - a) * (at / length)), scale * (a + (b - a) * (end / length)),
                     scale * line.width);
      at = end;
    }
    walked += length;
  }
}

}  // namespace

void Drawing::circle(const glm::dvec2& center, double radius, const Color8& color) {
  constexpr int kSides = 120;
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= kSides; ++i) {
    const double a = 2 * std::numbers::pi * i / kSides;
    points.push_back(center + radius * glm::dvec2(std::cos(a), std::sin(a)));
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
        line.dash > 0 ? fmt::format(" stroke-dasharray=\"{:.3g} {:.3g}\"", line.dash, kGap * line.dash) : "",
        path);
  }
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  for (const Drawing::Label& label : drawing.labels)
    out += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" font-size=\"{:g}\" text-anchor=\"{}\">{}</text>\n",
        label.at.x, label.at.y, hex(label.color), label.size,
        kAnchors[static_cast<std::size_t>(label.anchor)], escaped_xml(label.text));
  return out + "</svg>\n";
}

Image8 picture_of(const Drawing& drawing, int scale) {
  Image8 out{static_cast<int>(std::ceil(drawing.width * scale)),
             static_cast<int>(std::ceil(drawing.height * scale)),
             3,
             {}};
  out.data.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 3, 255);
  for (const Drawing::Line& line : drawing.lines) {
    Coverage coverage(out.width, out.height);
    for (const std::vector<glm::dvec2>& points : line.strokes) trace(coverage, line, points, scale);
    coverage.paint(out, line.color);
  }
  for (const Drawing::Label& label : drawing.labels) {
    std::string text;  // the font is ASCII
    for (const char c : label.text)
      if (static_cast<unsigned char>(c) < 128) text += c;
    const int dot = std::max(1, static_cast<int>(std::lround(label.size * scale / 11 * 0.9)));
    const int width = text_width(text, dot);
    const int left = label.anchor == Drawing::Label::Anchor::start    ? 0
                     : label.anchor == Drawing::Label::Anchor::middle ? width / 2
                                                                      : width;
    draw_text(out, static_cast<int>(label.at.x * scale) - left,
              static_cast<int>(label.at.y * scale) - text_height(dot), text, dot, label.color);
  }
  return out;
}

}  // namespace sconce
