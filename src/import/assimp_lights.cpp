// SPDX-License-Identifier: Apache-2.0
#include <assimp/scene.h>

#include <cmath>

#include "core/text.h"
#include "import/assimp_scene.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

constexpr float kLumensPerWatt = 683;
constexpr float kNoAspect = 16.0f / 9;

Vec3 vec(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// A frame of a node's that looks along a direction of the node's.
Mat4 frame_in(const Mat4& node, const aiVector3D& position, const aiVector3D& direction,
              const aiVector3D& up) {
  const glm::mat3 turn(node);
  const Vec3 world_up = normalize_or(turn * vec(up), Vec3(0, 1, 0));
  return looking(Vec3(node * glm::vec4(vec(position), 1)), turn * vec(direction), world_up);
}

const Mat4& find(const AssimpNodes& nodes, const aiString& name) {
  static const Mat4 kRoot(1);
  const auto found = nodes.find(name.C_Str());
  return found != nodes.end() ? found->second : kRoot;
}

/// Whether the file lets it fade otherwise than by the square of the distance. 3DS does not say.
bool fades_otherwise(const aiLight& l, const std::filesystem::path& file) {
  if (l.mType == aiLightSource_DIRECTIONAL || lower(file.extension().string()) == ".3ds") return false;
  return !(l.mAttenuationQuadratic > 0) || l.mAttenuationLinear > 0;
}

/// Full cone angles to half ones.
SpotLight spot_of(const aiLight& l) {
  SpotLight spot;
  spot.outer = l.mAngleOuterCone > 0 ? std::clamp(l.mAngleOuterCone / 2, 0.01f, kPi / 2) : kPi / 4;
  spot.inner = std::clamp(l.mAngleInnerCone / 2, 0.0f, spot.outer);
  return spot;
}

}  // namespace

void read_assimp_lights(const aiScene& read, const std::filesystem::path& file, const AssimpNodes& nodes,
                        Scene& scene, const Progress& progress) {
  bool without_units = false;
  std::vector<std::string> otherwise;
  for (unsigned i = 0; i < read.mNumLights; ++i) {
    const aiLight& l = *read.mLights[i];
    const std::string name = l.mName.C_Str();
    Light out;
    out.name = name;
    out.frame = frame_in(find(nodes, l.mName), l.mPosition, l.mDirection, l.mUp);
    const Rgb watts(l.mColorDiffuse.r, l.mColorDiffuse.g, l.mColorDiffuse.b);
    out.intensity = watts * (kLumensPerWatt / (4 * kPi));
    switch (l.mType) {
      case aiLightSource_DIRECTIONAL:
        out.shape = SunLight{};
        out.intensity = watts * kLumensPerWatt;
        break;
      case aiLightSource_SPOT:
        out.shape = spot_of(l);
        break;
      case aiLightSource_AREA:
      case aiLightSource_UNDEFINED:  // area and volume lamps of FBX
        progress.warn(file.string() + ": area lamp '" + name +
                      "' has lost its size and is taken as a point; a mesh that shines has one");
        [[fallthrough]];
      case aiLightSource_POINT:
        out.shape = PointLight{};
        break;
      default:
        progress.warn(file.string() + ": lamp '" + name + "' is ambient light; it is left out");
        continue;
    }
    without_units = true;
    if (fades_otherwise(l, file)) otherwise.push_back("'" + name + "'");
    scene.lights.push_back(std::move(out));
  }
  if (without_units)
    progress.warn(
        file.string() +
        ": its lamps have no photometric units; an intensity of 1 is taken as 683 lm (suns: 683 lx); "
        "give lumens in [[light]] where that is not meant");
  if (!otherwise.empty())
    progress.warn(file.string() + ": the decay of " + join(otherwise, ", ") +
                  " is not by the square of the distance; here all light fades so");
}

void read_assimp_cameras(const aiScene& read, const AssimpNodes& nodes, Scene& scene) {
  for (unsigned i = 0; i < read.mNumCameras; ++i) {
    const aiCamera& c = *read.mCameras[i];
    Camera out;
    out.name = c.mName.C_Str();
    out.frame = frame_in(find(nodes, c.mName), c.mPosition, c.mLookAt, c.mUp);
    out.aspect = c.mAspect > 0 ? c.mAspect : kNoAspect;
    if (c.mHorizontalFOV > 0 && c.mHorizontalFOV < kPi)
      out.yfov = 2 * std::atan(std::tan(c.mHorizontalFOV / 2) / out.aspect);
    scene.cameras.push_back(std::move(out));
  }
}

}  // namespace sconce
