// SPDX-License-Identifier: Apache-2.0
// A preset file. What is taken is written, and read back the same.
#include "mix/preset.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File file("mood.toml"), again("again.toml");
  const std::filesystem::path& path = file.hold(fuzz::text(data, size));
  return fuzz::answers([&] {
    const std::string once = print_preset(read_preset(path));
    if (print_preset(read_preset(again.hold(once))) != once) __builtin_trap();
  });
}
