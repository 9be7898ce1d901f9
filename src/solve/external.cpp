// SPDX-License-Identifier: Apache-2.0
#include "solve/external.h"

#include <fmt/format.h>

#include "core/files.h"
#include "core/program.h"
#include "core/text.h"
#include "image/io.h"

namespace sconce {

namespace fs = std::filesystem;

namespace {

/// The last lines of what a program said on standard error, as one.
std::string last_words(const fs::path& file) {
  constexpr std::size_t kLines = 3, kLongest = 400;
  std::vector<std::string> lines;
  for (const std::string& line : split(read_file(file), '\n'))
    if (std::string text = trim(line); !text.empty()) lines.push_back(std::move(text));
  if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
  std::string all = join(lines, " / ");
  if (all.size() > kLongest) all = "..." + all.substr(all.size() - kLongest);
  return all;
}

class ExternalSolver final : public Solver {
 public:
  ExternalSolver(const SolveContext& context, const BakeParams& params, const Progress& progress)
      : context_(context),
        command_(params.command),
        words_(command_words(params.command)),
        page_texels_(static_cast<std::size_t>(context.atlas->width) *
                     static_cast<std::size_t>(context.atlas->height)),
        pages_(context.scene.groups.size()) {
    const std::vector<GroupFlux> fluxes = group_flux(context.scene, context.lamps);
    for (uint32_t g = 0; g < pages_.size(); ++g) {
      const Id<LightGroup> group(g);
      if (!context.wants(group)) continue;
      progress.at("external", g, pages_.size());
      progress.check();
      const fs::path folder = params.work_folder / safe_file_name(context.scene[group].name);
      run(group, write_external_job(context, params, group, folder), fluxes[g], progress);
    }
    progress.at("external", pages_.size(), pages_.size());
    std::error_code not_empty;
    fs::remove(params.work_folder, not_empty);
  }

  void solve(const Footprint& receiver, std::span<GroupValue> out) const override {
    if (receiver.kind != ReceiverKind::texel)
      throw Error("solver external", "answers for texels of a lightmap only");
    const std::size_t page = receiver.id / page_texels_, texel = receiver.id % page_texels_;
    for (std::size_t g = 0; g < out.size(); ++g)
      out[g] = {pages_[g].empty() ? Rgb() : pages_[g][page][texel], 0};
  }

 private:
  /// Starts the program for one group and takes what it wrote. Its folder goes, unless the program failed.
  void run(Id<LightGroup> group, const ExternalJob& job, const GroupFlux& flux, const Progress& progress) {
    const std::string where = "group '" + context_.scene[group].name + "': command '" + command_ + "'";
    const fs::path err = job.folder / "stderr.txt";
    const auto kept = [&] { return "; files kept in " + job.folder.string(); };
    std::vector<std::string> words = words_;
    words.push_back(job.file.string());
    std::error_code ignored;
    const auto discard = [&] {
      fs::remove_all(job.folder, ignored);
      fs::remove(job.folder.parent_path(), ignored);
    };
    int code = 0;
    try {
      code = run_program(words, job.folder / "stdout.txt", err, progress);
    } catch (const Cancelled&) {
      discard();
      throw;
    } catch (const Error& error) {
      discard();
      throw Error(where, error.what());
    }
    const std::string said = last_words(err);
    if (code != 0)
      throw Error(where, fmt::format("ended with {} {}{}{}", code > 128 ? "signal" : "exit code",
                                     code > 128 ? code - 128 : code,
                                     said.empty() ? ", saying nothing" : ": " + said, kept()));
    try {
      read_pages(group, job, flux);
    } catch (const Error& error) {
      throw Error(where, error.what() + (said.empty() ? "" : "; it said: " + said) + kept());
    }
    fs::remove_all(job.folder, ignored);
  }

  void read_pages(Id<LightGroup> group, const ExternalJob& job, const GroupFlux& flux) {
    const int width = context_.atlas->width, height = context_.atlas->height;
    auto& pages = pages_[group.value];
    for (const fs::path& file : job.outputs) {
      if (!fs::exists(file)) throw Error(file.string(), "was not written");
      const Image image = read_exr(file);
      if (image.width != width || image.height != height)
        throw Error(file.string(), fmt::format("is {} x {}", image.width, image.height),
                    fmt::format("{} x {}", width, height));
      const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
      if (r < 0 || g < 0 || b < 0) throw Error(file.string(), "lacks a channel", "R, G, B");
      if (const auto unit = image.text.find("sconce:unit"); unit != image.text.end() && unit->second != "lux")
        throw Error(file.string(), "is in '" + unit->second + "'", "lux");
      pages.emplace_back(page_texels_);
      for (std::size_t i = 0; i < page_texels_; ++i) {
        const float* pixel = &image.data[i * image.stride()];
        pages.back()[i] = Rgb(pixel[r], pixel[g], pixel[b]);
      }
    }
    check(job, pages, flux);
  }

  /// Only what is under a receiver counts: a program may leave anything in gutters.
  void check(const ExternalJob& job, const std::vector<std::vector<Rgb>>& pages,
             const GroupFlux& flux) const {
    bool light = false;
    for (std::size_t i = 0; i < context_.receivers->size(); ++i) {
      const std::size_t page = context_.receivers->texel(i) / page_texels_,
                        texel = context_.receivers->texel(i) % page_texels_;
      const Rgb& e = pages[page][texel];
      for (const float v : {e.r, e.g, e.b}) {
        if (std::isfinite(v) && v >= 0) continue;
        const std::size_t width = static_cast<std::size_t>(context_.atlas->width);
        throw Error(job.outputs[page].string(),
                    fmt::format("holds {} at texel ({}, {})", v, texel % width, texel / width),
                    "lux, finite and not negative");
      }
      light = light || !e.is_black();
    }
    if (!light && (flux.infinite || flux.lumens > 0))
      throw Error(job.outputs.front().string(), "is black, though the group's lamps shine");
  }

  SolveContext context_;
  std::string command_;
  std::vector<std::string> words_;
  std::size_t page_texels_;
  std::vector<std::vector<std::vector<Rgb>>> pages_;  ///< group, page, texel; lux. No page: not wanted
};

}  // namespace

std::unique_ptr<Solver> make_external_solver(const SolveContext& context, const BakeParams& params,
                                             const Progress& progress) {
  if (params.command.empty()) throw UsageError("--solver", "external needs a program", "external:CMD");
  if (context.atlas == nullptr || context.receivers == nullptr)
    throw Error("solver external", "needs a lightmap atlas: it answers for texels only");
  return std::make_unique<ExternalSolver>(context, params, progress);
}

}  // namespace sconce
