// SPDX-License-Identifier: Apache-2.0
#include "gpu/pixel_indirect.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kText =
#include "gpu/pixel_indirect.glsl.h"
    ;
constexpr uint32_t kNobody = 0xffffffffu;

Buffer receivers_of_pixels(const Context& context, const Operator& op) {
  std::vector<uint32_t> all(static_cast<std::size_t>(op.width) * static_cast<std::size_t>(op.height),
                            kNobody);
  for (uint32_t i = 0; i < op.places.size(); ++i) all[op.places[i]] = i;
  return {context, std::span<const uint32_t>(all), "the operator's pixels"};
}

}  // namespace

PixelIndirect::PixelIndirect(const Context& context, const Operator& op, const Buffer& illuminance,
                             float diagonal)
    : context_(&context),
      program_("indirect light on pixels", "#version 450 core\n" + SeenSurfaces::glsl() + std::string(kText)),
      points_(context, op.receivers, "the operator's receivers"),
      receiver_of_(receivers_of_pixels(context, op)),
      illuminance_(&illuminance) {
  program_.set("diagonal", diagonal);
}

void PixelIndirect::add(const SeenSurfaces& seen, const Texture& picture) {
  program_.use();
  GLuint binding = 0;
  for (const Buffer* buffer : std::initializer_list<const Buffer*>{&points_, illuminance_, &receiver_of_})
    buffer->bind(binding++);
  seen.shade(program_, picture);
  context_->check("adding indirect light");
}

}  // namespace sconce::gpu
