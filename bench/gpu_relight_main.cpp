// SPDX-License-Identifier: Apache-2.0
// Indirect light of moved lamps on whatever OpenGL computes here: an operator as large as `sconce transfer`
// makes them, with made-up numbers, against the bandwidth of the same device in the same run. Needs neither a
// scene nor a display.
#include <fmt/format.h>

#include "device.h"
#include "gpu/transfer.h"
#include "transfer/test_operator.h"

using namespace sconce;

int main() {
  try {
    const gpu::Context context({.debug = false});
    const gpu::Capabilities& can = context.capabilities();
    const double bandwidth = copy_bandwidth(context);
    fmt::print("{}, OpenGL {}; copying a buffer: {:.1f} GB/s\n\n", can.renderer, can.version,
               1e-9 * bandwidth);
    fmt::print("| receivers   | slots | bounces | operator MB | moved MB | ms      | GB/s   | x copy |\n");
    fmt::print("|---|---|---|---|---|---|---|---|\n");
    for (const auto& [width, height] : {std::pair(640u, 480u), std::pair(1920u, 1080u)})
      for (const bool bounces : {false, true}) {
        const uint32_t slots = 65536;
        const Operator op =
            made_up_operator({.receivers = width * height, .slots = slots, .bounces = bounces});
        const gpu::Transfer transfer(context, op);
        const std::vector<Rgbx> light(slots, Rgbx{1, 1, 1, 0});
        transfer.exitance().write(std::span(light).size_bytes(), light.data());
        const double seconds = device_seconds(context, [&] { transfer.apply(); });
        const auto moved = static_cast<double>(transfer.bytes_moved());
        fmt::print("| {:4} x {:4} | {:5} | {:7} | {:11.1f} | {:8.1f} | {:7.3f} | {:6.1f} | {:6.2f} |\n",
                   width, height, slots, bounces ? "all" : "one", 1e-6 * static_cast<double>(op.bytes()),
                   1e-6 * moved, 1e3 * seconds, 1e-9 * moved / seconds, seconds * bandwidth / moved);
      }
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "gpu_relight: {}\n", e.what());
    return 1;
  }
}
