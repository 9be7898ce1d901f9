// SPDX-License-Identifier: Apache-2.0
// `--light shader,file=barn.glsl,...`: a lamp that is the user's own function.
#pragma once

#include <string>

#include "gpu/lamp_shader.h"

namespace sconce::app {

/// `shader,file=F.glsl,position=X,Y,Z,target=X,Y,Z,intensity=N,kelvin=K,shadow=cube,UNIFORM=VALUE,...`: place
/// and colour in the words of [[light]], what is left are uniforms of the shader.
/// @throws UsageError naming the key; Error when the file cannot be read
gpu::LampShader parse_shader_lamp(const std::string& text, const std::string& where);

}  // namespace sconce::app
