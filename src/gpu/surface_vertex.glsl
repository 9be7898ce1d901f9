// SPDX-License-Identifier: Apache-2.0
// Twin of scene/lens.h: depth runs from 1 at the near plane to 0 infinitely far, rows from the top.

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 base_place;
layout(location = 2) in vec2 metallic_place;
layout(location = 3) in vec2 emission_place;
layout(location = 4) in vec3 front_place;  // u, v, page
layout(location = 5) in vec3 back_place;
layout(location = 6) in vec4 normals;         // octahedral: the vertex's (the face's where it has none), the face's
layout(location = 7) in vec4 vertex_tangent;  // these where there are normal maps
layout(location = 8) in vec2 normal_place;

uniform vec3 eye;
uniform mat3 to_plane;  // inverse of Lens::plane
uniform vec2 shift;     // of the picture below its sampling points, in pixels
uniform vec2 size;      // of the picture
uniform float near;     // m

out vec2 base_uv, metallic_uv, emission_uv, normal_uv;
centroid out vec2 front_uv, back_uv;
out vec3 place, normal;
out vec4 tangent;
flat out vec3 face_normal;
flat out int front_page, back_page;

void main() {
  place = position;
  normal = sconce_octahedral(normals.xy);
  face_normal = sconce_octahedral(normals.zw);
  base_uv = base_place;
  metallic_uv = metallic_place;
  emission_uv = emission_place;
  normal_uv = normal_place;
  tangent = vertex_tangent;
  front_uv = front_place.xy;
  back_uv = back_place.xy;
  front_page = int(front_place.z);
  back_page = int(back_place.z);
  vec3 q = to_plane * (position - eye);  // pixel x depth, pixel y depth, depth
  gl_Position = vec4(2.0 * (q.xy + shift * q.z) / size - q.z, near, q.z);
}
