// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "goniometer/acquisition.h"
#include "import/side_table.h"

namespace sconce {

namespace {

constexpr double kMillimetre = 1e-3;

const SideNode& part(const SideNode& root, const std::filesystem::path& file, const char* name) {
  const SideNode* node = root.find(name);
  if (node == nullptr)
    throw Error(file.string(), fmt::format("has no table [{}]", name),
                "[filter], [plane], [camera], [pictures]");
  return *node;
}

double needed(const SideTable& table, const char* key) {
  const auto v = table.positive(key);
  if (!v) table.fail({}, fmt::format("{} is missing", key), "a number > 0");
  return *v;
}

int whole(const SideTable& table, const char* key, int most) {
  const double v = needed(table, key);
  if (v != std::floor(v) || v > most)
    table.fail(key, fmt::format("is {:g}", v), fmt::format("a whole number from 1 to {}", most));
  return static_cast<int>(v);
}

const SideNode::Array& array_of(const SideTable& table, const SideNode& node, const char* key,
                                std::size_t count) {
  const SideNode* found = node.find(key);
  const auto* list = found != nullptr ? std::get_if<SideNode::Array>(&found->value) : nullptr;
  if (list == nullptr || (count > 0 && list->size() != count))
    table.fail(key, "is no list of that length", "an array");
  return *list;
}

double number_in(const SideTable& table, const SideNode& node, const char* key) {
  const auto* v = std::get_if<double>(&node.value);
  if (v == nullptr || !std::isfinite(*v)) table.fail(key, "holds something else than numbers", "numbers");
  return *v;
}

void read_filter(const SideTable& table, LightField& grid) {
  const std::string basis = table.text("basis").value_or("bell");
  if (basis != "bell" && basis != "spline") table.fail("basis", "is '" + basis + "'", "bell, spline");
  grid.basis = basis == "bell" ? NearBasis::bell : NearBasis::spline;
  grid.columns = whole(table, "columns", 1000), grid.rows = whole(table, "rows", 1000);
  grid.spacing = needed(table, "spacing") * kMillimetre;
  const glm::dvec2 middle = -0.5 * grid.spacing * glm::dvec2(grid.columns - 1, grid.rows - 1);
  const auto first = table.pair("first");
  grid.first = first ? kMillimetre * glm::dvec2((*first)[0], (*first)[1]) : middle;
}

void read_plane(const SideTable& table, LightField& grid) {
  const auto distance = table.number("distance");
  if (!distance || !(*distance > 0))
    table.fail(distance ? "distance" : "", "the screen does not lie behind the filter",
               "millimetres > 0 from the filter to the screen, the way the light goes");
  grid.distance = *distance * kMillimetre;
  const double width = needed(table, "width") * kMillimetre;
  const double height = table.positive("height").value_or(width / kMillimetre) * kMillimetre;
  grid.width = whole(table, "pixels", 4096);
  grid.pixel = width / grid.width;
  grid.height = static_cast<int>(std::lround(height / grid.pixel));
  if (grid.height < 1 || grid.height > 4096 || std::abs(grid.height * grid.pixel / height - 1) > 1e-6)
    table.fail("height", "is no whole number of pixels", "a multiple of width / pixels");
  const auto corner = table.pair("corner");
  grid.corner =
      corner ? kMillimetre * glm::dvec2((*corner)[0], (*corner)[1]) : -0.5 * glm::dvec2(width, height);
}

void read_camera(const SideTable& table, const SideNode& node, Acquisition& out) {
  const SideNode::Array& corners = array_of(table, node, "corners", 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto* xy = std::get_if<SideNode::Array>(&corners[i].value);
    if (xy == nullptr || xy->size() != 2)
      table.fail("corners", "holds something else than points", "four [x, y] in pixels");
    out.corners[i] = {number_in(table, (*xy)[0], "corners"), number_in(table, (*xy)[1], "corners")};
  }
  double twice = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = out.corners[i], b = out.corners[(i + 1) % 4];
    twice += a.x * b.y - a.y * b.x;
  }
  if (std::abs(twice) < 2) table.fail("corners", "enclose nothing", "four corners of the screen");
  // Row 0 of a picture is on top, so what runs counter-clockwise on the screen has a negative area in pixels.
  if ((twice > 0) != table.flag("mirrored").value_or(false))
    table.fail("corners",
               twice > 0 ? "run round as in a mirror: in what order were they written?"
                         : "do not run round as in a mirror",
               "counter-clockwise seen along the light, from the least x and y; mirrored = true for a camera "
               "behind the screen");
  out.lux = table.positive("lux").value_or(1);
  if (const auto response = table.text("response"); response && *response != "srgb" && *response != "linear")
    table.fail("response", "is '" + *response + "'", "linear, srgb; or gamma = 2.2");
  else if (response && *response == "linear")
    out.gamma = 1;
  if (const auto gamma = table.positive("gamma")) out.gamma = *gamma;
  out.color = table.flag("color").value_or(true);
  if (table.has("white")) {
    const SideNode::Array& white = array_of(table, node, "white", 3);
    float* to[] = {&out.white.r, &out.white.g, &out.white.b};
    for (std::size_t i = 0; i < 3; ++i) *to[i] = static_cast<float>(number_in(table, white[i], "white"));
    if (!(std::min({out.white.r, out.white.g, out.white.b}) > 0))
      table.fail("white", "is not positive", "what pictures show of white, [r, g, b] > 0");
    out.white *= 1 / luminance(out.white);
  }
  out.saturation = table.positive("saturation").value_or(0);
  out.dark = table.text("dark").value_or("");
}

void read_pictures(const SideTable& table, const SideNode& node, Acquisition& out) {
  out.name = table.text("name").value_or("");
  out.negative = table.text("negative").value_or("");
  if (table.has("exposures"))
    for (const SideNode& v : array_of(table, node, "exposures", 0)) {
      out.exposures.push_back(number_in(table, v, "exposures"));
      if (!(out.exposures.back() > 0)) table.fail("exposures", "are not positive", "seconds > 0");
    }
  for (const auto& [key, pattern] : {std::pair("name", &out.name), std::pair("negative", &out.negative)}) {
    if (pattern->empty() && std::string_view(key) == "negative") continue;
    for (const char* mark : {"{m}", "{n}", "{e}"}) {
      const bool wanted = mark[1] != 'e' || !out.exposures.empty();
      if ((pattern->find(mark) != std::string::npos) != wanted)
        table.fail(table.has(key) ? key : "",
                   fmt::format("'{}' {} {}", *pattern, wanted ? "lacks" : "has", mark),
                   "{m} and {n} for column and row, {e} where exposures are listed");
    }
  }
}

}  // namespace

Acquisition read_acquisition(const std::filesystem::path& file) {
  const SideNode root = parse_side_file(file);
  const std::string where = file.string();
  const SideTable all(where, "the file", root, {"filter", "plane", "camera", "pictures"});
  Acquisition out;
  read_filter(SideTable(where, "[filter]", part(root, file, "filter"),
                        {"basis", "columns", "rows", "spacing", "first"}),
              out.grid);
  read_plane(SideTable(where, "[plane]", part(root, file, "plane"),
                       {"distance", "width", "height", "pixels", "corner"}),
             out.grid);
  const SideNode &camera = part(root, file, "camera"), &pictures = part(root, file, "pictures");
  read_camera(
      SideTable(where, "[camera]", camera,
                {"corners", "mirrored", "lux", "color", "white", "response", "gamma", "saturation", "dark"}),
      camera, out);
  read_pictures(SideTable(where, "[pictures]", pictures, {"name", "negative", "exposures"}), pictures, out);
  return out;
}

}  // namespace sconce
