// SPDX-License-Identifier: Apache-2.0
#include "mix/mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/text.h"
#include "image/io.h"
#include "image/primaries.h"
#include "mix/tone_lightmap.h"
#include "mix_picture.h"
#include "package/convention.h"
#include "picture_output.h"
#include "tone_options.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

struct Mixed {
  std::vector<GroupInfo> groups;
  MixSpec mix;
  std::vector<Image> pages;      ///< lux
  std::vector<Image8> lightmap;  ///< of the pages, where display codes are asked for
};

/// @param tone  when given: codes for a display, too
Mixed mix_package(const std::string& input, const MixOptions& settings, const Preset& preset,
                  const ToneOptions* tone, const Progress& progress) {
  Mixed out;
  const Package package = settings.open(input);
  out.groups = package.manifest().groups;
  out.mix = settings.make(preset, out.groups, progress);
  for (int page = 0; page < package.manifest().pages; ++page) {
    progress.check();
    progress.at("mix", static_cast<uint64_t>(page), static_cast<uint64_t>(package.manifest().pages));
    out.pages.push_back(mix_page(package, out.mix, page));
    out.pages.back().text["sconce:convention"] = lightmap_convention(package.manifest().lightmap_set);
  }
  if (tone != nullptr) {
    const Exposure exposure = tone->exposure_choice().resolve(meter(package, out.mix, out.pages));
    out.lightmap = tone_lightmap(out.pages, exposure, tone->mapper());
  }
  return out;
}

/// lightmap.exr; lightmap.0.exr, lightmap.1.exr, ... where there are several pages.
std::vector<std::string> output_files(const std::string& output, std::size_t pages) {
  if (pages == 1) return {output};
  const fs::path path(output);
  std::vector<std::string> files;
  for (std::size_t page = 0; page < pages; ++page)
    files.push_back(
        (path.parent_path() / fmt::format("{}.{}{}", path.stem().string(), page, path.extension().string()))
            .string());
  return files;
}

/// All pages are written before the first one is put in place.
/// @param write  writes a page to a path
void write_pages(const std::vector<std::string>& files,
                 const std::function<void(const fs::path&, std::size_t)>& write) {
  std::vector<std::unique_ptr<Beside>> written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    written.push_back(std::make_unique<Beside>(files[i]));
    written.back()->fill([&](const fs::path& path) { write(path, i); });
  }
  for (const auto& beside : written) beside->commit();
}

void write_page_to_stdout(const std::vector<Image>& pages) {
  if (pages.size() != 1)
    throw UsageError("option '--output'", "standard output takes one page, this package has several");
  const Beside file(fs::temp_directory_path() / "sconce-mix.exr");
  write_exr(file.path(), pages.front(), PixelType::full);
  write_stdout(read_file(file.path()));
}

/// What a mix did, for people or machines.
struct Report {
  std::vector<std::string> files;
  int width, height;
  const std::vector<GroupInfo>& groups;
  const MixSpec& mix;
};

void print(const Report& report, const Options& options, const std::string& input, double seconds) {
  if (options.json) {
    const nlohmann::ordered_json json = {
        {"input", input},
        {"output", report.files},
        {"width", report.width},
        {"height", report.height},
        {"groups", nlohmann::ordered_json::parse(weights_json(report.groups, report.mix))},
        {"seconds", seconds}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet && report.files.front() != "-") {
    fmt::print("{}: {} x {}, {} of {} groups lit, {:.1f} s\n",
               report.files.size() > 4 ? fmt::format("{} ... {}", report.files.front(), report.files.back())
                                       : join(report.files, ", "),
               report.width, report.height,
               std::count_if(report.mix.weights.begin(), report.mix.weights.end(),
                             [](const Rgb& w) { return !w.is_black(); }),
               report.groups.size(), seconds);
  }
}

}  // namespace

int run_mix(int argc, const char* const* argv) {
  const auto start = std::chrono::steady_clock::now();
  PictureMix job;
  MixOptions settings;
  ToneOptions tone;
  Options options(
      "mix",
      "Adds a package's layers with the groups' weights: one lightmap per page, linear in lux, or as codes "
      "for a display. Or those of another renderer's picture with light groups: the same picture under other "
      "lights.",
      {"sconce mix kitchen.sconce window=off -o lightmap.exr",
       "sconce mix 'shot.%04d.exr' --frames 1-100 key=2700K -o 'out.%04d.exr'",
       "sconce shader {PACKAGE} --target glsl330"});
  options.positional(
      "PACKAGE", &job.input,
      "NAME.sconce, or an OpenEXR picture with light groups as Blender Cycles, V-Ray, LuxCore and Arnold "
      "name them, or with layers GROUP.R, GROUP.G, GROUP.B");
  settings.declare(options);
  tone.declare(options);
  options.option(
      "-o,--output", &job.output,
      "OpenEXR, linear, or PNG: exposure and tone curve, of a package those of E/pi, for hardware without "
      "shaders; several pages get .0, .1, ... before the ending; - is OpenEXR on stdout");
  options.option(
      "--groups-from", &job.groups_from,
      "regular expression of the layers of a picture that are groups; what it captures is the group's name");
  options.option(
      "--frames", &job.frames,
      "FIRST-LAST: mixes a sequence of pictures; input and output have %04d (or %d) for the number; "
      "exposure is metered on the first");
  options.option("--colorspace", &job.colorspace,
                 "of an OpenEXR: rec709, acescg (default: of a package rec709, of a picture its own)");
  if (const auto code = options.parse(argc, argv)) return *code;
  if (job.output.empty()) throw UsageError({}, "missing -o FILE.exr or FILE.png: where to write the mix");
  check_output(job.output, {".exr", ".png"});
  const bool toned = lower(fs::path(job.output).extension().string()) == ".png";
  if (!toned && !(tone.exposure.empty() && tone.ev100.empty() && tone.curve.empty()))
    throw UsageError({}, "--exposure, --ev100 and --tone need -o FILE.png: an OpenEXR mix stays linear");
  const bool acescg = !job.colorspace.empty() && is_acescg(job.colorspace, !toned);
  const Preset preset = settings.preset();
  tone.apply(preset);
  tone.check();
  if (job.output == "-" && options.json) throw UsageError({}, "-o - and --json both want standard output");

  const ThreadLimit threads(options.threads);
  const auto report = [&](const Report& done) {
    print(done, options, job.input,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  const bool is_picture = lower(fs::path(job.input).extension().string()) == ".exr";
  if (!job.frames.empty() || is_picture || fs::is_regular_file(job.input)) {
    const MixedPictures mixed = mix_pictures(job, settings, preset, tone, make_progress(options));
    report({mixed.files, mixed.width, mixed.height, mixed.groups, mixed.mix});
    return kDone;
  }
  if (!job.groups_from.empty())
    throw UsageError("option '--groups-from'", job.input + " is no picture", "an OpenEXR picture");
  Mixed mixed;
  std::vector<std::string> files;
  {
    const Progress progress = make_progress(options);
    mixed = mix_package(job.input, settings, preset, toned ? &tone : nullptr, progress);
    files = output_files(job.output, mixed.pages.size());
    if (acescg)
      for (Image& page : mixed.pages) to_acescg(page);
    if (job.output == "-")
      write_page_to_stdout(mixed.pages);
    else
      write_pages(files, [&](const fs::path& path, std::size_t page) {
        toned ? write_png(path, mixed.lightmap[page]) : write_exr(path, mixed.pages[page], PixelType::full);
      });
  }
  report({files, mixed.pages.front().width, mixed.pages.front().height, mixed.groups, mixed.mix});
  if (job.output != "-") options.next({job.input});
  return kDone;
}

}  // namespace sconce::app
