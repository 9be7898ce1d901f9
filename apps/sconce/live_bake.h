// SPDX-License-Identifier: Apache-2.0
// A scene baked while somebody looks: a coarse package soon, then ever finer ones.
#pragma once

#include <filesystem>
#include <functional>

#include "core/progress.h"

namespace sconce::app {

/// @param publish  takes each package as it stands; all lie in one temporary folder, which is the taker's to
/// remove
void live_bake(const std::filesystem::path& scene, const Progress& progress,
               const std::function<void(std::filesystem::path)>& publish);

}  // namespace sconce::app
