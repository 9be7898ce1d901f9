// SPDX-License-Identifier: Apache-2.0
// A lamp's shader compiled into ours, twice: for points and for pixels.
#pragma once

#include <map>

#include "gpu/lamp_shader.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace sconce::gpu {

class LampProgram {
 public:
  /// @throws Error with the file and line of what does not compile, or when there is no light(P, N)
  LampProgram(const std::string& file, const std::string& text);

  const Program& points() const { return points_; }  ///< gpu/lamp_points.glsl
  const Program& pixels() const { return pixels_; }  ///< gpu/lamp_pixels.glsl
  /// What the text itself declares: floats, vectors of them, int, bool, sampler2D.
  const std::vector<ActiveUniform>& uniforms() const { return uniforms_; }

 private:
  ShaderPart part_;
  Program points_, pixels_;
  std::vector<ActiveUniform> uniforms_;
};

/// The values of a lamp's uniforms, checked against what its shader declares.
class LampValues {
 public:
  /// @throws UsageError naming the uniform and what is allowed; Error for pictures
  LampValues(const Context& context, const LampShader& lamp, const LampProgram& program);
  /// @param first_unit  for pictures, from here on
  void bind(const LampShader& lamp, const Program& program, int first_unit) const;

 private:
  struct Numbers {
    ActiveUniform uniform;
    std::vector<float> values;
  };
  std::vector<Numbers> numbers_;
  std::map<std::string, Texture> pictures_;  ///< per sampler; a white one where none is given
};

}  // namespace sconce::gpu
