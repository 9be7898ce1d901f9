// SPDX-License-Identifier: Apache-2.0
#include "viewer/sheet.h"

namespace sconce::viewer {

Sheet::Sheet(const gpu::Context& context, std::shared_ptr<const OpenedPicture> opened)
    : Screen(context),
      opened_(std::move(opened)),
      mixer_(layers_of(opened_)),
      light_(context, {.format = GL_RGB32F, .width = opened_->width(), .height = opened_->height()},
             "picture") {}

void Sheet::draw(const Session& session, LookKind look, const FalseColor& scale) {
  const ToneMapper& curve = find_tone_mapper(session.mood().tone);
  const bool metered = session.mood().automatic || curve.needs_maximum;
  const MixSpec mix = session.mix();
  drawing_ms_ = 0;
  const bool changed = !mixed_ || mix.weights != mix_.weights;
  if (changed || (metered && !metered_)) {
    const Stopwatch watch;
    if (changed) mixed_light_ = mixer_.mix(mix).front();
    if (metered) metering_ = meter_picture(mixed_light_);
    fader_ms_ = watch.milliseconds();
    if (changed) light_.upload(GL_RGB, GL_FLOAT, mixed_light_.data.data());
    mix_ = mix, mixed_ = true, metered_ = metered;
  } else if (shown_ == session.mood() && look == look_ && scale == scale_) {
    return;
  }
  const Stopwatch watch;
  if (row_of(look).unit.empty())
    display_.tone(light_, 1, session.exposure(metering_), curve);
  else
    display_.false_color(light_, 1, 1, scale);
  drawing_ms_ = watch.milliseconds();
  shown_ = session.mood(), look_ = look, scale_ = scale;
}

}  // namespace sconce::viewer
