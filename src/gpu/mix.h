// SPDX-License-Identifier: Apache-2.0
// Two ways to mix layers on the device: in every pixel that looks at them, or the whole atlas once per change
// of a fader.
#pragma once

#include <memory>

#include "gpu/framebuffer.h"
#include "gpu/layer_pass.h"
#include "gpu/light_source.h"

namespace sconce::gpu {

/// Every look-up mixes all layers. Nothing to do when faders move; needs all layers in one shader.
class PixelMix : public LightSource {
 public:
  /// Can one shader read all of them?
  static bool possible(const Context& context, const EncodedLayers& layers, const ShaderTier& tier);
  /// @throws Error where it is not possible
  PixelMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier);

  void set(const std::vector<Rgb>& weights) { weights_ = weights; }
  std::string glsl() const override;
  bool directional() const override { return coefficients_ > 1; }
  void bind(const Program& program, int first_unit) const override;

 private:
  std::vector<LayerPass> passes_;
  std::size_t coefficients_;
  std::vector<Rgb> weights_;
};

/// Mixes to float pages, one per coefficient of the basis, from any number of layers; look-ups then cost the
/// same for any number.
class AtlasMix : public LightSource {
 public:
  enum class Form : uint8_t { fragment, compute };

  /// @throws Error where the tier has no float textures, or the form cannot mix so many layers
  AtlasMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier, Form form);
  /// By the quicker form: compute on graphics devices (bench/results/gpu_mix.md), if one shader can read all
  /// layers of a coefficient.
  AtlasMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier);
  ~AtlasMix() override;

  /// All pages. On the device it is done when that comes to it.
  void mix(const std::vector<Rgb>& weights) const;
  std::size_t passes() const { return passes_.size(); }
  /// RGB lux: all pages of the first coefficient, then those of the next. For tests.
  std::vector<Image> read() const;
  std::string glsl() const override;
  bool directional() const override { return page_count_ < pages_.params().layers; }
  void bind(const Program& program, int first_unit) const override;

 private:
  int page(int slice) const { return slice % page_count_; }
  std::size_t coefficient(int slice) const { return static_cast<std::size_t>(slice / page_count_); }
  void draw_slice(int slice, const std::vector<Rgb>& weights) const;
  void compute_slice(int slice, const std::vector<Rgb>& weights) const;

  const Context* context_;
  const ShaderTier* tier_;
  Form form_;
  std::vector<LayerPass> passes_;
  std::vector<std::unique_ptr<Program>> programs_;  ///< per pass
  int page_count_;
  Texture pages_;  ///< a slice per coefficient and page
  float scale_;    ///< stored is this times lux
  GLuint nothing_ = 0;
};

}  // namespace sconce::gpu
