// SPDX-License-Identifier: Apache-2.0
// Lines and labels of a diagram, as SVG or as pixels.
#pragma once

#include <string>
#include <vector>

#include "core/vec.h"
#include "image/draw.h"

namespace sconce {

struct Drawing {
  struct Line {
    std::vector<std::vector<glm::dvec2>> strokes;
    Color8 color{};
    double width = 1;
    double dash = 0;  ///< length of dashes; 0 = solid. As wide as the line: dots
    double gap = 0;   ///< between them
  };
  struct Label {
    glm::dvec2 at{0};  ///< on the base line
    std::string text;
    Color8 color{};
    enum class Anchor { start, middle, end } anchor = Anchor::start;
    double size = 11;
    bool over = false;  ///< lines: with a white rim, to be read there
  };

  double width = 0, height = 0;  ///< y runs down
  std::vector<Line> lines;
  std::vector<Label> labels;

  /// The part of a circle between two angles from straight down, degrees to the right.
  void arc(const glm::dvec2& center, double radius, double from, double to, const Color8& color);
};

std::string svg_of(const Drawing& drawing);
/// Smooth lines on white.
/// @param scale  pixels per unit
Image8 picture_of(const Drawing& drawing, int scale);

}  // namespace sconce
