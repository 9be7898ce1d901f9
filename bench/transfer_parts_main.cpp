// SPDX-License-Identifier: Apache-2.0
// Where an operator's error comes from: the same lamps and boxes as transfer_error's by its own rays without
// compression, with more of them, and with each half compressed alone; or by the parts of the chapter's
// method. Usage: transfer_parts PACKAGE OPERATOR [LAMPS BOXES PATHS SEED], the operator of pixels and made
// with defaults but for --gather, --cluster, --points. The tables: bench/results/transfer.md, docs/adr/0040.
#include "gather/row_rays.h"
#include "gather/rows.h"
#include "relight/chapter_operator.h"
#include "relight/cloud_photons.h"
#include "relight/operator_start.h"
#include "transfer/folded_bounces.h"
#include "transfer_case.h"

using namespace sconce;

namespace {

using Lights = std::vector<std::vector<Rgbx>>;  ///< per lamp, per slot

class Parts {
 public:
  explicit Parts(const TransferCase& c)
      : view_(c.view), op_(c.op), lamps_(c.lamps), boxes_(c.boxes), truth_(c.truth) {
    Camera camera;
    camera.name = op_.camera, camera.frame = op_.camera_frame, camera.yfov = op_.camera_yfov;
    receivers_ = pixel_receivers(view_.traced(), camera, op_.width, op_.height);
  }

  /// A cloud as `transfer` makes it.
  std::unique_ptr<OperatorStart> start(std::size_t slots, int points) const {
    TransferParams params;
    params.gather = slots, params.points = points;
    auto out =
        std::make_unique<OperatorStart>(view_.traced(), receivers_, params, op_.gather.cluster, Progress{});
    out->op.gather.basis.columns = static_cast<uint32_t>(slots);
    return out;
  }

  /// b_d of all slots.
  Lights direct(const Operator& op) const {
    Lights out;
    for (const Light& lamp : lamps_)
      out.push_back(light_cloud(op, MovedLamps(view_.scene(), view_.world(), view_.tracer(), {{lamp}}, {})));
    return out;
  }
  /// And what bounces add, by rows of the samples' own rays.
  Lights bounced(const OperatorStart& s, const Lights& direct, int rays) const {
    const GatherCloud& cloud = *s.cloud;
    const std::size_t n = cloud.size(), width = 3 * direct.size();
    std::vector<float> exitance(width * n), once(width * n);
    for (std::size_t g = 0; g < direct.size(); ++g)
      for (std::size_t i = 0; i < n; ++i)
        for (const uint32_t slot : s.square.of(static_cast<uint32_t>(i)))
          for (std::size_t c = 0; c < 3; ++c)
            exitance[width * i + 3 * g + c] +=
                direct[g][slot][c] / static_cast<float>(s.square.of(static_cast<uint32_t>(i)).size());
    const SparseRows rows = gather(view_.world(), view_.tracer(), cloud, rays, 1, {}).rows;
    for (std::size_t i = 0; i < n; ++i) rows.apply(i, exitance, std::span(once).subspan(width * i, width));
    const std::vector<float> all = bounce(rows, cloud, once, enough_bounces(rows, cloud));
    Lights out = direct;
    for (std::size_t g = 0; g < direct.size(); ++g)
      for (std::size_t slot = 0; slot < out[g].size(); ++slot) {
        const uint32_t i = s.square.samples[slot];
        const Rgb& albedo = cloud.albedo(i);
        const float* e = &all[width * i + 3 * g];
        out[g][slot][0] += albedo.r * e[0], out[g][slot][1] += albedo.g * e[1],
            out[g][slot][2] += albedo.b * e[2];
      }
    return out;
  }
  /// All bounces by photons, as the chapter has it.
  Lights by_photons(const OperatorStart& s, const Lights& direct, std::size_t photons,
                    std::size_t nearest) const {
    const CloudPhotons map(view_.traced(), *s.cloud, s.square, photons, 1);
    Lights out = direct;
    parallel_for(s.square.samples.size(), 64, [&](std::size_t slot) {
      const uint32_t i = s.square.samples[slot];
      std::vector<SparseEntry> row;
      const Rgb tint =
          s.cloud->albedo(i) * map.row(s.cloud->point(i, s.cloud->footprint(i), Vec2(0.5f)), nearest, row);
      for (std::size_t g = 0; g < direct.size(); ++g) {
        Rgb sum;
        for (const SparseEntry& e : row) {
          const Rgbx& b = direct[g][e.index];
          sum += e.value * Rgb(b[0], b[1], b[2]);
        }
        sum *= tint;
        out[g][slot][0] += sum.r, out[g][slot][1] += sum.g, out[g][slot][2] += sum.b;
      }
    });
    return out;
  }

  /// F by rays to the cloud. What the first call gives is the truth where none was traced.
  void gather_rays(const std::string& name, const OperatorStart& s, const Lights& light, uint32_t rays) {
    print(name, light, [&](const SurfacePoint& at, uint32_t i, std::vector<SparseEntry>& row) {
      const uint32_t stream = mix32(0x70617274u, i);
      for (uint32_t r = 0; r < rays; ++r) {
        const auto end = follow_row_ray(view_.world(), view_.tracer(), *s.cloud, at, r, stream,
                                        [](const SurfacePoint&, uint32_t, uint32_t, const Rgb&) {});
        if (!end) continue;
        const std::span<const uint32_t> slots = s.square.of(end->sample);
        for (const uint32_t slot : slots)
          row.push_back({slot, 1.0f / static_cast<float>(rays * slots.size())});
      }
    });
  }
  /// F by form factors between points. @param clamp  1/r2, as the method does
  void gather_points(const std::string& name, const OperatorStart& s, const Lights& light, bool clamp) {
    std::vector<float> areas;
    for (const uint32_t sample : s.square.samples)
      areas.push_back(s.cloud->area(sample) / static_cast<float>(s.square.of(sample).size()));
    const PointFactors factors(view_.tracer(), s.op, areas);
    print(name, light, [&](const SurfacePoint& at, uint32_t, std::vector<SparseEntry>& row) {
      factors.row(at, row);
      if (clamp) return;
      for (SparseEntry& e : row) {
        const auto& p = s.op.lit[s.op.points_per_slot * e.index].position;
        const Vec3 to = Vec3(p[0], p[1], p[2]) - at.position;
        const float square = glm::dot(to, to);
        e.value *= std::max(square, areas[e.index] * kInvPi) / square;
      }
    });
  }
  void compressed(const std::string& name, Lights light) {
    std::vector<std::vector<double>> have;
    std::vector<Rgb> out(op_.gather.rows);
    for (std::vector<Rgbx>& one : light) {
      weigh(op_, one);
      haar_forward(one);
      multiply(op_.gather, one, out);
      have.push_back(over_boxes(boxes_, out));
    }
    print(name, have);
  }

 private:
  /// @param make  fills a row of F: (place, number, row)
  template <class Make>
  void print(const std::string& name, const Lights& light, const Make& make) {
    std::vector<std::vector<double>> have(light.size(), std::vector<double>(boxes_.size()));
    std::vector<double> sums(boxes_.size());
    parallel_for(boxes_.size(), 1, [&](std::size_t k) {
      std::vector<SparseEntry> row;
      const double share = 1 / static_cast<double>(boxes_[k].size());
      for (const uint32_t i : boxes_[k]) {
        row.clear();
        make(point_of(op_.receivers[i]), i, row);
        for (const SparseEntry& e : row) {
          sums[k] += share * static_cast<double>(e.value);
          for (std::size_t g = 0; g < light.size(); ++g) {
            const Rgbx& b = light[g][e.index];
            have[g][k] += share * static_cast<double>(e.value * luminance(Rgb(b[0], b[1], b[2])));
          }
        }
      }
    });
    double sum = 0;
    for (const double s : sums) sum += s / static_cast<double>(sums.size());
    print(fmt::format("{}, row sums {:.3f}", name, sum), have);
  }
  void print(const std::string& name, const std::vector<std::vector<double>>& have) {
    if (truth_.light.empty()) {
      truth_.light = have;
      truth_.squared_noise.assign(have.size(), std::vector<double>(boxes_.size()));
    }
    Errors errors[2];
    for (std::size_t g = 0; g < have.size(); ++g) errors[g % 2].add(have[g], truth_, g);
    fmt::print("{}\n  point {}\n  spot  {}\n", name, errors[0].text(), errors[1].text());
    std::fflush(stdout);
  }

  const View& view_;
  const Operator& op_;
  const std::vector<Light>& lamps_;
  Boxes boxes_;
  Truth truth_;
  RelightReceivers receivers_;
};

/// b_d becomes (M + I) b_d, as it is.
void all_bounces(const Operator& op, const FoldedBounces& folded, std::vector<Rgbx>& light) {
  folded.apply(light);
  haar_inverse(light);
  for (std::size_t slot = 0; slot < light.size(); ++slot)
    if (const float weight = op.albedo[slot][3]; weight > 0)
      for (std::size_t c = 0; c < 3; ++c) light[slot][c] /= weight;
}

void fitted(Parts& parts, const Operator& op, bool by_paths) {
  const auto points = static_cast<int>(op.points_per_slot);
  const auto own = parts.start(op.slots(), points);
  const Lights direct = parts.direct(own->op), bounced = parts.bounced(*own, direct, 32);
  const FoldedBounces folded(op);
  Lights by_operator = parts.direct(op);
  for (std::vector<Rgbx>& light : by_operator) {
    all_bounces(op, folded, light);
  }
  parts.gather_rays("without compression", *own, bounced, 512);
  parts.compressed("the operator", by_operator);
  parts.compressed("its F, K without compression", bounced);
  parts.gather_rays("its K, F without compression", *own, by_operator, 512);
  if (!by_paths) return;
  parts.gather_rays("without compression, 4096 rays of F", *own, bounced, 4096);
  const Lights finer = parts.bounced(*own, direct, 256);
  parts.gather_rays("and 256 rays of K", *own, finer, 4096);
  const auto many = parts.start(op.slots(), 16 * points);
  parts.gather_rays("and 16 times the points", *many, parts.bounced(*many, parts.direct(many->op), 256),
                    4096);
  const auto fine = parts.start(4 * op.slots(), 4 * points);
  parts.gather_rays("and 4 times the slots, 4 times the points", *fine,
                    parts.bounced(*fine, parts.direct(fine->op), 256), 4096);
}

void chapter(Parts& parts, const Operator& op) {
  const auto own = parts.start(op.slots(), static_cast<int>(op.points_per_slot));
  const Lights direct = parts.direct(own->op), bounced = parts.bounced(*own, direct, 256);
  Lights by_operator = direct;
  const FoldedBounces folded(op);
  for (std::vector<Rgbx>& light : by_operator) {
    all_bounces(op, folded, light);
  }
  parts.gather_rays("F and K by rays", *own, bounced, 4096);
  parts.compressed("the operator", by_operator);
  parts.gather_points("F between points, clamped; K by rays", *own, bounced, true);
  parts.gather_points("F between points, not clamped; K by rays", *own, bounced, false);
  parts.gather_rays("F by rays, no bounces", *own, direct, 4096);
  for (const std::size_t nearest : {1000u, 100u, 20u})
    parts.gather_rays(fmt::format("F by rays; a million photons, {} nearest", nearest), *own,
                      parts.by_photons(*own, direct, 1'000'000, nearest), 4096);
  parts.gather_rays("F by rays; 16 million photons, 1000 nearest", *own,
                    parts.by_photons(*own, direct, 16'000'000, 1000), 4096);
}

void report(const Words& words) {
  const TransferCase own(words, 4096);
  if (own.op.kind != OperatorReceivers::pixels)
    throw UsageError(words.name(2), "texels", "pixels of a camera");
  Parts parts(own);
  own.op.gather.plain() ? chapter(parts, own.op) : fitted(parts, own.op, !own.truth.light.empty());
}

}  // namespace

int main(int argc, char** argv) {
  return run_with_words(argc, argv, 2, "transfer_parts PACKAGE OPERATOR [LAMPS [BOXES [PATHS [SEED]]]]",
                        report);
}
