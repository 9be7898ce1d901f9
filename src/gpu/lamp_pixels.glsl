// SPDX-License-Identifier: Apache-2.0
// A lamp on what a picture shows, after gpu/seen_surfaces.glsl.

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  SconceSurface s = sconce_surface(at);
  if (!s.there) return;
  uint number = uint(at.y * imageSize(sconce_seen).x + at.x);
  sconce_add(at, s, sconce_arriving(s.place, s.normal, s.face, number));
}
