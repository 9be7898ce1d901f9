// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "photometry/formats.h"

namespace sconce {

namespace {

constexpr std::size_t kWidth = 120;  // LM-63 allows 132 characters a line

/// Numbers blank-separated in lines of at most kWidth; {} prints the shortest text that reads back the same.
class NumberLines {
 public:
  explicit NumberLines(std::string& out) : out_(out) {}
  void add(double v) {
    const std::string text = fmt::format("{}", v);
    if (column_ > 0 && column_ + 1 + text.size() > kWidth) end();
    if (column_ > 0) out_ += ' ', ++column_;
    out_ += text;
    column_ += text.size();
  }
  void end() {
    if (column_ > 0) out_ += "\r\n";
    column_ = 0;
  }

 private:
  std::string& out_;
  std::size_t column_ = 0;
};

/// Signs of LM-63-2002: width (along C90), length (along C0), height.
Vec3 signed_sizes(const Opening& o) {
  const Vec3 wlh(o.size.y, o.size.x, o.size.z);
  switch (o.shape) {
    case Opening::Shape::ellipsoid:
      return -wlh;
    case Opening::Shape::cylinder:
      if (o.axis == 0) return {-wlh.x, wlh.y, -wlh.z};
      if (o.axis == 1) return {wlh.x, -wlh.y, -wlh.z};
      return {-wlh.x, -wlh.y, wlh.z};
    default:
      return wlh;
  }
}

/// Which horizontal angles to write, and how far the table reaches with its symmetry.
std::pair<double, double> written_range(const Photometry& p) {
  switch (symmetry_of(p)) {
    case Symmetry::axial:
      return {0, 0};
    case Symmetry::quadrants:
      return {0, 90};
    case Symmetry::about_c0:
      return {0, 180};
    case Symmetry::about_c90:
      return {90, 270};
    default:
      return {p.azimuths.front(), p.azimuths.back()};
  }
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

std::string labels(const Photometry& p) {
  std::string out;
  for (const auto& [key, value] : p.keywords) {
    std::string text = (key.empty() ? "[OTHER] " : "[" + key + "] ") + one_line(value);
    for (; text.size() > kWidth; text = "[MORE] " + text.substr(kWidth))
      out += text.substr(0, kWidth) + "\r\n";
    out += text + "\r\n";
  }
  return out;
}

}  // namespace

std::string write_ies(const Photometry& p) {
  std::string out = "IESNA:LM-63-2002\r\n" + labels(p);
  NumberLines numbers(out);
  if (p.tilt.angles.empty()) {
    out += "TILT=NONE\r\n";
  } else {
    out += fmt::format("TILT=INCLUDE\r\n{}\r\n{}\r\n", p.tilt.geometry, p.tilt.angles.size());
    for (const std::vector<double>* list : {&p.tilt.angles, &p.tilt.factors}) {
      for (const double v : *list) numbers.add(v);
      numbers.end();
    }
  }
  // Horizontal and vertical angles; a type B table is kept the other way round.
  const bool b = p.type == Photometry::Type::b, c = p.type == Photometry::Type::c;
  const auto [from, to] = written_range(p);
  std::vector<std::size_t> planes;
  for (std::size_t a = 0; a < p.azimuths.size(); ++a)
    if (p.azimuths[a] >= from && p.azimuths[a] <= to) planes.push_back(a);
  const std::size_t vertical = b ? p.azimuths.size() : p.polars.size(),
                    horizontal = b ? p.polars.size() : planes.size();
  const LampSet lamp = p.lamps.empty() ? LampSet{} : p.lamps.front();
  const Vec3 size = signed_sizes(p.opening);
  const int type = c ? 1 : b ? 2 : 3;
  for (const double v :
       {lamp.count, p.absolute ? -1.0 : lamp.lumens / lamp.count, 1.0, static_cast<double>(vertical),
        static_cast<double>(horizontal), static_cast<double>(type), 2.0})
    numbers.add(v);
  for (const float v : {size.x, size.y, size.z}) numbers.add(std::stod(fmt::format("{}", v)));
  numbers.end();
  for (const double v : {1.0, 1.0, lamp.watts}) numbers.add(v);
  numbers.end();
  const double shift = c ? 0 : 90;
  for (const double v : b ? p.azimuths : p.polars) numbers.add(b ? v : v - shift);
  numbers.end();
  if (b)
    for (const double v : p.polars) numbers.add(v - shift);
  else
    for (const std::size_t a : planes) numbers.add(p.azimuths[a]);
  numbers.end();
  for (std::size_t h = 0; h < horizontal; ++h) {
    for (std::size_t v = 0; v < vertical; ++v) numbers.add(b ? p.at(v, h) : p.at(planes[h], v));
    numbers.end();
  }
  return out;
}

}  // namespace sconce
