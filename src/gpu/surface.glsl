// SPDX-License-Identifier: Apache-2.0
// Twin of View::look and shade(): what is seen of a surface. The main() of a fragment shader, after a light
// source's vec3 illuminance(vec2 uv, int page, vec3 offset) in lux.

uniform sampler2D base_map, metallic_map, emission_map, normal_map;
uniform vec3 base_color, emission, weight;
uniform float alpha, alpha_cutoff, metallic, roughness;
uniform bool double_sided, has_normal_map, blends;
uniform float transmission, screen;  // of the sample: shifts the screen that panes are drawn by
uniform float normal_scale;
uniform int look;        // gpu/view.h
uniform vec2 page_size;  // texels of a lightmap page

in vec2 base_uv, metallic_uv, emission_uv, normal_uv;
centroid in vec2 front_uv, back_uv;  // with several samples per pixel, never beyond a chart
in vec3 normal;
in vec4 tangent;
flat in vec3 face_normal;
flat in int front_page, back_page;

layout(location = 0) out vec4 seen;  // cd/m2; 1 where it is an emitter
#ifdef SEEN_SURFACES  // for gpu/seen_surfaces.h
uniform vec3 eye;
uniform mat3 plane;  // Lens::plane
uniform vec2 shift;  // of the picture below its sampling points, in pixels
in vec3 place;
layout(location = 1) out uvec4 seen_surface;   // depth, m; normals towards the camera: interpolated, the face's; base colour
layout(location = 2) out uvec2 seen_material;  // blue and metallic; roughness, -1 on backs that are black
layout(location = 3) out uint seen_mapped;     // the normal map's normal, where it is kept
#endif

// World::normal
vec3 front_normal() {
  vec3 n = normalize(normal);
  return dot(n, face_normal) < 0.0 ? -n : n;
}

// Twin of scene/normal_map.cpp.
vec3 normal_offset() {
  if (!has_normal_map) return vec3(0.0);
  vec3 n = front_normal();
  vec3 along = tangent.xyz - n * dot(n, tangent.xyz);
  if (along == vec3(0.0)) return vec3(0.0);
  vec3 t = normalize(along), up = cross(n, t) * (tangent.w < 0.0 ? -1.0 : 1.0);
  vec3 at = 2.0 * texture(normal_map, normal_uv).rgb - 1.0;
  vec3 mapped = normal_scale * (at.x * t + at.y * up) + at.z * n;
  return mapped == vec3(0.0) ? vec3(0.0) : normalize(mapped) - n;
}

// Squares of four texels, in a colour of their page's own.
vec3 charts(vec2 uv, int page) {
  if (page < 0) return vec3(0.6, 0.02, 0.02);
  vec2 square = floor(uv * page_size / 4.0);
  vec3 hue = 0.5 + 0.5 * cos(6.2831853 * (0.618034 * float(page) + vec3(0.58, 0.25, 0.92)));
  return hue * (mod(square.x + square.y, 2.0) < 0.5 ? 0.25 : 0.6);
}

// Panes are a screen of pixels, as dense as they are opaque, and have no colour for what is behind. Different
// in every sample and at every depth, so that samples and panes in a row add up.
bool passes(float base_alpha) {
  float clear = blends ? 1.0 - base_alpha : 0.0;
  float share = clear + (1.0 - clear) * transmission;
  vec2 at = gl_FragCoord.xy + 1e4 * fract(screen + 1e3 * gl_FragCoord.z);
  return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715)))) < share;
}

#ifdef PANES  // who draws sees what is behind, and mixes: clear + (1 - clear) * (tint * behind + seen)
float pane_clear;
vec3 pane_tint;
#endif

void main() {
  vec4 base = texture(base_map, base_uv) * vec4(base_color, alpha);
#ifdef PANES
  if (base.a < alpha_cutoff) discard;
  pane_clear = blends ? 1.0 - base.a : 0.0;
  pane_tint = transmission * base.rgb;
#else
  if (base.a < alpha_cutoff || passes(base.a)) discard;
#endif
  vec2 rough_metal = vec2(roughness, metallic) * texture(metallic_map, metallic_uv).gb;
  vec3 albedo = base.rgb;  // metals are as if matt
  int page = gl_FrontFacing ? front_page : back_page;
  vec3 offset = gl_FrontFacing ? normal_offset() : -normal_offset();
  vec3 light = page < 0 ? vec3(0.0) : illuminance(gl_FrontFacing ? front_uv : back_uv, page, offset);
  vec3 shines = emission * texture(emission_map, emission_uv).rgb;
  if (!gl_FrontFacing && !double_sided) shines = vec3(0.0);
  if (look != 0) {
    vec3 n = (gl_FrontFacing ? front_normal() : -front_normal()) + offset;
    seen.rgb = look == 1   ? light
               : look == 2 ? albedo * (1.0 - rough_metal.y)
               : look == 3 ? 0.5 + 0.5 * n
                           : charts(gl_FrontFacing ? front_uv : back_uv, page);
    seen.a = 0.0;
    return;
  }
#ifdef PANES
  albedo *= 1.0 - transmission;
#endif
  seen = vec4(albedo * light * 0.318309886 + weight * shines, any(notEqual(shines, vec3(0.0))) ? 1.0 : 0.0);
#ifdef SEEN_SURFACES
  bool lit = gl_FrontFacing || double_sided;
  float side = gl_FrontFacing ? 1.0 : -1.0;
  // Rasterisation snaps corners to 1/256 of a pixel; the ray through the sampling point meets the face just here.
  vec3 ray = plane * vec3(gl_FragCoord.xy - shift, 1.0);
  float depth = dot(place - eye, face_normal) / dot(ray, face_normal);
  seen_surface = uvec4(floatBitsToUint(depth), packSnorm2x16(sconce_to_octahedral(side * front_normal())),
                       packSnorm2x16(sconce_to_octahedral(side * face_normal)), packUnorm2x16(base.rg));
  seen_mapped = packSnorm2x16(sconce_to_octahedral(side * front_normal() + offset));
  seen_material = uvec2(packUnorm2x16(vec2(base.b, rough_metal.y)), floatBitsToUint(lit ? rough_metal.x : -1.0));
#endif
}
