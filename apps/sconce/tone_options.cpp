// SPDX-License-Identifier: Apache-2.0
#include "tone_options.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sconce::app {

namespace {

constexpr double kMaxStops = 64;

double parse_stops(const std::string& text, const std::string& option, const char* allowed) {
  const std::optional<double> value = parse_number(text);
  if (!value || !(std::abs(*value) <= kMaxStops))
    throw UsageError("option '" + option + "'", "'" + text + "' is not understood", allowed);
  return *value;
}

}  // namespace

Exposure ExposureChoice::resolve(const Metering& metering) const {
  return kind == Kind::ev100 ? ev100_exposure(value, metering.maximum)
                             : auto_exposure(metering.log_mean, metering.maximum, value);
}

std::string ExposureChoice::text() const {
  if (kind == Kind::ev100) return fmt::format("ev100 {:g}", value);
  return value == 0 ? "auto" : fmt::format("auto {:+g}", value);
}

void ToneOptions::declare(Options& options) {
  options.option("--exposure", &exposure,
                 "auto, or stops brighter (+1) or darker (-1) than that (default: auto)");
  options.option("--ev100", &ev100, "absolute exposure value at ISO 100; higher is darker");
  options.option("--tone", &curve, "agx, drago, drago2006, reinhard, aces, neutral, linear (default: agx)");
}

void ToneOptions::apply(const Preset& preset) {
  if (exposure.empty() && ev100.empty()) exposure = preset.exposure, ev100 = preset.ev100;
  if (curve.empty()) curve = preset.tone;
}

void ToneOptions::check() const {
  if (!exposure.empty() && !ev100.empty()) throw UsageError({}, "--exposure and --ev100 exclude each other");
  exposure_choice();
  mapper();
}

const ToneMapper& ToneOptions::mapper() const {
  return find_tone_mapper(curve.empty() ? "agx" : curve);
}

ExposureChoice ToneOptions::exposure_choice() const {
  if (!ev100.empty())
    return {ExposureChoice::Kind::ev100, parse_stops(ev100, "--ev100", "a number, higher is darker"), true};
  const bool automatic = exposure.empty() || exposure == "auto";
  return {ExposureChoice::Kind::automatic,
          automatic ? 0 : parse_stops(exposure, "--exposure", "auto, or stops such as +1 or -0.5"),
          !exposure.empty()};
}

}  // namespace sconce::app
