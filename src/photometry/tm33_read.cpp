// SPDX-License-Identifier: Apache-2.0
// The XML itself is read by pugixml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>

#include "core/error.h"
#include "core/text.h"
#include "photometry/circle.h"
#include "photometry/formats.h"
#include "photometry/lines.h"

namespace sconce {

namespace {

constexpr int kMostValues = 4000000;

class Reader {
 public:
  Reader(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  Photometry run() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    const pugi::xml_node root = document.document_element();
    const std::string name = root.name();
    if (!parsed && text_.find("<IESTM33") == std::string_view::npos)
      throw NotMyFormat(where_, "is no TM-33 file");
    if (!parsed) throw Error(place(parsed.offset), std::string("is no valid XML: ") + parsed.description());
    if (!name.starts_with("IESTM33") && name != "LuminaireOpticalData")
      throw NotMyFormat(where_, "is no TM-33 file");
    out_.format = "TM-33";
    read_header(root.child("Header"));
    read_sizes(root.child("Luminaire").child("Dimensions"));
    const auto emitters = root.children("Emitter");
    const auto count = std::distance(emitters.begin(), emitters.end());
    if (count != 1)
      throw Error(where_, fmt::format("has {} emitters", count),
                  "one; of several the parts' places are not known");
    read_emitter(*emitters.begin());
    return std::move(out_);
  }

 private:
  /// "lamp.xml:12" of a byte of the file.
  std::string place(std::ptrdiff_t offset) const {
    return fmt::format("{}:{}", where_, line_of(text_, offset));
  }
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what,
                         const std::string& allowed = {}) const {
    throw Error(place(node.offset_debug()), what, allowed);
  }

  void read_header(const pugi::xml_node& header) {
    for (const auto& [element, keyword] :
         {std::pair("Manufacturer", "MANUFAC"), std::pair("CatalogNumber", "LUMCAT"),
          std::pair("Description", "LUMINAIRE"), std::pair("Laboratory", "TESTLAB"),
          std::pair("ReportNumber", "TEST"), std::pair("ReportDate", "ISSUEDATE")})
      if (const std::string text = trim(header.child_value(element)); !text.empty())
        out_.keywords.emplace_back(keyword, text);
  }

  double number(const pugi::xml_node& parent, const char* child, double otherwise) const {
    const pugi::xml_node node = parent.child(child);
    return node ? value(node, trim(node.child_value())) : otherwise;
  }
  double value(const pugi::xml_node& node, const std::string& text) const {
    const auto v = parse_number(text);
    if (!v || !std::isfinite(*v))
      fail(node, "'" + text + "' stands where " + node.name() + " should", "a number");
    return *v;
  }

  void read_emitter(const pugi::xml_node& emitter) {
    LampSet lamp;
    lamp.name = trim(emitter.child_value("Description"));
    lamp.lumens = std::max(0.0, number(emitter, "RatedLumens", 0));
    lamp.watts = number(emitter, "InputWattage", 0);
    lamp.color = trim(emitter.child("ColorTemperature").child_value("FixedCCT"));
    lamp.rendering = trim(emitter.child("ColorRendering").child_value("Ra"));
    out_.lamps = {lamp};
    out_.absolute = true;  // TM-33 gives candela as measured
    const pugi::xml_node luminous = emitter.child("LuminousData");
    // Both layouts are about: values in LuminousIntensity, or in LuminousData itself.
    const pugi::xml_node inner = luminous.child("LuminousIntensity"), data = inner ? inner
                                                                             : luminous.child("IntensityData")
                                                                                 ? luminous
                                                                                 : pugi::xml_node();
    if (!data) fail(emitter, "has no LuminousData with LuminousIntensity");
    for (const char* name : {"PhotometryType", "GonioType"})
      if (const std::string type = last_letter(data.child_value(name)); !type.empty() && type != "C")
        fail(data.child(name), "is photometry of type " + type, "type C; another as LM-63");
    if (const std::string metric = trim(data.child_value("Metric")); !metric.empty() && metric != "Luminous")
      fail(data.child("Metric"), "holds the metric '" + metric + "'", "Luminous");
    read_intensity(data);
    if (emitter.child("SpectralDistribution") || emitter.child("SpectralData"))
      note(emitter, "the emitter's spectrum is not used: the lamp is white unless a scene says otherwise");
  }

  /// "CIE _ B", "TypeB", "B" name their type last.
  static std::string last_letter(const std::string& text) {
    const std::string type = trim(text);
    return type.empty() ? type : type.substr(type.size() - 1);
  }

  /// TM-33 measures the housing; where and how large it shines it does not say.
  void read_sizes(const pugi::xml_node& dimensions) {
    if (!dimensions) return;
    const double length = number(dimensions, "Length", 0), width = number(dimensions, "Width", 0),
                 height = number(dimensions, "Height", 0);
    if (length < 0 || width < 0 || height < 0) fail(dimensions, "has a negative size", "sizes from 0 on");
    if (length > 0 || width > 0)
      note(dimensions,
           fmt::format("the housing of {:g} x {:g} x {:g} is no luminous opening: the lamp is a point",
                       length, width, height));
  }
  void note(const pugi::xml_node& node, const std::string& what) {
    out_.notes.push_back(fmt::format("line {}: {}", line_of(text_, node.offset_debug()), what));
  }

  void read_intensity(const pugi::xml_node& data) {
    const double multiplier = number(data, "Multiplier", 1);
    std::map<double, std::map<double, double>> planes;  // h -> v -> cd
    int count = 0, negative = 0;
    const bool long_names = bool(data.child("IntensityData"));
    const char *name = long_names ? "IntensityData" : "IntData", *across = long_names ? "horz" : "h",
               *down = long_names ? "vert" : "v";
    for (const pugi::xml_node& node : data.children(name)) {
      if (++count > kMostValues) fail(node, "holds too many values");
      const double h = value(node, trim(node.attribute(across).value())),
                   v = value(node, trim(node.attribute(down).value()));
      if (!(h >= 0 && h <= 360 && v >= 0 && v <= 180))
        fail(node, fmt::format("lies at h = {}, v = {}", h, v), "h from 0 to 360, v from 0 to 180");
      const double candela = multiplier * value(node, trim(node.child_value()));
      negative += candela < 0;
      if (!planes[h].emplace(v, std::max(0.0, candela)).second)
        fail(node, fmt::format("h = {}, v = {} stands twice", h, v));
    }
    if (planes.empty()) fail(data, "holds no IntData");
    if (negative > 0) note(data, fmt::format("{} candela values are negative and count as 0", negative));
    std::vector<double> azimuths, candela;
    for (const auto& [v, cd] : planes.begin()->second) out_.polars.push_back(v);
    for (const auto& [h, plane] : planes) {
      azimuths.push_back(h);
      std::size_t i = 0;
      for (const auto& [v, cd] : plane) {
        if (i >= out_.polars.size() || v != out_.polars[i++])
          fail(data, fmt::format("the plane h = {} has other angles than the first", h));
        candela.push_back(cd);
      }
      if (i != out_.polars.size())
        fail(data, fmt::format("the plane h = {} has other angles than the first", h));
    }
    if (!fill_circle(out_, azimuths, candela))
      fail(data, fmt::format("planes reach from {} to {}", azimuths.front(), azimuths.back()),
           "from 0 to 0, 90, 180 or 360, or from 90 to 270");
  }

  std::string_view text_;
  std::string where_;
  Photometry out_;
};

}  // namespace

Photometry parse_tm33(std::string_view text, const std::string& where) {
  return Reader(text, where).run();
}

}  // namespace sconce
