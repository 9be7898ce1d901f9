// SPDX-License-Identifier: Apache-2.0
#include "import/obj_parts.h"

#include <algorithm>

#include "import/triangulate.h"

namespace sconce {

std::size_t ObjParts::Hash::operator()(const Vertex& v) const {
  std::size_t h = 0;
  for (const float x : {v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z,
                        v.texcoord.x, v.texcoord.y})
    h = (h ^ std::hash<float>()(x)) * 0x9e3779b97f4a7c15u;
  return h;
}

uint32_t ObjParts::vertex(Growing& to, const ObjCorner& corner) {
  Vertex v{positions[static_cast<std::size_t>(corner.position)], Vec3(0), Vec2(0)};
  if (with_normals_) v.normal = normals[static_cast<std::size_t>(corner.normal)];
  if (with_texcoords_) v.texcoord = texcoords[static_cast<std::size_t>(corner.texcoord)];
  Mesh& mesh = to.part.mesh;
  const auto [at, is_new] = to.known.try_emplace(v, static_cast<uint32_t>(mesh.positions.size()));
  if (is_new) {
    mesh.positions.push_back(v.position);
    if (with_normals_) mesh.normals.push_back(v.normal);
    if (with_texcoords_) mesh.texcoords[0].push_back(v.texcoord);
  }
  return at->second;
}

void ObjParts::add_face(const std::vector<ObjCorner>& corners) {
  const auto all = [&](int64_t ObjCorner::*what) {
    return std::all_of(corners.begin(), corners.end(), [&](const ObjCorner& c) { return c.*what >= 0; });
  };
  const bool with_texcoords = all(&ObjCorner::texcoord), with_normals = all(&ObjCorner::normal);
  if (current_ == nullptr || with_texcoords != with_texcoords_ || with_normals != with_normals_) {
    with_texcoords_ = with_texcoords, with_normals_ = with_normals;
    const auto [at, is_new] =
        index_.try_emplace({name_, material_, with_texcoords, with_normals}, parts_.size());
    if (is_new) {
      parts_.push_back(std::make_unique<Growing>(Growing{{name_, material_, {}}, {}}));
      if (with_texcoords) parts_.back()->part.mesh.texcoords.emplace_back();
    }
    current_ = parts_[at->second].get();
  }
  std::vector<uint32_t> vertices;
  std::vector<Vec3> places;
  for (const ObjCorner& corner : corners) {
    vertices.push_back(vertex(*current_, corner));
    places.push_back(positions[static_cast<std::size_t>(corner.position)]);
  }
  for (const auto& [a, b, c] : triangulate(places))
    current_->part.mesh.triangles.push_back({{vertices[a], vertices[b], vertices[c]}});
}

std::vector<ObjParts::Part> ObjParts::take() {
  std::vector<Part> out;
  for (const auto& growing : parts_) out.push_back(std::move(growing->part));
  parts_.clear(), index_.clear(), current_ = nullptr;
  return out;
}

}  // namespace sconce
