// SPDX-License-Identifier: Apache-2.0
#include "import/assimp_scene.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "import/assimp_materials.h"

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

void read_node(const aiNode& node, const Mat4& parent, const std::vector<Id<Mesh>>& meshes, Scene& scene,
               AssimpNodes& nodes) {
  const Mat4 transform = parent * matrix(node.mTransformation);
  nodes.emplace(node.mName.C_Str(), transform);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    Instance instance;
    instance.name = node.mName.C_Str();
    instance.mesh = meshes.at(node.mMeshes[i]);
    instance.transform = transform;
    if (!scene[instance.mesh].triangles.empty()) scene.instances.push_back(std::move(instance));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    read_node(*node.mChildren[i], transform, meshes, scene, nodes);
}

}  // namespace

const aiScene& run_assimp(Assimp::Importer& importer, const std::filesystem::path& path,
                          std::string_view format, unsigned more) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);  // what has no meshes gets none
  const aiScene* read =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                           aiProcess_SortByPType | aiProcess_FlipUVs | more);
  if (read == nullptr || read->mRootNode == nullptr)
    throw Error(path.string(), "cannot be read as " + std::string(format) + ": " + importer.GetErrorString());
  return *read;
}

Scene read_assimp(const aiScene& read, const std::filesystem::path& file, const Mat4& root,
                  const Progress& progress) {
  Scene scene;
  scene.name = file.stem().string();
  PlainMaterials materials(
      file, [&](const std::string& name) { return assimp_picture(file, read, name); }, scene, progress);
  for (unsigned i = 0; i < read.mNumMaterials; ++i) materials.add(plain_material(*read.mMaterials[i]));
  materials.drop_unused_textures();
  std::vector<Id<Mesh>> meshes;
  for (unsigned i = 0; i < read.mNumMeshes; ++i) {
    progress.check();
    progress.at("meshes", i, read.mNumMeshes);
    meshes.emplace_back(scene.meshes.size());
    scene.meshes.push_back(read_mesh(*read.mMeshes[i], scene.materials.size(), file.string()));
  }
  AssimpNodes nodes;
  read_node(*read.mRootNode, root, meshes, scene, nodes);
  read_assimp_lights(read, file, nodes, scene, progress);
  read_assimp_cameras(read, nodes, scene);
  return scene;
}

}  // namespace sconce
