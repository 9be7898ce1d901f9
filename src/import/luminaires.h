// SPDX-License-Identifier: Apache-2.0
// Photometric files and light fields as lamps of a scene, whoever names them: a side file or glTF.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

namespace sconce {

/// Photometric files and light fields (.exr) read so far; lamps of one file share its data.
class LuminaireFiles {
 public:
  LuminaireFiles(Scene& scene, const Progress& progress) : scene_(scene), progress_(progress) {}

  /// Reads the file once; what its reader found odd becomes warnings. @throws Error: not there, damaged
  Id<Luminaire> load(const std::filesystem::path& file);
  /// From memory. @param name  what it is called in warnings and errors
  Id<Luminaire> add(const std::string& name, Photometry photometry);

 private:
  Scene& scene_;
  const Progress& progress_;
  std::map<std::filesystem::path, Id<Luminaire>> known_;
};

/// How strong a luminaire is set: what stands here replaces what its file says.
struct LuminaireStrength {
  std::optional<double> flux;  ///< lm
  Rgb color{1.0f};             ///< luminance 1
  double dim = 1;
  std::optional<double> exact_below;  ///< LuminaireLight's
};

/// A lamp from a luminaire: its Light::intensity, with LM-63's TILT by how far nadir is from the world's down
/// (-y).
/// @throws Error (naming `where`) where a flux is asked of a luminaire without light, or exact_below of a
/// table
Light make_luminaire_light(const Scene& scene, Id<Luminaire> luminaire, const Mat4& frame,
                           const LuminaireStrength& strength, const std::string& where);

/// The file beside a scene that `name` means: itself, or without the ".001" that modellers append; nothing
/// where there is none.
std::optional<std::filesystem::path> find_luminaire_file(const std::filesystem::path& folder,
                                                         const std::string& name);

/// The file that a glTF node names as "ies:lamp.ldt", "" for other nodes.
std::string luminaire_of_node_name(const std::string& name);

}  // namespace sconce
