// SPDX-License-Identifier: Apache-2.0
#version 450 core
// Twin of light/sky.cpp: a sky of a lat-long image, row 0 up, the centre column towards -z.

uniform mat3 plane;     // Lens::plane
uniform vec2 shift;     // of the picture below its sampling points, in pixels
uniform mat3 to_local;  // from the world to the sky's frame
uniform vec3 scale, weight;
uniform sampler2D image;

out vec4 seen;

void main() {
  const float pi = 3.14159265359;
  vec3 d = to_local * normalize(plane * vec3(gl_FragCoord.xy - shift, 1.0));
  vec2 place = vec2(0.5 + atan(d.x, -d.z) / (2.0 * pi), acos(clamp(d.y, -1.0, 1.0)) / pi);
  ivec2 size = textureSize(image, 0);
  vec3 sky = scale * texelFetch(image, clamp(ivec2(place * vec2(size)), ivec2(0), size - 1), 0).rgb;
  seen = vec4(weight * sky, any(notEqual(sky, vec3(0.0))) ? 1.0 : 0.0);
}
