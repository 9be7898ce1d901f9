// SPDX-License-Identifier: Apache-2.0
// OBJ + MTL through assimp.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "core/text.h"
#include "import/import.h"
#include "import/mtl_filter.h"
#include "import/obj_materials.h"

namespace sconce {

namespace {

Mat4 matrix(const aiMatrix4x4& m) {
  Mat4 out;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      out[static_cast<int>(column)][static_cast<int>(row)] = m[row][column];
  return out;
}

Mesh read_mesh(const aiMesh& m, std::size_t materials, const std::string& where) {
  Mesh out;
  out.name = m.mName.C_Str();
  if (m.mMaterialIndex >= materials)
    throw Error(where, "mesh '" + out.name + "' has a material that does not exist");
  out.material = Id<Material>(m.mMaterialIndex);
  for (unsigned i = 0; i < m.mNumVertices; ++i) {
    out.positions.emplace_back(m.mVertices[i].x, m.mVertices[i].y, m.mVertices[i].z);
    if (m.HasNormals()) out.normals.emplace_back(m.mNormals[i].x, m.mNormals[i].y, m.mNormals[i].z);
  }
  for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS && m.HasTextureCoords(set); ++set) {
    auto& uv = out.texcoords.emplace_back();
    for (unsigned i = 0; i < m.mNumVertices; ++i)
      uv.emplace_back(m.mTextureCoords[set][i].x, m.mTextureCoords[set][i].y);
  }
  for (unsigned i = 0; i < m.mNumFaces; ++i) {
    const aiFace& face = m.mFaces[i];
    if (face.mNumIndices != 3) continue;
    Triangle t;
    for (unsigned c = 0; c < 3; ++c) {
      if (face.mIndices[c] >= m.mNumVertices)
        throw Error(where, "mesh '" + out.name + "' has a vertex index out of range");
      t.v[c] = face.mIndices[c];
    }
    out.triangles.push_back(t);
  }
  return out;
}

void read_node(const aiNode& node, const Mat4& parent, const std::vector<Id<Mesh>>& meshes, Scene& scene) {
  const Mat4 transform = parent * matrix(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    Instance instance;
    instance.name = node.mName.C_Str();
    instance.mesh = meshes.at(node.mMeshes[i]);
    instance.transform = transform;
    if (!scene[instance.mesh].triangles.empty()) scene.instances.push_back(std::move(instance));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) read_node(*node.mChildren[i], transform, meshes, scene);
}

}  // namespace

Scene import_obj(const std::filesystem::path& path, const Progress& progress) {
  if (lower(path.extension().string()) != ".obj") throw NotMyFormat(path.string(), "is no OBJ file");
  for (const std::filesystem::path& mtl : mtl_files(path)) {
    std::error_code ec;
    if (!std::filesystem::exists(mtl, ec))
      progress.warn(path.string() + ": material file " + mtl.string() + " is missing; grey is used");
  }
  Assimp::Importer importer;
  importer.SetIOHandler(new MtlFilter);  // the importer owns it
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* read =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                           aiProcess_SortByPType | aiProcess_FlipUVs);
  if (read == nullptr || read->mRootNode == nullptr)
    throw Error(path.string(), std::string("cannot be read as OBJ: ") + importer.GetErrorString());

  Scene scene;
  scene.name = path.stem().string();
  ObjMaterials materials(path, scene, progress);
  for (unsigned i = 0; i < read->mNumMaterials; ++i) materials.add(*read->mMaterials[i]);
  std::vector<Id<Mesh>> meshes;
  for (unsigned i = 0; i < read->mNumMeshes; ++i) {
    progress.check();
    progress.at("meshes", i, read->mNumMeshes);
    meshes.emplace_back(scene.meshes.size());
    scene.meshes.push_back(read_mesh(*read->mMeshes[i], scene.materials.size(), path.string()));
  }
  read_node(*read->mRootNode, Mat4(1.0f), meshes, scene);
  return scene;
}

}  // namespace sconce
