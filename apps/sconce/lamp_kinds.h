// SPDX-License-Identifier: Apache-2.0
// What a lamp may be, and what a lamp of the package may become: for `--light` and `--kind` of relight, and
// the window.
#pragma once

#include <variant>

#include "core/progress.h"
#include "gpu/lamp_shader.h"
#include "relight/lamp_move.h"
#include "scene/more_lights.h"

namespace sconce::app {

struct LampKind {
  std::string_view name;   ///< the first word
  std::string_view words;  ///< that a lamp becomes by a click; empty where a file is needed
  bool points = true;
  std::string_view strength;  ///< key that the flux of the lamp that was is told by; empty: its own
  std::string_view file;      ///< extensions of a file that makes one, with commas between
};
std::span<const LampKind> lamp_kinds();
/// Words of the kind that a file makes: `luminaire,file=lamp.ldt`; empty where it makes none.
std::string kind_of_file(const std::string& file);

/// What rays know, or a light shader.
using OtherKind = std::variant<MoreLights, gpu::LampShader>;

/// A lamp in the words of `--light`. @throws UsageError; Error where a file cannot be read
OtherKind parse_kind(const std::string& words, const std::string& where, const Progress& progress = {});

/// What a lamp becomes: where it stands or went, as it pointed, or downwards; of its own flux (a luminaire, a
/// sun: of theirs) and colour. What the words say stands instead.
/// @param words  without a place
OtherKind become(const Lamp& lamp, const LampPlace& at, const std::string& words, const std::string& where,
                 const Progress& progress = {});

}  // namespace sconce::app
