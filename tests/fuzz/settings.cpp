// SPDX-License-Identifier: Apache-2.0
// GROUP=SETTING, one a line, on three groups.
#include "mix/settings.h"
#include "core/text.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static const std::vector<GroupInfo> groups = [] {
    std::vector<GroupInfo> three(3);
    three[0].name = "ceiling", three[0].lumens = 800;
    three[1].name = "desk lamp", three[1].lumens = 400, three[1].color_spread = 0.5;
    three[2].name = "sky", three[2].infinite = true;
    return three;
  }();
  return fuzz::answers([&] {
    const std::vector<std::string> lines = split(fuzz::text(data, size), '\n');
    make_mix(groups, lines, "", [](const std::string&) {});
  });
}
