// SPDX-License-Identifier: Apache-2.0
#version 450 core
// What a lamp's shader, which follows, may use. It defines
//   vec3 light(vec3 P, vec3 N)
// the illuminance in lux at P on a surface of unit normal N, the cosine included, as if nothing stood between.

uniform vec3 lamp_position;   // m
uniform vec3 lamp_axis;       // unit, where it points
uniform vec3 lamp_intensity;  // colour x strength, in whatever unit the shader takes it
uniform mat3 lamp_frame;      // its right, up and backward directions in the world; v * lamp_frame is v in the lamp's frame
