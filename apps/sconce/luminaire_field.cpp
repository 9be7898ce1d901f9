// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app.h"
#include "core/error.h"
#include "luminaire.h"
#include "photometry/light_field_file.h"
#include "photometry/rays.h"

namespace sconce::app {

namespace {

/// Where rays leave, as far as they go within an angle from nadir.
struct Extent {
  Vec2 low{1e30f}, high{-1e30f};  ///< on the sampling plane, m
  float bottom = 0;               ///< z of the sampling plane: the lowest start of a ray
};

constexpr double kMostGigabytes = 2;

class Field {
 public:
  Field(std::string file, float tangent, const Progress& progress)
      : file_(std::move(file)), tangent_(tangent), progress_(progress) {}

  /// The plane below all starts of rays, then what of it they cross.
  Extent extent() const {
    Extent out;
    each([&](const SourceRay& ray) { out.bottom = std::min(out.bottom, ray.position.z); });
    each([&](const SourceRay& ray) {
      const SourceRay r = lowered(ray, out.bottom);
      if (!within(r)) return;
      const Vec2 uv = Vec2(r.position) - Vec2(r.direction) * (r.position.z / r.direction.z);
      out.low = glm::min(out.low, uv), out.high = glm::max(out.high, uv);
    });
    if (out.low.x > out.high.x) throw Error(file_, "sends no ray within --angle of nadir");
    return out;
  }

  void project(LightFieldBuilder& builder, float bottom, float scale) const {
    std::vector<SourceRay> block;
    read_rays(
        file_,
        [&](std::span<const SourceRay> rays) {
          block.clear();
          for (const SourceRay& ray : rays) {
            SourceRay r = lowered(ray, bottom);
            r.flux *= scale;
            if (!within(r)) r.direction = Vec3(0, 0, 1);  // counts as lost
            block.push_back(r);
          }
          builder.add(block);
        },
        progress_);
  }

  double flux() const {
    double sum = 0;
    each([&](const SourceRay& ray) { sum += static_cast<double>(ray.flux); });
    return sum;
  }

 private:
  template <class F>
  void each(const F& f) const {
    read_rays(
        file_,
        [&](std::span<const SourceRay> rays) {
          for (const SourceRay& ray : rays) f(ray);
        },
        progress_);
  }
  static SourceRay lowered(SourceRay ray, float bottom) {
    ray.position.z -= bottom;
    return ray;
  }
  bool within(const SourceRay& ray) const {
    return ray.direction.z < 0 && glm::length(Vec2(ray.direction)) <= tangent_ * -ray.direction.z;
  }

  std::string file_;
  float tangent_;
  const Progress& progress_;
};

NearBasis parse_basis(const std::string& name) {
  if (name == "bell") return NearBasis::bell;
  if (name == "spline") return NearBasis::spline;
  throw UsageError("--basis", "'" + name + "' is unknown", "bell, spline");
}

}  // namespace

int run_luminaire_field(int argc, const char* const* argv) {
  std::string file, output, basis = "spline";
  double spacing = 5, distance = 0, angle = 60, lumens = 0;
  int pixels = 128;
  Options options("luminaire field", "Rays of a lamp to its near-field light field (docs/luminaires.md).");
  options.positional("file", &file, "TM-25, LightTools or Zemax rays");
  options.option("-o,--output", &output, "light field to write, .exr");
  options.option("--basis", &basis, "spline, or the paper's bell");
  options.option("--spacing", &spacing, "millimetres between filters on the sampling plane");
  options.option("--distance", &distance, "millimetres to the measurement plane; 0 = 25 spacings");
  options.option("--angle", &angle, "rays further from nadir are left out, degrees");
  options.option("--pixels", &pixels, "of an image's edge");
  options.option("--lumens", &lumens, "scale to this luminous flux; 0 = as it is");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (output.empty()) throw UsageError("-o", "is missing", "a file .exr");
  if (!(spacing > 0)) throw UsageError("--spacing", "is not positive", "millimetres > 0");
  if (!(distance >= 0)) throw UsageError("--distance", "is negative", "millimetres >= 0");
  if (!(angle > 0 && angle < 85))
    throw UsageError("--angle", "is out of range", "degrees above 0 and below 85");
  if (pixels < 8 || pixels > 2048) throw UsageError("--pixels", "is out of range", "8 to 2048");
  const NearBasis chosen = parse_basis(basis);
  const double h = spacing * 1e-3, d = distance > 0 ? distance * 1e-3 : 25 * h;
  const double tangent = std::tan(angle * std::numbers::pi / 180);
  const Progress progress = make_progress(options);
  const Field rays(file, static_cast<float>(tangent), progress);
  const Extent extent = rays.extent();
  const Vec2 size = extent.high - extent.low;
  LightField empty =
      make_light_field(chosen, extent.low, extent.high, h, d,
                       0.5 * static_cast<double>(std::max(size.x, size.y)) + d * tangent, pixels);
  if (const double bytes = 12.0 * static_cast<double>(empty.terms() * empty.pixels());
      bytes > kMostGigabytes * 1e9)
    throw UsageError("--spacing",
                     fmt::format("makes {} x {} filters of {} x {} pixels, {:.1f} GB", empty.columns,
                                 empty.rows, pixels, pixels, bytes / 1e9),
                     "at most 2 GB; a wider spacing, a smaller --angle or fewer --pixels");
  const double total = rays.flux(), scale = lumens > 0 ? lumens / total : 1;
  LightFieldBuilder builder(std::move(empty));
  rays.project(builder, extent.bottom, static_cast<float>(scale));
  const double kept = builder.kept(), lost = builder.lost();
  const LightField field = std::move(builder).finish();
  write_light_field(output, field);
  const double spread = geometric_spread(1, 4 * h / d);
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"file", output},
                                      {"columns", field.columns},
                                      {"rows", field.rows},
                                      {"lumens", kept},
                                      {"lumens_lost", lost},
                                      {"plane", extent.bottom},
                                      {"spread_at_45", spread}}
                           .dump(2));
  else if (!options.quiet)
    fmt::print(
        "{}: {} x {} filters of {} x {} pixels, {:.4g} lm, {:.4g} lm beyond {:g} degrees or upward left out; "
        "cos4 varies by {:.1f} % over a filter at 45 degrees\n",
        output, field.columns, field.rows, field.width, field.height, kept, lost, angle, 100 * spread);
  return kDone;
}

}  // namespace sconce::app
