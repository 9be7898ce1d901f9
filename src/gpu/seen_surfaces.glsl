// SPDX-License-Identifier: Apache-2.0
// What one pass of a picture shows (SeenSurfaces), a thread for each pixel, and the picture itself. After
// gpu/octahedral.glsl.

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D sconce_depth;
uniform usampler2D sconce_surfaces, sconce_materials, sconce_mapped;  // gpu/surface.glsl
uniform int sconce_normal_maps;  // seen by: 0 nothing, 1 what is mirrored, 2 diffuse light, too
uniform vec3 sconce_seen_from;
uniform mat3 sconce_seen_plane;  // Lens::plane
uniform vec2 sconce_seen_shift;  // of the picture below its sampling points, in pixels
layout(rgba32f, binding = 0) uniform image2D sconce_seen;

struct SconceSurface {
  bool lit, there;                       // something; that is not black
  vec3 place, face, base, to_eye;        // base: colour, of metals, too
  vec3 normal, mapped;                   // of what is diffuse; of what is mirrored
  float bend;                            // between the interpolated normal and the face's
  float metallic, roughness;
};

SconceSurface sconce_surface(ivec2 at) {
  SconceSurface s;
  s.lit = s.there = false;
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, imageSize(sconce_seen)))) return s;
  if (texelFetch(sconce_depth, at, 0).r == 0.0) return s;
  uvec4 surface = texelFetch(sconce_surfaces, at, 0);
  uvec2 material = texelFetch(sconce_materials, at, 0).rg;
  vec2 more = unpackUnorm2x16(material.x);
  s.roughness = uintBitsToFloat(material.y);
  if (s.roughness < 0.0) return s;
  vec3 ray = sconce_seen_plane * vec3(vec2(at) + 0.5 - sconce_seen_shift, 1.0);
  s.lit = true;
  s.place = sconce_seen_from + uintBitsToFloat(surface.x) * ray;
  s.to_eye = -normalize(ray);
  s.normal = s.mapped = sconce_octahedral(surface.y);
  s.face = sconce_octahedral(surface.z);
  s.bend = length(s.normal - s.face);
  if (sconce_normal_maps > 0) s.mapped = sconce_octahedral(texelFetch(sconce_mapped, at, 0).r);
  if (sconce_normal_maps > 1) s.normal = s.mapped;
  s.base = vec3(unpackUnorm2x16(surface.w), more.x);
  s.metallic = more.y;
  s.there = s.base != vec3(0.0);
  return s;
}

// light: radiance towards the eye, cd/m2
void sconce_add_radiance(ivec2 at, vec3 light) {
  imageStore(sconce_seen, at, imageLoad(sconce_seen, at) + vec4(light, 0.0));
}

// e: illuminance, lux; metals are as if matt
void sconce_add(ivec2 at, SconceSurface surface, vec3 e) {
  sconce_add_radiance(at, surface.base * 0.318309886 * e);
}
