// SPDX-License-Identifier: Apache-2.0
#include "bake_plan.h"

#include <algorithm>

#include "core/error.h"
#include "package/manifest.h"

namespace sconce::app {

namespace {

/// What a kept layer needs beside its own files.
bool can_give(const Manifest& manifest) {
  const auto& files = manifest.hashes;
  if (files.count(std::string(kLayoutFile)) == 0) return false;
  for (int page = 0; page < manifest.pages; ++page)
    if (files.count(page_file(manifest.raw.empty() ? "noise" : "raw-noise", page)) == 0) return false;
  return true;
}

/// Halves give any encoding but full floats, and what met its error once meets it again.
bool fine_enough(const LayerInfo& layer, const std::string& encoding, double max_error) {
  if (layer.encoding == encoding || layer.encoding == "f32") return true;
  if (encoding == kAutoEncoding && layer.channel < 0 && layer.error.relative <= max_error) return true;
  return layer.encoding == "f16" && encoding != "f32" && encoding != "lum:f32";
}

bool fine_enough(const Package& package, std::size_t group, const std::string& encoding, double max_error) {
  const std::vector<LayerInfo>& files = package.layer_files();
  return std::all_of(files.begin(), files.end(), [&](const LayerInfo& layer) {
    return layer.group != group || fine_enough(layer, encoding, max_error);
  });
}

}  // namespace

BakePlan::BakePlan(const std::vector<std::string>& inputs, const std::vector<std::string>& encodings,
                   double max_error, const std::filesystem::path& package)
    : kept_(inputs.size()) {
  if (package.empty()) return;
  try {
    before_ = Package::open(package).solved();
  } catch (const Error&) {
    return;  // none, or one to replace
  }
  const Manifest& manifest = before_->manifest();
  if (!can_give(manifest)) return;
  for (std::size_t g = 0; g < inputs.size(); ++g)
    for (std::size_t old = 0; old < manifest.groups.size() && !kept_[g]; ++old)
      if (manifest.groups[old].inputs == inputs[g] && fine_enough(*before_, old, encodings[g], max_error))
        kept_[g] = old;
}

std::size_t BakePlan::count(bool solved) const {
  return static_cast<std::size_t>(
      std::count_if(kept_.begin(), kept_.end(), [&](const auto& k) { return k.has_value() != solved; }));
}

std::vector<uint8_t> BakePlan::wanted() const {
  std::vector<uint8_t> result;
  for (const auto& kept : kept_) result.push_back(kept ? 0 : 1);
  return result;
}

}  // namespace sconce::app
