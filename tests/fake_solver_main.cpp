// SPDX-License-Identifier: Apache-2.0
// An external solver that computes nothing: `fake_solver MODE [FOLDER] job.json` writes the known pages of
// fake_value(), or fails in the way that MODE says. docs/external-solvers.md has the contract.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/files.h"
#include "fake_solver.h"
#include "image/io.h"

using namespace sconce;
namespace fs = std::filesystem;

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string mode = argv[1], file = argv[argc - 1];
  const auto job = nlohmann::json::parse(read_file(file));
  fmt::print("chatter on standard output\n");
  fmt::print(stderr, "first\n\nsecond\nthird\nlast words\n");

  if (mode == "fail") return 3;
  if (mode == "abort") std::raise(SIGABRT);
  if (mode == "nothing") return 0;
  if (mode == "hang") {
    write_file(fs::path(argv[2]) / "started", "");
    std::this_thread::sleep_for(std::chrono::minutes(10));
  }
  if (mode == "keep") {
    const fs::path folder = fs::path(argv[2]) / job["group"].get<std::string>();
    fs::create_directories(folder);
    fs::copy(fs::path(file).parent_path(), folder);
  }
  const int width = job["width"], height = job["height"], pages = job["pages"];
  for (int p = 0; p < pages; ++p) {
    const fs::path output = job["outputs"][static_cast<std::size_t>(p)].get<std::string>();
    Image image(mode == "size" ? width / 2 : width, height, {"R", "G", "B"});
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Rgb value = mode == "black" ? Rgb() : test::fake_value(job["group"], p, x, y);
        const float wrong = mode == "nan"        ? std::numeric_limits<float>::quiet_NaN()
                            : mode == "negative" ? -1
                                                 : value.g;
        std::copy_n(std::array{value.r, wrong, value.b}.data(), 3, image.at(x, y));
      }
    if (mode == "channels") image.channels = {"X", "Y", "Z"};
    if (mode == "unit") image.text["sconce:unit"] = "cd/m2";
    if (mode == "garbage")
      write_file(output, "no picture");
    else
      write_exr(output, image, PixelType::full);
  }
}
