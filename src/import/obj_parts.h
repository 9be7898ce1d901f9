// SPDX-License-Identifier: Apache-2.0
// An OBJ's faces as meshes, one per name, material and kind of corner.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "scene/scene.h"

namespace sconce {

/// Where a corner's position, texture coordinate and normal stand, from 0; -1 where it has none.
struct ObjCorner {
  int64_t position = -1, texcoord = -1, normal = -1;
};

class ObjParts {
 public:
  struct Part {
    std::string name, material;  ///< "" = the file does not say
    Mesh mesh;                   ///< its material is still to be set
  };
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;

  /// What faces belong to from here on.
  void set_name(std::string_view name) { name_ = name, current_ = nullptr; }
  void set_material(std::string_view material) { material_ = material, current_ = nullptr; }
  /// A polygon. Corners that are alike become one vertex. @param corners  3 or more, with indices in range
  void add_face(const std::vector<ObjCorner>& corners);
  /// In the order of their first faces; this is used up.
  std::vector<Part> take();

 private:
  struct Vertex {
    Vec3 position, normal;
    Vec2 texcoord;
    bool operator==(const Vertex&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Vertex& v) const;
  };
  struct Growing {
    Part part;
    std::unordered_map<Vertex, uint32_t, Hash> known;
  };
  uint32_t vertex(Growing& to, const ObjCorner& corner);

  std::string name_, material_;
  std::map<std::tuple<std::string, std::string, bool, bool>, std::size_t> index_;
  std::vector<std::unique_ptr<Growing>> parts_;
  Growing* current_ = nullptr;
  bool with_texcoords_ = false, with_normals_ = false;  ///< current_'s
};

}  // namespace sconce
