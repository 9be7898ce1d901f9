// SPDX-License-Identifier: Apache-2.0
// A light field added to a picture, after gpu/near_seen.glsl.

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  SconceSurface s = sconce_surface(at);
  if (s.lit) sconce_add_radiance(at, near_seen(s));
}
