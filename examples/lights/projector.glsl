// SPDX-License-Identifier: Apache-2.0
// A slide projector: lamp_intensity candela along its axis; a screen across the axis is lit evenly but for the slide.

uniform sampler2D slide;    // white where none is given
uniform float fov = 40.0;   // of the picture, vertical, degrees
uniform float aspect = 1.0;  // width / height

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P, p = -to * lamp_frame;  // right, up, backwards
  float depth = -p.z;
  vec2 at = p.xy / (depth * tan(0.5 * radians(fov)) * vec2(aspect, 1.0));
  if (depth <= 0.0 || any(greaterThan(abs(at), vec2(1.0)))) return vec3(0.0);
  // Candela that light a plane across the axis evenly: I / cos^3; with the inverse square, cos and 1/d2 are 1/depth2.
  vec3 color = texture(slide, vec2(0.5, 0.5) + vec2(0.5, -0.5) * at).rgb;
  return lamp_intensity * color * (max(dot(N, to), 0.0) / (depth * depth * depth));
}
