// SPDX-License-Identifier: Apache-2.0
// Megabytes of texels against error, per encoding, over the layers of packages (baked with --encoding f32).
//   encodings PACKAGE...
#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "encode/choice.h"
#include "package/package.h"

using namespace sconce;

namespace {

/// All pages of a group.
EncodingError worst_page(const Package& package, std::size_t group, const EncodingChoice& choice) {
  EncodingError worst;
  const GroupInfo& info = package.manifest().groups[group];
  for (int page = 0; page < package.manifest().pages; ++page) {
    const Image layer = package.layer(group, page);
    const LayerTexture alone{choice, {group}, {}};
    const EncodingError error = measure_encoding(layer, alone.decode(alone.encode({&layer}), 0, info.color),
                                                 package.receivers(page), info.mean_lux);
    worst = {std::max(worst.relative, error.relative), std::max(worst.chroma, error.chroma)};
  }
  return worst;
}

/// Median and largest error over the groups, and the megabytes of all.
void print_row(const std::string& name, double megabytes, std::vector<EncodingError> errors) {
  std::sort(errors.begin(), errors.end(),
            [](const auto& a, const auto& b) { return a.relative < b.relative; });
  double chroma = 0;
  for (const EncodingError& e : errors) chroma = std::max(chroma, e.chroma);
  fmt::print("| {:<12} | {:7.2f} | {:8.3f} | {:8.3f} | {:6.2f} |\n", name, megabytes,
             100 * errors[errors.size() / 2].relative, 100 * errors.back().relative, chroma);
}

void print_table(const std::string& path) {
  const Package package = Package::open(path);
  const Manifest& m = package.manifest();
  const double texels = 1e-6 * m.width * m.height * m.pages;
  fmt::print("\n{}: {} groups, {} x {}, {} page(s)\n\n", path, m.groups.size(), m.width, m.height, m.pages);
  fmt::print("| encoding     | MB      | median % | worst %  | dE*ab  |\n|---|---|---|---|---|\n");
  std::vector<EncodingChoice> choices;
  for (const bool luminance : {false, true})
    for (const Encoding& e : encodings())
      if (!luminance || e.per_channel) choices.push_back({&e, luminance});
  for (const EncodingChoice& choice : choices) {
    std::vector<EncodingError> errors;
    for (std::size_t g = 0; g < m.groups.size(); ++g) errors.push_back(worst_page(package, g, choice));
    print_row(choice.name(), choice.bytes_per_texel() * texels * static_cast<double>(m.groups.size()),
              errors);
  }
  for (const double most : {0.005, 0.01, 0.02, 0.05, 0.1}) {
    double megabytes = 0;
    std::vector<EncodingError> errors;
    for (std::size_t g = 0; g < m.groups.size(); ++g) {
      std::vector<Image> pages, receivers;
      for (int page = 0; page < m.pages; ++page) {
        pages.push_back(package.layer(g, page));
        receivers.push_back(package.receivers(page));
      }
      const std::vector<std::span<const Image>> coefficients{pages};
      const EncodingChoice choice = choose_encoding(coefficients, receivers, m.groups[g].mean_lux, most);
      megabytes += choice.bytes_per_texel() * texels;
      errors.push_back(worst_page(package, g, choice));
    }
    print_row(fmt::format("auto {:g} %", 100 * most), megabytes, errors);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw UsageError({}, "missing PACKAGE...: baked with --encoding f32");
    for (int i = 1; i < argc; ++i) print_table(argv[i]);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "encodings: {}\n", e.what());
    return 1;
  }
}
