// SPDX-License-Identifier: Apache-2.0
// Where a package keeps its operators.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "package/package.h"
#include "transfer/operator.h"

namespace sconce {

/// NAME.sconce/operators/lightmap.bin, or camera-CAMERA.bin.
std::filesystem::path operator_path(const std::filesystem::path& package, const std::string& camera);

/// Of a camera's pixels that mirror: camera-CAMERA.lobes.bin.
std::filesystem::path lobes_path(const std::filesystem::path& package, const std::string& camera);

/// Whether there is one that is whole and of this state of the package.
bool has_operator(const Package& package, const std::string& camera);

/// The operator of a camera, or of the lightmap for an empty name.
/// @throws Error when there is none, naming those that there are; when it is damaged or of another state of
/// the package
Operator find_operator(const Package& package, const std::string& camera);

/// Its lobes, where its pixels mirror. @throws Error when they are damaged, or another operator's
std::optional<Operator> find_lobes(const Package& package, const Operator& op);

}  // namespace sconce
