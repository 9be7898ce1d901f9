// SPDX-License-Identifier: Apache-2.0
// A stage lamp with the controls of cinematic lighting (R. Barzel, "Lighting Controls for Computer Cinematography",
// 1997): a soft shape between rectangle and ellipse, four barn doors, near and far ends, falloff of one's choice and a
// cookie. With all its controls left alone it is a point lamp that shines forwards.

uniform float width = 0.0, height = 0.0;  // half angles of the shape, degrees; 0: no shape
uniform float roundness = 1.0;            // of the shape: 0 a rectangle, 1 an ellipse
uniform float edge = 5.0;                 // of shape and barn doors, degrees, outwards

uniform float barn_left = 90.0, barn_right = 90.0, barn_top = 90.0, barn_bottom = 90.0;  // degrees from the axis; 90: open

uniform float near_start = 0.0, near_end = 0.0;  // m: dark before the one, full after the other
uniform float far_start = 0.0, far_end = 0.0;    // m: full up to the one, dark beyond the other; 0: no end

uniform float falloff = 2.0;           // power of the distance; 2 is light, 0 none at all
uniform float falloff_distance = 1.0;  // m, where any falloff gives what the square does

uniform sampler2D cookie;        // over the shape; white where none is given
uniform float cookie_turn = 0.0;  // degrees

// 1 inside `full`, 0 beyond full + edge; degrees.
float door(float angle, float full) {
  return 1.0 - smoothstep(full, full + max(edge, 1e-3), angle);
}

// How far out `at` lies: 1 on the outline of half sides `side`.
float outline(vec2 at, vec2 side) {
  vec2 q = abs(at) / side;
  float power = 2.0 / max(roundness, 0.05);
  float m = max(max(q.x, q.y), 1e-6);
  return m * pow(pow(q.x / m, power) + pow(q.y / m, power), 1.0 / power);
}

vec3 light(vec3 P, vec3 N) {
  vec3 to = lamp_position - P, p = -to * lamp_frame;  // right, up, backwards
  float d = max(length(to), 1e-6), depth = -p.z;
  if (depth <= 0.0) return vec3(0.0);
  vec2 slope = p.xy / depth, degree = degrees(atan(slope));

  float shape = 1.0;
  vec2 side = vec2(1.0);
  if (width > 0.0 && height > 0.0) {
    side = tan(radians(vec2(width, height)));
    float softness = max(tan(radians(width + edge)) / side.x - 1.0, 1e-4);
    shape = 1.0 - smoothstep(1.0, 1.0 + softness, outline(slope, side));
  }
  shape *= door(-degree.x, barn_left) * door(degree.x, barn_right) * door(degree.y, barn_top) *
           door(-degree.y, barn_bottom);
  if (near_end > 0.0) shape *= smoothstep(min(near_start, near_end - 1e-4), near_end, d);
  if (far_end > 0.0) shape *= 1.0 - smoothstep(min(far_start, far_end - 1e-4), far_end, d);
  if (shape <= 0.0) return vec3(0.0);

  float c = cos(radians(cookie_turn)), s = sin(radians(cookie_turn));
  vec2 at = mat2(c, -s, s, c) * (slope / side);
  vec3 color = texture(cookie, vec2(0.5, 0.5) + vec2(0.5, -0.5) * at).rgb;
  float strength = pow(falloff_distance / d, falloff) / (falloff_distance * falloff_distance);
  return lamp_intensity * color * (shape * strength * max(dot(N, to), 0.0) / d);
}
