// SPDX-License-Identifier: Apache-2.0
// For tests only: a small package with known content.
#pragma once

#include <string>

#include "core/test_folder.h"
#include "package/package.h"

namespace sconce {

/// A quad of 2 x 2 m in z = `z`, facing +z (or -z when `flipped`), with texture coordinates in set 0 and
/// lightmap coordinates in set 1, both from (0, 0) top left to (1, 1) bottom right as seen from +z.
inline Mesh test_quad(const std::string& name, Id<Material> material, float z, bool flipped = false) {
  Mesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.positions = {{-1, 1, z}, {-1, -1, z}, {1, -1, z}, {1, 1, z}};
  mesh.normals.assign(4, Vec3(0, 0, flipped ? -1 : 1));
  mesh.texcoords.assign(2, {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  if (flipped) mesh.triangles = {{{2, 1, 0}}, {{3, 2, 0}}};
  return mesh;
}

/// One grey quad and the camera "main" 2 m in front of it, `groups` light groups, `pages` pages of width x
/// height texels. Texel (x, y) of group g on page p holds (1 + g) * (1 + p) + x / 8 + y / 16 lux in red,
/// twice that in green, thrice in blue; albedo is 0.5, weight 1.
inline PackageContents test_package(int groups, int pages, int width, int height) {
  PackageContents c;
  Manifest& m = c.manifest;
  m.generator = "sconce test";
  m.scene_name = "quad";
  m.scene_hash = "0";
  m.width = width;
  m.height = height;
  m.pages = pages;
  m.density = 4;
  m.lightmap_set = 1;
  m.options["seed"] = {"1", "default"};
  m.facts["solver"] = "none";
  c.scene.name = "quad";
  Material grey;
  grey.name = "grey";
  grey.base_color = Rgb(0.5f);
  c.scene.materials = {grey};
  c.scene.meshes = {test_quad("quad", Id<Material>(0), 0)};
  Instance instance;
  instance.name = "quad";
  instance.mesh = Id<Mesh>(0);
  c.scene.instances = {instance};
  m.instance_pages = {0};
  m.instance_twins = {-1};
  Camera camera;
  camera.name = "main";
  camera.frame[3] = {0, 0, 2, 1};
  camera.yfov = 0.5f;
  camera.aspect = 1;
  c.scene.cameras = {camera};
  for (int g = 0; g < groups; ++g) {
    GroupInfo group;
    group.name = std::string(1, static_cast<char>('a' + g));
    group.lumens = 100;
    group.lamps = {"lamp " + group.name};
    m.groups.push_back(group);
    c.scene.groups.push_back({group.name});
    c.encodings.push_back("f32");
    c.layers.emplace_back();
    for (int p = 0; p < pages; ++p) {
      Image image = Image::rgb(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const float e =
              static_cast<float>((1 + g) * (1 + p)) + static_cast<float>(x) / 8 + static_cast<float>(y) / 16;
          image.set_rgb(x, y, {e, 2 * e, 3 * e});
        }
      c.layers.back().push_back(image);
    }
  }
  for (int p = 0; p < pages; ++p) {
    Image receivers(width, height, {"albedo.R", "albedo.G", "albedo.B", "weight"});
    for (std::size_t i = 0; i < receivers.data.size(); ++i) receivers.data[i] = i % 4 == 3 ? 1.0f : 0.5f;
    c.receivers.push_back(receivers);
    if (groups == 0) continue;
    c.noise.emplace_back(width, height, std::vector<std::string>(static_cast<std::size_t>(groups), "n"));
    for (float& v : c.noise.back().data) v = 0.25f;
  }
  return c;
}

/// The same with the basis sh1: component k of g is -k times E, plus k.
inline PackageContents directional_test_package(int groups, int pages, int width, int height) {
  PackageContents c = test_package(groups, pages, width, height);
  c.manifest.basis = Basis::sh1;
  const auto flat = c.layers;
  for (int k = 1; k < 4; ++k)
    for (auto layer : flat) {
      for (Image& page : layer)
        for (float& v : page.data) v = static_cast<float>(k) * (1 - v);
      c.layers.push_back(std::move(layer));
    }
  return c;
}

}  // namespace sconce
