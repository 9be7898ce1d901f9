// SPDX-License-Identifier: Apache-2.0
#include "import/l3d_structure.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <pugixml.hpp>

#include "core/error.h"
#include "core/text.h"
#include "photometry/lines.h"

namespace sconce {

namespace {

constexpr int kMostDeep = 64;  // joints in joints
constexpr std::pair<const char*, double> kUnits[] = {
    {"m", 1}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"yard", 0.9144}, {"foot", 0.3048}, {"inch", 0.0254}};

class Reader {
 public:
  Reader(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  L3dStructure run() {
    const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
    if (!parsed) throw Error(place(parsed.offset), std::string("is no valid XML: ") + parsed.description());
    const pugi::xml_node root = document_.child("Luminaire");
    if (!root) throw Error(place(0), "is no L3D structure", "an element Luminaire");
    for (const pugi::xml_node& node : root.child("GeometryDefinitions").children("GeometryFileDefinition"))
      define(node);
    const pugi::xml_node structure = root.child("Structure");
    if (!structure.child("Geometry")) fail(root, "has no Structure with a Geometry");
    for (const pugi::xml_node& node : structure.children("Geometry")) geometry(node, Mat4(1), 0);
    return std::move(out_);
  }

 private:
  std::string place(std::ptrdiff_t offset) const {
    return fmt::format("{}:{}", where_, line_of(text_, offset));
  }
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what,
                         const std::string& allowed = {}) const {
    throw Error(place(node.offset_debug()), what, allowed);
  }

  std::string name(const pugi::xml_node& node, const char* attribute) const {
    const std::string out = node.attribute(attribute).value();
    if (out.empty()) fail(node, fmt::format("{} has no {}", node.name(), attribute));
    return out;
  }
  double number(const pugi::xml_node& node, const char* attribute) const {
    const auto v = parse_number(trim(node.attribute(attribute).value()));
    if (!v) fail(node, fmt::format("{} of {} is no number", attribute, node.name()));
    return *v;
  }
  int index(const pugi::xml_node& node, const char* attribute) const {
    const double v = number(node, attribute);
    if (!(v >= 0 && v < 1e9 && v == std::floor(v)))
      fail(node, fmt::format("{} of {} is no whole number from 0 on", attribute, node.name()));
    return static_cast<int>(v);
  }
  Vec3 vector(const pugi::xml_node& node) const {
    return {static_cast<float>(number(node, "x")), static_cast<float>(number(node, "y")),
            static_cast<float>(number(node, "z"))};
  }

  void define(const pugi::xml_node& node) {
    const std::string units = name(node, "units");
    L3dGeometry geometry{name(node, "filename"), 0};
    for (const auto& [unit, metres] : kUnits)
      if (units == unit) geometry.unit = metres;
    if (!(geometry.unit > 0)) fail(node, "has the unit '" + units + "'", "m, dm, cm, mm, yard, foot, inch");
    out_.geometries[name(node, "id")] = std::move(geometry);
  }

  /// About the axes that turn along: first z, then x, then y.
  static Mat4 turned(const Vec3& degrees) {
    const Vec3 a = degrees * (kPi / 180);
    Mat4 out = glm::rotate(Mat4(1), a.z, Vec3(0, 0, 1));
    out = glm::rotate(out, a.x, Vec3(1, 0, 0));
    return glm::rotate(out, a.y, Vec3(0, 1, 0));
  }
  Mat4 placed(const pugi::xml_node& node) const {
    Mat4 out(1);
    if (const pugi::xml_node at = node.child("Position")) out = glm::translate(out, vector(at));
    if (const pugi::xml_node turn = node.child("Rotation")) out *= turned(vector(turn));
    return out;
  }

  void geometry(const pugi::xml_node& node, const Mat4& parent, int depth) {
    if (depth > kMostDeep) fail(node, fmt::format("lies more than {} joints deep", kMostDeep));
    L3dPart part;
    part.name = name(node, "partName");
    part.transform = parent * placed(node);
    const pugi::xml_node reference = node.child("GeometryReference");
    if (!reference) fail(node, "has no GeometryReference");
    part.geometry = name(reference, "geometryId");
    if (!out_.geometries.contains(part.geometry))
      fail(reference, "refers to the geometry '" + part.geometry + "', which is not there");
    for (const pugi::xml_node& leo : node.child("LightEmittingObjects").children("LightEmittingObject"))
      emitter(leo, part.transform);
    for (const pugi::xml_node& les : node.child("LightEmittingSurfaces").children("LightEmittingSurface"))
      part.surfaces.push_back(surface(les));
    const Mat4 here = part.transform;
    out_.parts.push_back(std::move(part));
    for (const pugi::xml_node& joint : node.child("Joints").children("Joint")) {
      Mat4 hinge = here * placed(joint);
      if (const pugi::xml_node turn = joint.child("DefaultRotation")) hinge *= turned(vector(turn));
      for (const pugi::xml_node& next : joint.child("Geometries").children("Geometry"))
        geometry(next, hinge, depth + 1);
    }
  }

  void emitter(const pugi::xml_node& node, const Mat4& parent) {
    L3dEmitter out;
    out.name = name(node, "partName");
    out.transform = parent * placed(node);
    if (const pugi::xml_node circle = node.child("Circle")) {
      out.round = true;
      out.size = Vec2(static_cast<float>(number(circle, "diameter")));
    } else if (const pugi::xml_node rectangle = node.child("Rectangle")) {
      out.size = {static_cast<float>(number(rectangle, "sizeX")),
                  static_cast<float>(number(rectangle, "sizeY"))};
    } else {
      fail(node, "has no shape", "Rectangle, Circle");
    }
    if (!(out.size.x > 0 && out.size.y > 0)) fail(node, "has a size that is not positive");
    out_.emitters.push_back(std::move(out));
  }

  L3dSurface surface(const pugi::xml_node& node) const {
    L3dSurface out;
    out.name = name(node, "partName");
    const pugi::xml_node reference = node.child("LightEmittingObjectReference");
    if (!reference) fail(node, "has no LightEmittingObjectReference");
    out.emitter = name(reference, "lightEmittingPartName");
    if (reference.attribute("intensity")) out.intensity = number(reference, "intensity");
    if (!(out.intensity >= 0)) fail(reference, "has a negative intensity");
    for (const pugi::xml_node& faces : node.child("FaceAssignments").children()) {
      const bool range = std::string_view(faces.name()) == "FaceRangeAssignment";
      if (!range && std::string_view(faces.name()) != "FaceAssignment") continue;
      const int group = faces.attribute("groupIndex") ? index(faces, "groupIndex") : 0,
                first = index(faces, range ? "faceIndexBegin" : "faceIndex"),
                last = range ? index(faces, "faceIndexEnd") : first;
      if (last < first) fail(faces, fmt::format("faces {} to {} run backwards", first, last));
      out.faces.push_back({group, {first, last}});
    }
    if (out.faces.empty()) fail(node, "names no face", "FaceAssignment, FaceRangeAssignment");
    return out;
  }

  std::string_view text_;
  std::string where_;
  pugi::xml_document document_;
  L3dStructure out_;
};

}  // namespace

L3dStructure parse_l3d(std::string_view xml, const std::string& where) {
  return Reader(xml, where).run();
}

}  // namespace sconce
