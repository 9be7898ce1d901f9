// SPDX-License-Identifier: Apache-2.0
// A light field added to a picture, summed over passes in 8 bits with a signed shared exponent (the paper's
// section 4.2), after gpu/near_seen.glsl and encode/srgbe8.glsl.

layout(rgba8, binding = 1) uniform image2D near_kept;
uniform bool near_begin, near_last;  // of the lamp's passes

// Twin of encode_srgbe8().
vec4 near_encode(vec3 v) {
  float most = max(max(abs(v.r), abs(v.g)), abs(v.b));
  int exponent = 0;
  if (frexp(most, exponent) == 0.5) --exponent;
  if (most == 0.0 || exponent < -126) return vec4(128.0, 128.0, 128.0, 0.0) / 255.0;
  return vec4(128.0 + clamp(round(ldexp(v, ivec3(-exponent)) * 127.0), -127.0, 127.0), float(exponent + 128)) / 255.0;
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  SconceSurface s = sconce_surface(at);
  if (!s.lit) return;
  vec3 light = near_seen(s);
  if (!near_begin) light += decode_srgbe8(imageLoad(near_kept, at), vec4(1.0)).rgb;
  vec4 code = near_encode(light);
  if (near_last) sconce_add_radiance(at, decode_srgbe8(code, vec4(1.0)).rgb);
  else imageStore(near_kept, at, code);
}
