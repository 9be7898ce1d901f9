// SPDX-License-Identifier: Apache-2.0
#include "probe_report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "image/io.h"
#include "import/uri.h"
#include "session/look.h"
#include "session/plane_picture.h"

namespace sconce::app {

namespace {

std::string number(float v) {
  return std::isfinite(v) ? fmt::format("{:.5g}", v) : "";
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:60em;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.15em .8em;text-align:right;border-bottom:1px "
    "solid "
    "#ddd}td:first-child,th:first-child{text-align:left}img{max-width:100%}h1{font-size:1.4em}h2{font-size:1."
    "1em}";

}  // namespace

LuxStatistics ProbeReport::statistics(const std::vector<float>& values) const {
  std::vector<float> reached;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(lux[i])) reached.push_back(values[i]);
  return lux_statistics(reached);
}

std::string probe_csv(const ProbeReport& r) {
  std::string text = "x,y,z,nx,ny,nz,lux";
  if (!r.daylight.empty()) text += ",daylight_factor_percent";
  for (const std::string& group : r.groups) text += "," + quoted("lux " + group);
  text += "\n";
  for (std::size_t i = 0; i < r.lux.size(); ++i) {
    const SurfacePoint& p = r.at.points[i];
    text +=
        fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}", p.position.x, p.position.y, p.position.z,
                    p.shading_normal.x, p.shading_normal.y, p.shading_normal.z, number(r.lux[i]));
    if (!r.daylight.empty()) text += "," + number(r.daylight[i]);
    for (const auto& part : r.parts) text += "," + number(part[i]);
    text += "\n";
  }
  return text;
}

std::string probe_lines(const ProbeReport& r) {
  std::string text;
  for (const Rgb& e : r.colors) text += fmt::format("{:.6e}\t{:.6e}\t{:.6e}\n", e.r, e.g, e.b);
  return text;
}

Image8 probe_picture(const ProbeReport& r) {
  if (!r.at.plane) throw UsageError({}, "a picture needs --plane: loose points have none", ".csv, .html");
  FalseColor scale = fitting_scale(2 * r.statistics(r.lux).average, false);
  scale.lines = true;
  return plane_picture(*r.at.plane, r.lux, scale);
}

std::string probe_html(const ProbeReport& r) {
  const LuxStatistics all = r.statistics(r.lux);
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><meta "
      "charset=\"utf-8\"><title>Illuminance</title><style>{}</style>\n"
      "<h1>Illuminance at {} "
      "points</h1>\n<table><tr><th></th><th>minimum</th><th>average</th><th>maximum</th>"
      "<th>U0 = min/avg</th><th>Ud = min/max</th></tr>\n",
      kStyle, r.lux.size());
  const auto row = [&](std::string_view name, const LuxStatistics& s, const char* unit) {
    text += fmt::format(
        "<tr><td>{}</td><td>{:.4g}{}</td><td>{:.4g}{}</td><td>{:.4g}{}</td><td>{:.2f}</td><td>{:.2f}</td></"
        "tr>\n",
        escaped(name), s.minimum, unit, s.average, unit, s.maximum, unit, s.uniformity(), s.diversity());
  };
  row("all light", all, " lx");
  if (!r.daylight.empty()) row("daylight factor", r.statistics(r.daylight), " %");
  for (std::size_t g = 0; g < r.groups.size(); ++g) row(r.groups[g], r.statistics(r.parts[g]), " lx");
  text += "</table>\n";
  if (r.at.plane)
    text += fmt::format(
        "<img alt=\"the plane in false colours, {:.4g} to {:.4g} lx\" src=\"data:image/png;base64,{}\">\n",
        all.minimum, all.maximum, encode_base64(encode_png(probe_picture(r))));
  text += "<h2>Assumptions</h2>\n<table>\n";
  for (const auto& [name, value] : r.assumptions)
    text += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
  text += "</table>\n<h2>Points</h2>\n<table><tr><th>x, y, z (m)</th><th>lx</th></tr>\n";
  for (std::size_t i = 0; i < r.lux.size(); ++i) {
    const Vec3& p = r.at.points[i].position;
    text +=
        fmt::format("<tr><td>{:.3g}, {:.3g}, {:.3g}</td><td>{}</td></tr>\n", p.x, p.y, p.z, number(r.lux[i]));
  }
  return text + "</table></html>\n";
}

}  // namespace sconce::app
