// SPDX-License-Identifier: Apache-2.0
// The last step of a picture: linear values to codes that a display shows, on the device.
#pragma once

#include <memory>
#include <optional>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "tone/exposure.h"
#include "tone/false_color.h"

namespace sconce::gpu {

class DisplayPass {
 public:
  /// @param context  must outlive it
  explicit DisplayPass(const Context& context);
  ~DisplayPass();

  /// Exposure, curve and sRGB transfer. @param sum  of `samples` pictures
  void tone(const Texture& sum, int samples, const Exposure& exposure, const ToneMapper& mapper);
  /// Luminances as colours. @param scale  what sums are multiplied by beside 1 / samples
  void false_color(const Texture& sum, int samples, float scale, const FalseColor& colors);

  /// What was drawn last; RGBA codes, row 0 on top. @pre something was drawn
  const Texture& texture() const { return target_->texture; }
  Image8 read() const;

 private:
  struct Target {
    Target(const Context& context, int width, int height)
        : texture(context, {.format = GL_RGBA8, .width = width, .height = height}, "picture"),
          framebuffer(texture, 0) {}
    Texture texture;
    Framebuffer framebuffer;
  };
  void draw(const Texture& sum);

  const Context* context_;
  std::optional<Target> target_;
  std::unique_ptr<Program> tone_, false_color_;
  const ToneMapper* mapper_ = nullptr;  ///< of tone_
  GLuint nothing_ = 0;                  ///< vertex array of shaders that need no vertices
};

}  // namespace sconce::gpu
