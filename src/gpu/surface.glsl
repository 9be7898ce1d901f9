// SPDX-License-Identifier: Apache-2.0
// Twin of View::look and shade(): what is seen of a surface. The main() of a fragment shader, after a light
// source's vec3 illuminance(vec2 uv, int page) in lux.

uniform sampler2D base_map, metallic_map, emission_map;
uniform vec3 base_color, emission, weight;
uniform float alpha, alpha_cutoff, metallic;
uniform bool double_sided;

in vec2 base_uv, metallic_uv, emission_uv, front_uv, back_uv;
flat in int front_page, back_page;

out vec4 seen;  // cd/m2; 1 where it is an emitter

void main() {
  vec4 base = texture(base_map, base_uv) * vec4(base_color, alpha);
  if (base.a < alpha_cutoff) discard;
  vec3 albedo = base.rgb * (1.0 - metallic * texture(metallic_map, metallic_uv).b);
  int page = gl_FrontFacing ? front_page : back_page;
  vec3 light = page < 0 ? vec3(0.0) : illuminance(gl_FrontFacing ? front_uv : back_uv, page);
  vec3 shines = emission * texture(emission_map, emission_uv).rgb;
  if (!gl_FrontFacing && !double_sided) shines = vec3(0.0);
  seen = vec4(albedo * light * 0.318309886 + weight * shines, any(notEqual(shines, vec3(0.0))) ? 1.0 : 0.0);
}
