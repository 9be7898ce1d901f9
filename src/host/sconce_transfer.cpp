// SPDX-License-Identifier: Apache-2.0
#include "host/sconce_transfer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "transfer/folded_bounces.h"

using namespace sconce;

struct sconce_transfer {
  explicit sconce_transfer(const char* path) : op(open_operator(path)), bounces(op), light(op.slots()) {}

  Operator op;
  FoldedBounces bounces;
  std::vector<Rgbx> light;
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
    if (message != nullptr && message_size > 0) {
      std::strncpy(message, e.what(), message_size - 1);
      message[message_size - 1] = '\0';
    }
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
  bool bad = false;
  for (std::size_t slot = 0; slot < transfer->light.size(); ++slot) {
    Rgb sum;
    for (std::size_t i = slot * op.points_per_slot; i < (slot + 1) * op.points_per_slot; ++i) {
      const Rgb e(direct[3 * i], direct[3 * i + 1], direct[3 * i + 2]);
      if (std::isfinite(e.r) && std::isfinite(e.g) && std::isfinite(e.b))
        sum += unpack_albedo(op.lit[i].albedo) * e;
      else
        bad = true;
    }
    sum *= 1 / static_cast<float>(op.points_per_slot);
    transfer->light[slot] = {sum.r, sum.g, sum.b, 0};
  }
  transfer->bounces.apply(transfer->light);
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  multiply(op.gather, transfer->light, {reinterpret_cast<Rgb*>(indirect), op.gather.rows});
  for (std::size_t i = 0; i < std::size_t{3} * op.gather.rows; ++i) indirect[i] = std::max(indirect[i], 0.0f);
  return bad ? 1 : 0;
}
