// SPDX-License-Identifier: Apache-2.0
// `sconce info` of another renderer's picture.
#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "info.h"
#include "mix/layered_image.h"
#include "table.h"

namespace sconce::app {

namespace {

/// Cryptomatte's twelve channels as three: "Object00.rgba".
std::vector<std::string> by_layer(const std::vector<std::string>& channels) {
  std::vector<std::string> layers;
  std::string last;
  for (const std::string& channel : channels) {
    const std::size_t leaf = channel.rfind('.') + 1;
    const std::string layer = channel.substr(0, leaf);
    if (leaf > 0 && layer == last && channel.size() == leaf + 1)
      layers.back() += channel[leaf];
    else
      layers.push_back(channel);
    last = channel.size() == leaf + 1 ? layer : "";
  }
  return layers;
}

}  // namespace

InfoReport picture_info(const std::filesystem::path& path, const std::string& groups_from) {
  const LayeredImage layered = find_layers(read_exr_parts(path), path.string(), groups_from);
  const Image& image = layered.picture.image;
  const Rest rest = measure_rest(layered);
  const ExrWindow& display = layered.picture.display;
  InfoReport report;
  report.text = fmt::format(
      "picture       {}\nsize          {} x {}, data {} x {} at {}, {}\nnames         {}\n", path.string(),
      display.width, display.height, image.width, image.height, layered.picture.data.x,
      layered.picture.data.y, layered.renderer.empty() ? "of the layers" : layered.renderer);
  report.json = {{"picture", path.string()},
                 {"width", display.width},
                 {"height", display.height},
                 {"names", layered.renderer},
                 {"groups", nlohmann::ordered_json::array()}};
  Table table({{"GROUP"}, {"MEAN", Table::Align::right}, {"LAYER"}});
  for (std::size_t g = 0; g < layered.channels.size(); ++g) {
    double mean = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const float* p = &image.data[i * image.stride()];
      const auto& c = layered.channels[g];
      mean += luminance(Rgb(p[c[0]], p[c[1]], p[c[2]])) / static_cast<double>(image.pixels());
    }
    table.add({layered.groups[g].name, fmt::format("{:.4g}", mean), layered.layers[g]});
    report.json["groups"].push_back(
        {{"name", layered.groups[g].name}, {"mean", mean}, {"layer", layered.layers[g]}});
  }
  report.text += fmt::format("light groups  {}\n", layered.channels.size()) + table.text();
  if (layered.beauty) {
    report.text +=
        rest.share < -0.5e-4
            ? fmt::format("rest          '{}': the groups have {:.2f} % more light than the whole picture\n",
                          layered.groups.back().name, -100 * rest.share)
            : fmt::format("rest          {:.2f} % of the light is in no group: '{}'\n",
                          100 * std::max(rest.share, 0.0), layered.groups.back().name);
    if (rest.negative > 0)
      report.text += fmt::format("              negative in {:.3g} % of the pixels\n", 100 * rest.negative);
    report.json["rest"] = {
        {"name", layered.groups.back().name}, {"share", rest.share}, {"negative", rest.negative}};
  } else {
    report.text += "rest          not known: there is no picture of all lights\n";
  }
  std::vector<std::string> others;
  for (const std::size_t c : layered.others) others.push_back(image.channels[c]);
  if (!others.empty()) report.text += fmt::format("others        {}\n", join(by_layer(others), ", "));
  report.json["others"] = others;
  return report;
}

}  // namespace sconce::app
