// SPDX-License-Identifier: Apache-2.0
// GLDF containers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "photometry/formats.h"
#include "photometry/lines.h"
#include "photometry/zip_file.h"

namespace sconce {

namespace {

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : zip_(path, "GLDF"), text_(zip_.read("product.xml")) {}

  Photometry run() {
    const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
    if (!parsed) throw Error(place(parsed.offset), std::string("is no valid XML: ") + parsed.description());
    definitions_ = document_.document_element().child("GeneralDefinitions");
    if (!definitions_) throw Error(place(0), "has no GeneralDefinitions", "a GLDF product");
    const pugi::xml_node file = photometric_file(variant());
    const std::string type = file.attribute("contentType").value(), name = trim(file.child_value());
    if (!type.starts_with("ldc/"))
      fail(file, "the photometry is of type '" + type + "'", "ldc/eulumdat, ldc/ies, ldc/iesxml");
    if (std::string(file.attribute("type").value()) == "url")
      fail(file, "the photometry '" + name + "' lies on the net", "a file in the container");
    Photometry out = parse_photometry(zip_.read("ldc/" + name), zip_.where() + "/ldc/" + name);
    out.notes.insert(out.notes.end(), notes_.begin(), notes_.end());
    if (rated_ > 0 && std::abs(flux(out) / rated_ - 1) > 0.005)
      out.notes.push_back(fmt::format(
          "product.xml rates the emitter at {:g} lm, its photometric file gives {:.1f} lm; the file counts",
          rated_, flux(out)));
    return out;
  }

 private:
  std::string place(std::ptrdiff_t offset) const {
    return fmt::format("{}/product.xml:{}", zip_.where(), line_of(text_, offset));
  }
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what,
                         const std::string& allowed = {}) const {
    throw Error(place(node.offset_debug()), what, allowed);
  }

  /// The child of a list with an id. @param from  who refers to it
  pugi::xml_node with_id(const char* list, const char* child, const std::string& id,
                         const pugi::xml_node& from) const {
    const pugi::xml_node found = definitions_.child(list).find_child_by_attribute(child, "id", id.c_str());
    if (!found) fail(from, fmt::format("refers to the {} '{}', which is not there", child, id));
    return found;
  }

  /// The first variant; a product without variants is its emitters.
  pugi::xml_node variant() {
    const pugi::xml_node variants =
        document_.document_element().child("ProductDefinitions").child("Variants");
    const auto all = variants.children("Variant");
    const auto count = std::distance(all.begin(), all.end());
    if (count > 1)
      notes_.push_back(fmt::format("of {} variants the first, '{}', is taken", count,
                                   variants.child("Variant").attribute("id").value()));
    return variants.child("Variant");
  }

  /// What all emitters of the variant refer to.
  pugi::xml_node photometric_file(const pugi::xml_node& variant) {
    std::set<std::string> emitters;
    const auto references = variant.select_nodes(".//*[@emitterId]");
    for (const pugi::xpath_node& reference : references)
      emitters.insert(reference.node().attribute("emitterId").value());
    if (emitters.empty())
      for (const pugi::xml_node& emitter : definitions_.child("Emitters").children("Emitter"))
        emitters.insert(emitter.attribute("id").value());
    if (emitters.empty()) fail(variant ? variant : definitions_, "has no emitter");
    std::set<std::string> photometries;
    for (const std::string& id : emitters) {
      const pugi::xml_node emitter = with_id("Emitters", "Emitter", id, variant ? variant : definitions_);
      for (const pugi::xpath_node& reference : emitter.select_nodes(".//*[@photometryId]"))
        photometries.insert(reference.node().attribute("photometryId").value());
      if (const pugi::xml_node rated = emitter.select_node(".//RatedLuminousFlux").node())
        rated_ = parse_number(trim(rated.child_value())).value_or(0);
    }
    if (photometries.size() != 1)
      fail(definitions_.child("Emitters"),
           fmt::format("the emitters refer to {} photometries", photometries.size()),
           "one; of several the parts' places are not known");
    const pugi::xml_node photometry =
        with_id("Photometries", "Photometry", *photometries.begin(), definitions_);
    const pugi::xml_node reference = photometry.child("PhotometryFileReference");
    if (!reference) fail(photometry, "names no photometric file");
    return with_id("Files", "File", reference.attribute("fileId").value(), reference);
  }

  ZipFile zip_;
  std::string text_;
  pugi::xml_document document_;
  pugi::xml_node definitions_;
  std::vector<std::string> notes_;
  double rated_ = 0;
};

}  // namespace

Photometry read_gldf(const std::filesystem::path& path) {
  return Reader(path).run();
}

}  // namespace sconce
