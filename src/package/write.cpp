// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/files.h"
#include "core/finite.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/text.h"
#include "encode/choice.h"
#include "encode/layer_texture.h"
#include "image/io.h"
#include "package/glb.h"
#include "package/layer_file.h"
#include "package/manifest.h"
#include "package/points.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

// A package replaces a package; whatever else stands under the name is not ours to remove.
void check_target(const fs::path& path) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (fs::is_directory(path, ec)) {
    if (fs::is_empty(path, ec)) return;
    if (is_package(path)) return;
  }
  throw Error(path.string(), "exists and is no sconce package; it is left alone");
}

void check_page(const Image& image, const Manifest& m, std::size_t channels, const char* what) {
  if (image.width != m.width || image.height != m.height || image.stride() != channels)
    throw Error({}, std::string(what) + " image does not have the atlas's size or channels");
}

void check(const PackageContents& c) {
  const Manifest& m = c.manifest;
  const auto pages = static_cast<std::size_t>(m.pages);
  const std::size_t layers = m.groups.size() * coefficients(m.basis);
  if (c.layers.size() != layers || c.encodings.size() != m.groups.size() || c.receivers.size() != pages ||
      (!c.noise.empty() && c.noise.size() != pages))
    throw Error({}, "the package's images do not match its groups and pages");
  for (std::size_t g = 0; g < c.layers.size(); ++g) {
    if (c.layers[g].size() != pages) throw Error({}, "a light group's layer misses a page");
    for (const Image& image : c.layers[g]) check_page(image, m, 3, "a layer's");
  }
  for (const Image& image : c.receivers) check_page(image, m, 4, "the receivers'");
  if (!c.raw.empty() && (c.raw.size() != layers || c.raw_noise.size() != pages))
    throw Error({}, "the package's raw layers do not match its groups and pages");
  for (const std::vector<Image>& group : c.raw) {
    if (group.size() != pages) throw Error({}, "a light group's raw layer misses a page");
    for (const Image& image : group) check_page(image, m, 3, "a raw layer's");
  }
  for (const Image& image : c.raw_noise) check_page(image, m, m.groups.size(), "the raw noise");
  for (const Image& image : c.noise) check_page(image, m, m.groups.size(), "the noise");
  if (m.instance_pages.size() != c.scene.instances.size() ||
      m.instance_twins.size() != c.scene.instances.size())
    throw Error({}, "the package's instance tables do not match its scene");
}

/// What is not finite never enters a package: one such texel spoils every mix that it is in.
/// @param what  of a channel, for the message
void check_finite(const Image& image, const fs::path& file, std::size_t page,
                  const std::function<std::string(std::size_t channel)>& what) {
  const auto at = first_not_finite(image.data);
  if (!at) return;
  const std::size_t pixel = *at / image.stride(), width = static_cast<std::size_t>(image.width);
  throw Error(file.string(), what(*at % image.stride()) + " is " +
                                 (std::isnan(image.data[*at]) ? "not a number" : "infinite") + " at texel (" +
                                 std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
                                 ") of page " + std::to_string(page));
}

float largest(std::span<const Image> images) {
  float most = 0;
  for (const Image& image : images)
    for (const float v : image.data) most = std::max(most, std::abs(v));
  return most;
}

// Radiance of a sky, its strength multiplied in; a constant sky is one pixel.
Image sky_image(const Light& light) {
  Image image = std::get<SkyLight>(light.shape).image;
  if (image.data.empty()) {
    image = Image::rgb(1, 1);
    image.set_rgb(0, 0, Rgb(1));
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, image.rgb_at(x, y) * light.intensity);
  image.text = {{"sconce:unit", "cd/m2"}};
  return image;
}

/// Files are never written in place, so two packages may share one.
void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code ec;
  fs::create_hard_link(from, to, ec);
  if (ec) fs::copy_file(from, to);
}

/// One file of the package: how to write it, and which layers it holds.
struct Job {
  fs::path file;
  std::function<void(const fs::path&)> write;
  std::vector<LayerInfo*> layers{};
  std::string hash{};
  uint64_t bytes = 0;
};

class Writer {
 public:
  Writer(PackageContents& contents, const std::map<std::string, Image>& points)
      : c_(contents), m_(contents.manifest) {
    names_ = layer_names(m_.groups);
    add_layers(c_.layers, kLayerFolder, m_.layers);
    if (!c_.raw.empty()) add_layers(c_.raw, kRawFolder, m_.raw);
    add_pages();
    add_sky();
    for (const auto& [name, image] : points)
      jobs_.push_back({name, [&image](const fs::path& f) {
                         check_finite(image, f, 0, [&](std::size_t c) { return image.channels[c]; });
                         write_exr(f, image, PixelType::full);
                       }});
    jobs_.push_back(
        {"scene.glb", [this](const fs::path& f) { write_file(f, write_glb(c_.scene, m_.generator)); }});
    if (!c_.layout.empty())
      jobs_.push_back({kLayoutFile, [this](const fs::path& f) { write_file(f, c_.layout); }});
  }

  void run(const fs::path& folder) {
    fs::create_directory(folder);
    fs::create_directory(folder / kLayerFolder);
    if (!c_.raw.empty()) fs::create_directory(folder / kRawFolder);
    parallel_for(jobs_.size(), 1, [&](std::size_t i) {
      Job& job = jobs_[i];
      job.write(folder / job.file);
      job.hash = hash_file(folder / job.file);
      job.bytes = fs::file_size(folder / job.file);
    });
    m_.hashes.clear();
    for (const Job& job : jobs_) {
      for (LayerInfo* layer : job.layers) layer->hash = job.hash, layer->bytes = job.bytes;
      if (job.layers.empty()) m_.hashes[job.file.string()] = job.hash;
    }
    write_file(folder / kManifestFile, print_manifest(m_));
  }

 private:
  /// One for all coefficients. What a solver gave is kept in floats where the denoiser's result is not.
  EncodingChoice encoding_of(std::size_t g, const std::vector<std::vector<Image>>& layers, bool raw) const {
    std::vector<std::span<const Image>> pages;  // per coefficient
    for (std::size_t l = g; l < layers.size(); l += m_.groups.size()) pages.emplace_back(layers[l]);
    EncodingChoice choice;
    if (c_.encodings[g] == kAutoEncoding)
      choice = raw ? parse_encoding("f16")
                   : choose_encoding(pages, c_.receivers, m_.groups[g].mean_lux, c_.max_error);
    else
      choice = parse_encoding(c_.encodings[g]);
    if (pages.size() > 1 && !signed_encoding(choice))
      throw Error({}, "the encoding " + choice.name() + " cannot hold the basis " +
                          std::string(basis_row(m_.basis).name));
    if (raw && choice.encoding->name != "f32") choice = parse_encoding("f16");
    // Direct sun exceeds what halves hold: such a layer is kept in full floats rather than clipped.
    const bool fits = choice.encoding->has_gain ||
                      std::all_of(pages.begin(), pages.end(),
                                  [&](const auto& p) { return largest(p) <= choice.encoding->largest; });
    return fits ? choice : EncodingChoice{&find_encoding("f32"), choice.luminance};
  }

  void add_layers(std::vector<std::vector<Image>>& layers, std::string_view folder,
                  std::vector<LayerInfo>& listed) {
    const bool raw = &layers == &c_.raw, own = raw == !c_.raw.empty();
    std::vector<EncodingChoice> encodings;
    const std::size_t groups = m_.groups.size(), pages = static_cast<std::size_t>(m_.pages);
    for (std::size_t g = 0; g < groups; ++g) encodings.push_back(encoding_of(g, layers, raw));
    listed.assign(layers.size() * pages, {});  // per layer and page; jobs point into it
    std::vector<LayerTexture> textures;
    for (std::size_t c = 0; c < coefficients(m_.basis); ++c)
      for (LayerTexture& texture : share_textures(encodings)) {
        texture.coefficient = c;
        textures.push_back(std::move(texture));
      }
    std::map<std::string, int> packs;
    for (const LayerTexture& texture : textures) {
      const std::size_t g = texture.groups.front(), first = texture.coefficient * groups;
      if (own && !texture.encoding.luminance && g < c_.kept.size() && c_.kept[g] &&
          keep_files(g, *c_.kept[g], texture, folder, &listed[(first + g) * pages]))
        continue;
      std::string stem =
          safe_file_name(m_.groups[g].name) + std::string(coefficient_suffix(texture.coefficient));
      if (texture.encoding.luminance) {
        const std::string name = "lum-" + std::string(texture.encoding.encoding->name);
        stem = safe_file_name(name + "." + std::to_string(packs[name]++));
      }
      for (std::size_t page = 0; page < pages; ++page) {
        const std::string file =
            page_file(stem, static_cast<int>(page), layer_extension(*texture.encoding.encoding));
        Job job{fs::path(folder) / file, {}};
        for (std::size_t i = 0; i < texture.groups.size(); ++i) {
          LayerInfo& layer = listed[(first + texture.groups[i]) * pages + page];
          layer.group = static_cast<uint32_t>(texture.groups[i]);
          layer.page = static_cast<int>(page);
          layer.coefficient = texture.coefficient;
          layer.encoding = texture.encoding.name();
          layer.file = file;
          if (texture.encoding.luminance) layer.channel = static_cast<int>(i);
          job.layers.push_back(&layer);
        }
        job.write = [this, &layers, texture, page, infos = job.layers](const fs::path& f) {
          write_texture(f, layers, texture, page, infos);
        };
        jobs_.push_back(std::move(job));
      }
    }
  }

  /// Encodes, measures what that loses, writes.
  void write_texture(const fs::path& file, const std::vector<std::vector<Image>>& layers,
                     const LayerTexture& texture, std::size_t page,
                     const std::vector<LayerInfo*>& infos) const {
    std::vector<const Image*> images;
    for (const std::size_t g : texture.groups)
      images.push_back(&layers[texture.coefficient * m_.groups.size() + g][page]);
    for (std::size_t i = 0; i < images.size(); ++i)
      check_finite(*images[i], file, page, [&](std::size_t) {
        return "layer '" + m_.groups[texture.groups[i]].name + "'" +
               std::string(coefficient_suffix(texture.coefficient));
      });
    const EncodedImage encoded = texture.encode(images);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const std::size_t g = texture.groups[i];
      infos[i]->gain = encoded.gain[texture.encoding.luminance ? i : 0];
      const Image decoded = texture.decode(encoded, i, m_.groups[g].color);
      const double mean = m_.groups[g].mean_lux;
      infos[i]->error =
          texture.coefficient == 0
              ? measure_encoding(*images[i], decoded, c_.receivers[page], mean)
              : measure_component(*images[i], decoded, layers[g][page], c_.receivers[page], mean);
    }
    std::map<std::string, std::string> text;
    if (!texture.encoding.luminance) text["sconce:group"] = m_.groups[texture.groups.front()].name;
    const std::vector<std::string> names = layer_names(m_.groups, texture.coefficient);
    write_layer_file(file, encoded, texture.channels(names), std::move(text));
  }

  /// The files of a kept layer as they are; false where they must be written anew.
  bool keep_files(std::size_t g, const KeptLayer& kept, const LayerTexture& texture, std::string_view folder,
                  LayerInfo* listed) {
    const Package from = kept.from->solved();
    const std::vector<GroupInfo>& groups = from.manifest().groups;
    const auto info = [&](int page) { return from.layer_info(kept.group, page, texture.coefficient); };
    // The name is in the files, too.
    if (groups[kept.group].name != m_.groups[g].name || layer_names(groups)[kept.group] != names_[g] ||
        info(0).encoding != texture.encoding.name())
      return false;
    for (int page = 0; page < m_.pages; ++page) {
      listed[page] = info(page);
      listed[page].group = static_cast<uint32_t>(g);
      const fs::path old = from.layer_folder() / listed[page].file;
      jobs_.push_back({fs::path(folder) / listed[page].file,
                       [old](const fs::path& f) { link_or_copy(old, f); },
                       {&listed[page]}});
    }
    return true;
  }

  void add_pages() {
    for (int page = 0; page < m_.pages; ++page) {
      const auto i = static_cast<std::size_t>(page);
      c_.receivers[i].channels = {"albedo.R", "albedo.G", "albedo.B", "weight"};
      jobs_.push_back({page_file("receivers", page), [this, i](const fs::path& f) {
                         const Image& image = c_.receivers[i];
                         check_finite(image, f, i, [&](std::size_t c) { return image.channels[c]; });
                         write_exr(f, image, PixelType::full);
                       }});
      for (auto& [images, stem] : {std::pair(&c_.noise, "noise"), {&c_.raw_noise, "raw-noise"}}) {
        if (images->empty() || m_.groups.empty()) continue;
        Image& image = (*images)[i];
        image.channels = names_;
        jobs_.push_back({page_file(stem, page), [this, &image, i](const fs::path& f) {
                           check_finite(image, f, i, [&](std::size_t g) {
                             return "noise of '" + m_.groups[g].name + "'";
                           });
                           write_exr(f, image, PixelType::half);
                         }});
      }
    }
  }

  void add_sky() {
    std::size_t count = 0;
    for (const Light& light : c_.scene.lights) {
      if (!std::holds_alternative<SkyLight>(light.shape)) continue;
      jobs_.push_back({sky_file(count++), [&light](const fs::path& f) {
                         const Image image = sky_image(light);
                         check_finite(image, f, 0, [](std::size_t) { return "the sky"; });
                         const bool fits = largest({&image, 1}) <= find_encoding("f16").largest;
                         write_exr(f, image, fits ? PixelType::half : PixelType::full);
                       }});
    }
  }

  PackageContents& c_;
  Manifest& m_;
  std::vector<std::string> names_;
  std::vector<Job> jobs_;
};

/// Operators that the standing package has stay where they still fit: geometry, materials and texels are the
/// same.
void keep_operators(const fs::path& before, const Manifest& now, const fs::path& folder) {
  if (!is_package(before) || !fs::is_directory(before / kOperatorFolder)) return;
  Manifest was;
  try {
    was = Package::open(before, false).manifest();
  } catch (const Error&) {
    return;  // damaged, and about to be replaced
  }
  const auto same = [&](const std::string& file) {
    const auto a = was.hashes.find(file);
    const auto b = now.hashes.find(file);
    return a != was.hashes.end() && b != now.hashes.end() && a->second == b->second;
  };
  if (!same("scene.glb") || !same(std::string(kLayoutFile))) return;
  fs::create_directory(folder / kOperatorFolder);
  for (const auto& entry : fs::directory_iterator(before / kOperatorFolder))
    if (entry.path().extension() == ".bin")
      link_or_copy(entry.path(), folder / kOperatorFolder / entry.path().filename());
}

}  // namespace

void write_package(const fs::path& path, PackageContents contents) {
  write_package(path, std::move(contents), {});
}

void write_package(const fs::path& path, PackageContents contents,
                   const std::map<std::string, Image>& points) {
  check_target(path);
  check(contents);
  Writer writer(contents, points);
  Beside beside(path);
  beside.fill([&](const fs::path& folder) {
    writer.run(folder);
    keep_operators(path, contents.manifest, folder);
  });
  beside.commit();
}

}  // namespace sconce
