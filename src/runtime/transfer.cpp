// SPDX-License-Identifier: Apache-2.0
#include "runtime/sconce.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "core/c_message.h"
#include "core/parallel.h"
#include "transfer/folded_bounces.h"

using namespace sconce;

struct sconce_transfer {
  explicit sconce_transfer(const char* path) : op(open_operator(path)), bounces(op) {}

  Operator op;
  FoldedBounces bounces;
};

namespace {

void fill(std::span<const OperatorPoint> from, sconce_point* to) {
  parallel_for(from.size(), 4096, [&](std::size_t i) {
    const OperatorPoint& p = from[i];
    const Vec3 normal = unpack_normal(p.shading), facing = unpack_normal(p.geometric);
    const Rgb albedo = unpack_albedo(p.albedo);
    to[i] = {{p.position[0], p.position[1], p.position[2]},
             {normal.x, normal.y, normal.z},
             {facing.x, facing.y, facing.z},
             {albedo.r, albedo.g, albedo.b}};
  });
}

}  // namespace

sconce_transfer* sconce_transfer_open(const char* path, char* message, size_t message_size) {
  try {
    return new sconce_transfer(path);
  } catch (const std::exception& e) {
    copy_message(e.what(), message, message_size);
    return nullptr;
  }
}

void sconce_transfer_close(sconce_transfer* transfer) {
  delete transfer;
}

size_t sconce_transfer_gather_count(const sconce_transfer* transfer) {
  return transfer->op.lit.size();
}

size_t sconce_transfer_receiver_count(const sconce_transfer* transfer) {
  return transfer->op.gather.rows;
}

void sconce_transfer_gather_points(const sconce_transfer* transfer, sconce_point* points) {
  fill(transfer->op.lit, points);
}

void sconce_transfer_receivers(const sconce_transfer* transfer, sconce_point* points) {
  fill(transfer->op.receivers, points);
}

void sconce_transfer_places(const sconce_transfer* transfer, uint32_t* places) {
  std::copy(transfer->op.places.begin(), transfer->op.places.end(), places);
}

int sconce_transfer_apply(sconce_transfer* transfer, const float* direct, float* indirect) {
  const Operator& op = transfer->op;
  std::atomic<bool> bad = false;
  std::vector<Rgbx> light = slot_exitance(op, [&](std::size_t i) {
    const Rgb e(direct[3 * i], direct[3 * i + 1], direct[3 * i + 2]);
    if (std::isfinite(e.r) && std::isfinite(e.g) && std::isfinite(e.b)) return e;
    bad = true;
    return Rgb();
  });
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  transfer->bounces.indirect(light, {reinterpret_cast<Rgb*>(indirect), op.gather.rows});
  return bad ? 1 : 0;
}
