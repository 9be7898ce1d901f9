// SPDX-License-Identifier: Apache-2.0
// The direct-to-indirect operator: direct light on a cloud of samples in, indirect light on receivers out
// (system C). Without rays: whoever can light points can use it. File: docs/operator-format.md.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/vec.h"
#include "transfer/cluster_rows.h"

namespace sconce {

/// A point of a surface as files and shaders keep it.
struct OperatorPoint {
  std::array<float, 3> position;   ///< m
  std::array<int16_t, 2> shading;  ///< normals, octahedral
  std::array<int16_t, 2> geometric;
  std::array<uint16_t, 4> albedo;  ///< diffuse, linear, 65535 = 1; the fourth is 0
};
static_assert(sizeof(OperatorPoint) == 28);

std::array<int16_t, 2> pack_normal(const Vec3& n);
Vec3 unpack_normal(const std::array<int16_t, 2>& packed);
std::array<uint16_t, 4> pack_albedo(const Rgb& albedo);
Rgb unpack_albedo(const std::array<uint16_t, 4>& packed);

/// Lobes are those of pixels that mirror: rows over the directions of their reflection; the mean radiosity
/// that a row sees times the pixel's albedo / pi is what comes to the eye, cd/m2.
enum class OperatorReceivers : uint32_t { texels, pixels, vertices, lobes };

/// Arrays may lie in the bytes of a file, which `owners` keep.
struct Operator {
  OperatorReceivers kind = OperatorReceivers::texels;
  int width = 0, height = 0, pages = 0;  ///< of the lightmap or the picture (pages 1); vertices x 1 x 1
  std::string camera;                    ///< of pixels: its name
  Mat4 camera_frame{1.0f};
  float camera_yfov = 0;
  std::string scene;    ///< hash of the geometry, materials and texels that it was made for
  std::string options;  ///< what it was made with, for people
  uint32_t sweeps = 0;  ///< how often light is sent through `bounce`

  uint32_t points_per_slot = 0;
  std::span<const OperatorPoint> lit;        ///< slots x points: where direct light is asked for
  std::span<const OperatorPoint> receivers;  ///< per row of `gather`
  std::span<const uint32_t> places;          ///< per row: page * height * width + y * width + x
  ClusterRows gather;                        ///< F: receivers x slots
  /// K of the cloud in two steps: `first` from slots to nodes, which are equal runs of slots (of one: ADR
  /// 17), `bounce` from nodes to nodes for light that was reflected and is even.
  ClusterRows first, bounce;
  /// Per node; with one sweep of all bounces, times what they do to colours. The fourth: what light of slots
  /// is multiplied by before any rows see it, and this albedo is already; 0: 1 (ADR 46).
  std::span<const Rgbx> albedo;
  std::vector<std::shared_ptr<const void>> owners;

  uint32_t slots() const { return gather.basis.columns; }
  /// Of the matrices.
  uint64_t bytes() const { return gather.bytes() + first.bytes() + bounce.bytes(); }
};

/// b_d per slot: the mean of albedo x direct illuminance over its points, lm/m2.
/// @param direct  lux at `lit[i]`; thread-safe
std::vector<Rgbx> slot_exitance(const Operator& op, const std::function<Rgb(std::size_t i)>& direct);

/// Light of slots as rows see it: times their weights. In place.
void weigh(const Operator& op, std::span<Rgbx> exitance);

/// E_i = F (M + I) b_d: multiply() after all bounces, M = rho K + rho K rho K + ... by sweeps of scalar K and
/// RGB rho. Linear in its input to float rounding.
/// @param exitance  b_d = albedo x direct illuminance, mean over the slot's points, lm/m2; per slot. Changed
/// @return illuminance by light that was reflected at least once, lux; per receiver
std::vector<Rgb> indirect_light(const Operator& op, std::vector<Rgbx>& exitance);

/// Light of the cloud after its first reflection, per node, lm/m2, weighed.
/// @param exitance  per slot
std::vector<Rgbx> first_bounce(const Operator& op, std::span<const Rgbx> exitance);

/// The first half of it: the wavelet coefficients of (M + I) b_d, weighed. In place. Needs `first`, `bounce`,
/// `albedo`.
void bounce_light(const Operator& op, std::span<Rgbx> exitance);

/// The parts of it, on wavelet coefficients of weighed b_d: light after its first reflection, per node; and
/// adding light of nodes. @param nodes  changed
std::vector<Rgbx> reflected_once(const Operator& op, std::span<const Rgbx> coefficients);
void add_reflected(std::span<Rgbx> coefficients, std::vector<Rgbx>& nodes);

/// Sweeps after which all light still to come is less than `tolerance` of what started, were it even. A
/// property of the operator alone, so that its answer is linear.
uint32_t enough_sweeps(const ClusterRows& bounce, std::span<const Rgbx> albedo, double tolerance = 1e-3);

/// Writes beside and renames. @throws Error
void write_operator(const std::filesystem::path& path, const Operator& op);
/// @param check  its checksum, too; reads all of it
/// @throws Error: missing, truncated, damaged, another version (both named); NotMyFormat
Operator open_operator(const std::filesystem::path& path, bool check = true);

}  // namespace sconce
