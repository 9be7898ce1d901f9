// SPDX-License-Identifier: Apache-2.0
#include "scene/append.h"

#include <iterator>

namespace sconce {

namespace {

template <class T>
void shift(Id<T>& id, std::size_t by) {
  if (id.valid()) id = Id<T>(id.value + by);
}

template <class T>
void move_behind(std::vector<T>& all, std::vector<T>& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

void append(Scene& scene, Scene part) {
  for (Material& m : part.materials)
    for (TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture,
                            &m.normal_texture, &m.transmission_texture})
      shift(use->texture, scene.textures.size());
  for (Mesh& mesh : part.meshes) shift(mesh.material, scene.materials.size());
  for (Instance& instance : part.instances) shift(instance.mesh, scene.meshes.size());
  move_behind(scene.textures, part.textures);
  move_behind(scene.materials, part.materials);
  move_behind(scene.meshes, part.meshes);
  move_behind(scene.instances, part.instances);
}

}  // namespace sconce
