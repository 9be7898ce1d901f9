// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "app.h"
#include "core/error.h"
#include "core/parallel.h"
#include "image/flip.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/primaries.h"
#include "table.h"

namespace sconce::app {

namespace {

struct Inputs {
  Image a, b;
  std::optional<Image> second, mask;
};

bool has_rgb(const Image& image) {
  return image.channel("R") >= 0 && image.channel("G") >= 0 && image.channel("B") >= 0;
}

/// Colours are compared as colours (an alpha beside them is no colour); files with the same other channels as
/// they are.
Inputs read_inputs(const std::string& a, const std::string& b, const std::string& second,
                   const std::string& mask) {
  Inputs in;
  in.a = read_image(a);
  in.b = read_image(b);
  if (!second.empty()) in.second = read_image(second);
  if (!mask.empty()) in.mask = read_image(mask);
  const bool as_they_are = !has_rgb(in.a) && in.a.channels == in.b.channels &&
                           (!in.second || in.second->channels == in.b.channels);
  if (!as_they_are) {
    in.a = rgb_part(in.a, a);
    in.b = rgb_part(in.b, b);
    if (in.second) in.second = rgb_part(*in.second, second);
  }
  return in;
}

struct Figures {
  Comparison all;
  RelativeRmse boxes;
  std::optional<Flip> flip;  ///< of pictures for a display alone
};

/// What `--metric` may name, with where its value is.
struct Metric {
  const char* name;
  double (*value)(const Figures& figures);
};
constexpr std::array kMetrics{
    Metric{"mse", [](const Figures& f) { return f.all.mse; }},
    Metric{"relmse", [](const Figures& f) { return f.all.relmse; }},
    Metric{"max", [](const Figures& f) { return f.all.max; }},
    Metric{"rmse", [](const Figures& f) { return f.boxes.rmse; }},
    Metric{"flip", [](const Figures& f) { return f.flip->mean; }},
};

std::string text_of(const Figures& figures, const Image& a) {
  const auto& [all, boxes, flip] = figures;
  Table table({{"figure"}, {"value", Table::Align::right}, {"of"}});
  const auto number = [](double v) { return fmt::format("{:.6g}", v); };
  const std::string pixels = fmt::format("{}x{} pixels", a.width, a.height);
  table.add({"mse", number(all.mse), pixels});
  table.add({"relmse", number(all.relmse), pixels});
  table.add({"max", number(all.max), pixels});
  table.add({"mean ratio", number(boxes.mean_ratio), fmt::format("{} kept pixels", boxes.kept_pixels)});
  table.add({"rmse", fmt::format("{:.4g}%", 100 * boxes.rmse),
             fmt::format("{} kept boxes, reference noise {:.3g}% taken off", boxes.kept, 100 * boxes.noise)});
  if (flip) table.add({"flip", number(flip->mean), pixels});
  std::string text = table.text();
  if (all.not_finite > 0) text += fmt::format("  {} pixels are not finite\n", all.not_finite);
  return text;
}

nlohmann::json json_of(const Figures& figures, const Image& a) {
  const auto& [all, boxes, flip] = figures;
  nlohmann::json json{{"width", a.width},
                      {"height", a.height},
                      {"mse", all.mse},
                      {"relmse", all.relmse},
                      {"max", all.max},
                      {"rmse", boxes.rmse},
                      {"reference_noise", boxes.noise},
                      {"mean_ratio", boxes.mean_ratio},
                      {"kept_boxes", boxes.kept},
                      {"kept_pixels", boxes.kept_pixels},
                      {"not_finite", all.not_finite}};
  if (flip) json["flip"] = flip->mean;
  return json;
}

}  // namespace

int run_diff(int argc, const char* const* argv) {
  std::string a, b, metric = "relmse", output, second, mask;
  double limit = std::numeric_limits<double>::infinity();
  Options options("diff",
                  "How far picture A is from reference B (.exr, .hdr, .png, .jpg; compared in linear light).",
                  {"sconce diff new.exr old.exr", "sconce diff new.exr old.exr --metric rmse --fail-above 2%",
                   "sconce diff {A} {B} -o where.png"});
  options.positional("A", &a, "picture that is judged");
  options.positional("B", &b, "reference");
  options.option(
      "--metric", &metric,
      "what --fail-above looks at: mse, relmse (squared error over squared reference), max, rmse (relative, "
      "of 4x4 box means, reference noise taken off), flip (0 to 1: how strongly an eye sees pictures for a "
      "display differ)");
  options.option("--fail-above", &limit,
                 "exit with 3 when the metric is above this or not a number; accepts 2%");
  options.option("--reference2", &second,
                 "second, independent rendering of B: gives the noise of the reference");
  options.option("--mask", &mask,
                 "coverage of visible emitters: pixels above 0 and their neighbours do not count in "
                 "rmse and mean ratio");
  options.option("-o,--output", &output,
                 "PNG of the error in false colour, worst 1% of boxes framed; with flip, its map");
  if (const auto code = options.parse(argc, argv)) return *code;
  const auto chosen =
      std::find_if(kMetrics.begin(), kMetrics.end(), [&](const Metric& m) { return m.name == metric; });
  if (chosen == kMetrics.end())
    throw UsageError("--metric", "unknown metric '" + metric + "'", "mse, relmse, max, rmse, flip");

  const ThreadLimit threads(options.threads);
  const Inputs in = read_inputs(a, b, second, mask);
  const Image* kept = in.mask ? &*in.mask : nullptr;
  Figures figures{
      compare(in.a, in.b), relative_rmse(in.a, in.b, in.second ? &*in.second : nullptr, kept), {}};
  const bool flips = metric == "flip";
  if (flips || (is_display_light(in.a) && is_display_light(in.b))) figures.flip = flip(in.a, in.b);
  if (!output.empty())
    write_png(output,
              flips ? false_color(figures.flip->map) : error_picture(in.a, in.b, kept, figures.boxes.boxes));

  const double value = chosen->value(figures);
  const bool differs = std::isfinite(limit) && !(value <= limit);
  if (options.json) {
    nlohmann::json json = json_of(figures, in.a);
    json["metric"] = metric;
    json["differs"] = differs;
    fmt::print("{}\n", json.dump(2));
  } else if (!options.quiet) {
    fmt::print("{}", text_of(figures, in.a));
    if (differs) fmt::print("  {} {:.6g} is above {:.6g}\n", metric, value, limit);
  }
  if (output.empty()) options.next({a, b});
  return differs ? kDiffers : kDone;
}

}  // namespace sconce::app
