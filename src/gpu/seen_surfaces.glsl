// SPDX-License-Identifier: Apache-2.0
// What one pass of a picture shows (SeenSurfaces), a thread for each pixel, and the picture itself.

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D sconce_depth, sconce_place, sconce_normals, sconce_albedo;
layout(rgba32f, binding = 0) uniform image2D sconce_seen;

struct SconceSurface {
  bool there;
  vec3 place, normal, face, albedo;
};

SconceSurface sconce_surface(ivec2 at) {
  const SconceSurface nothing = SconceSurface(false, vec3(0), vec3(0), vec3(0), vec3(0));
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, imageSize(sconce_seen)))) return nothing;
  if (texelFetch(sconce_depth, at, 0).r == 0.0) return nothing;
  vec3 albedo = texelFetch(sconce_albedo, at, 0).rgb;
  if (albedo == vec3(0.0)) return nothing;
  vec4 normals = texelFetch(sconce_normals, at, 0);
  return SconceSurface(true, texelFetch(sconce_place, at, 0).xyz, sconce_octahedral(normals.xy),
                       sconce_octahedral(normals.zw), albedo);
}

// e: illuminance, lux
void sconce_add(ivec2 at, SconceSurface surface, vec3 e) {
  imageStore(sconce_seen, at, imageLoad(sconce_seen, at) + vec4(surface.albedo * 0.318309886 * e, 0.0));
}
