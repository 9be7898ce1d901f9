// SPDX-License-Identifier: Apache-2.0
#include "picture_layers.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/error.h"
#include "core/text.h"

namespace sconce::app {

namespace {

struct Row {
  const char* name;
  bool LayerChoice::*chosen;
  std::vector<const char*> channels;  ///< of View::surfaces()
};
const std::array<Row, 6>& rows() {
  static const std::array<Row, 6> kRows{{{"groups", &LayerChoice::groups, {}},
                                         {"albedo", &LayerChoice::albedo, {"R", "G", "B"}},
                                         {"normal", &LayerChoice::normal, {"X", "Y", "Z"}},
                                         {"position", &LayerChoice::position, {"X", "Y", "Z"}},
                                         {"depth", &LayerChoice::depth, {"Z"}},
                                         {"id", &LayerChoice::id, {"ID"}}}};
  return kRows;
}

/// A group's name as a layer's: dots would nest it, digits alone and other layers' names mislead readers.
std::string layer_name(std::string name, const std::vector<std::string>& taken) {
  std::replace(name.begin(), name.end(), '.', '_');
  const bool digits = name.find_first_not_of("0123456789") == std::string::npos;
  const bool known = name == "rest" || std::any_of(rows().begin(), rows().end(),
                                                   [&](const Row& row) { return name == row.name; });
  if (digits || known) name.insert(0, "group_");
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += '_';
  return name;
}

class Collector {
 public:
  Collector(const Package& package, Stage& stage, const Camera& camera, const PictureParams& params,
            const Progress& progress)
      : package_(package), stage_(stage), camera_(camera), params_(params), progress_(progress) {}

  Image render(const MixSpec& mix) {
    stage_.draw(camera_, mix, mix_pages(package_, mix), params_, progress_);
    return stage_.linear();
  }
  void add(const Image& from, std::size_t first, const std::string& layer,
           std::span<const char* const> names) {
    for (std::size_t c = 0; c < names.size(); ++c) {
      channels_.push_back(layer.empty() ? names[c] : layer + "." + names[c]);
      std::vector<float> values(from.pixels());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = from.data[i * from.stride() + first + c];
      values_.push_back(std::move(values));
    }
  }
  std::size_t channels() const { return channels_.size(); }
  Image take() const {
    Image out(params_.width, params_.height, channels_);
    for (std::size_t c = 0; c < channels_.size(); ++c)
      for (std::size_t i = 0; i < out.pixels(); ++i) out.data[i * channels_.size() + c] = values_[c][i];
    return out;
  }

 private:
  const Package& package_;
  Stage& stage_;
  const Camera& camera_;
  const PictureParams& params_;
  const Progress& progress_;
  std::vector<std::string> channels_;
  std::vector<std::vector<float>> values_;
};

}  // namespace

LayerChoice parse_layers(const std::string& text) {
  LayerChoice out;
  std::vector<std::string> names;
  for (const Row& row : rows()) names.emplace_back(row.name);
  for (const std::string& part : split(text, ',')) {
    const std::string name = trim(part);
    const auto row = std::find_if(rows().begin(), rows().end(), [&](const Row& r) { return name == r.name; });
    if (row == rows().end())
      throw UsageError("option '--layers'", "unknown layer '" + name + "'", join(names, ", "));
    out.*row->chosen = true;
  }
  return out;
}

LayeredPicture picture_layers(const Package& package, Stage& stage, const Camera& camera, const MixSpec& mix,
                              const PictureParams& params, const LayerChoice& choice,
                              const Progress& progress) {
  constexpr std::array<const char*, 3> kRgb{"R", "G", "B"};
  Collector out(package, stage, camera, params, progress);
  std::vector<std::string> names;
  if (choice.groups) {
    const std::size_t count = mix.weights.size();
    const Image none = out.render({std::vector<Rgb>(count, Rgb(0))});
    Image beauty = none;
    std::vector<Image> groups;
    for (std::size_t g = 0; g < count; ++g) {
      MixSpec one{std::vector<Rgb>(count, Rgb(0))};
      one.weights[g] = mix.weights[g];
      groups.push_back(mix.weights[g].is_black() ? none : out.render(one));
      for (std::size_t i = 0; i < none.data.size(); ++i) beauty.data[i] += groups[g].data[i] -= none.data[i];
    }
    out.add(beauty, 0, "", kRgb);
    const std::vector<GroupInfo>& infos = package.manifest().groups;
    for (std::size_t g = 0; g < count; ++g) {
      names.push_back(layer_name(infos[g].name, names));
      out.add(groups[g], 0, names.back(), kRgb);
    }
    if (std::any_of(none.data.begin(), none.data.end(), [](float v) { return v != 0; })) {
      names.emplace_back("rest");
      out.add(none, 0, "rest", kRgb);
    }
  } else {
    out.add(out.render(mix), 0, "", kRgb);
  }
  LayeredPicture picture;
  picture.light = out.channels();
  if (choice.surfaces()) {
    const Image surfaces = stage.view()->surfaces(camera, params, progress);
    std::size_t first = 0;
    for (const Row& row : rows()) {
      if (choice.*row.chosen) out.add(surfaces, first, row.name, row.channels);
      first += row.channels.size();
    }
  }
  picture.image = out.take();
  if (choice.groups) picture.image.text["sconce:groups"] = join(names, "\n");
  if (choice.id) {
    std::string instances;
    for (const Instance& instance : stage.scene().instances) instances += instance.name + "\n";
    picture.image.text["sconce:ids"] = instances;
  }
  return picture;
}

}  // namespace sconce::app
