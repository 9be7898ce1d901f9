// SPDX-License-Identifier: Apache-2.0
// OBJ: v, vt, vn, f, g, o, usemtl, mtllib (Wavefront, Advanced Visualizer, appendix B). Points, lines and
// smoothing groups say nothing about light; free-form surfaces are named.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/import.h"
#include "import/mtl.h"
#include "import/obj_parts.h"
#include "import/obj_text.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr std::size_t kBetweenChecks = 100000;  // statements

/// A word for a message, where it is fit to be shown.
std::string shown(std::string_view word) {
  const bool plain =
      word.size() < 40 && std::all_of(word.begin(), word.end(), [](char c) { return c > 32 && c < 127; });
  return plain ? "'" + std::string(word) + "'" : "what stands there";
}

class Reader {
 public:
  Reader(const fs::path& path, const Progress& progress) : path_(path), progress_(progress) {}

  std::vector<ObjParts::Part> read() {
    // Faces may stand before what they are made of.
    const std::string bytes = read_file(path_);
    each(bytes, "numbers", [&](const ObjStatement& s) { collect(s.keyword, s.rest); });
    each(bytes, "faces", [&](const ObjStatement& s) { build(s.keyword, s.rest); });
    if (free_form_) progress_.warn(path_.string() + ": free-form curves and surfaces are left out");
    return parts_.take();
  }

 private:
  std::string where() const { return path_.string() + ":" + std::to_string(line_); }

  template <class F>
  void each(const std::string& bytes, std::string_view stage, const F& f) {
    ObjText text(bytes);
    std::size_t n = 0;
    for (ObjStatement s; text.next(s);) {
      line_ = s.line;
      f(s);
      if (++n % kBetweenChecks != 0) continue;
      progress_.check();
      progress_.at(stage, text.done(), text.size());
    }
  }

  void collect(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      const auto [x, y, z] = numbers<3>(rest, 3);  // weights and colours may follow
      parts_.positions.emplace_back(x, y, z);
    } else if (keyword == "vt") {
      const auto [u, v] = numbers<2>(rest, 1);
      parts_.texcoords.emplace_back(u, 1 - v);  // row 0 of a picture is v = 0
    } else if (keyword == "vn") {
      const auto [x, y, z] = numbers<3>(rest, 3);
      parts_.normals.emplace_back(x, y, z);
    }
  }

  void build(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      ++before_.position;
    } else if (keyword == "vt") {
      ++before_.texcoord;
    } else if (keyword == "vn") {
      ++before_.normal;
    } else if (keyword == "f") {
      face(rest);
    } else if (keyword == "g" || keyword == "o") {
      parts_.set_name(rest);
    } else if (keyword == "usemtl") {
      parts_.set_material(rest);
    } else if (keyword == "surf" || keyword == "curv" || keyword == "curv2") {
      free_form_ = true;
    }
  }

  /// Missing ones are 0. @param least  so many must be there
  template <std::size_t N>
  std::array<float, N> numbers(std::string_view rest, std::size_t least) const {
    std::array<float, N> out{};
    for (std::size_t i = 0; i < N; ++i) {
      const std::string_view word = take_word(rest);
      if (word.empty() && i >= least) break;
      if (word.empty()) throw Error(where(), "has " + std::to_string(i) + " numbers", std::to_string(least));
      out[i] = number(word);
    }
    return out;
  }

  /// NaN for what programs write that divided by 0 (nan, inf, 1.#IND): triangles that use it are left out.
  float number(std::string_view word) const {
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const std::string_view left(end, static_cast<std::size_t>(digits.data() + digits.size() - end));
    if (code == std::errc::invalid_argument || (!left.empty() && left.front() != '#' && left.front() != '('))
      throw Error(where(), shown(word) + " is no number");
    const bool finite = code == std::errc() && left.empty() && std::abs(value) < 1e30;
    return finite ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
  }

  void face(std::string_view rest) {
    corners_.clear();
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const std::string_view whole = word;
      ObjCorner corner;
      struct {
        int64_t* to;
        std::size_t all;
        int64_t before;
      } const parts[] = {{&corner.position, parts_.positions.size(), before_.position},
                         {&corner.texcoord, parts_.texcoords.size(), before_.texcoord},
                         {&corner.normal, parts_.normals.size(), before_.normal}};
      bool more = true;
      for (const auto& [to, all, before] : parts) {
        if (!more) break;
        const std::size_t slash = word.find('/');
        const std::string_view part = word.substr(0, slash);
        const bool is_place = to == &corner.position;
        if (!part.empty() && (is_place || all > 0))  // others may be asked for where there are none
          *to = index(part, static_cast<int64_t>(all), before, whole);
        more = slash != std::string_view::npos;
        if (more) word.remove_prefix(slash + 1);
      }
      if (more || corner.position < 0)
        throw Error(where(), shown(whole) + " is no corner of a face", "v, v/vt, v//vn, v/vt/vn");
      corners_.push_back(corner);
    }
    if (corners_.size() >= 3) parts_.add_face(corners_);
  }

  /// From 1, or backwards from the face where it is negative.
  int64_t index(std::string_view part, int64_t all, int64_t before, std::string_view whole) const {
    int64_t i = 0;
    const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), i);
    if (code != std::errc() || end != part.data() + part.size())
      throw Error(where(), shown(whole) + " is no corner of a face", "v, v/vt, v//vn, v/vt/vn");
    if (i == 0 || i > all || i < -before)
      throw Error(where(), "index " + std::to_string(i) + " is out of range",
                  i < 0 ? "-" + std::to_string(before) + " to -1" : "1 to " + std::to_string(all));
    return i > 0 ? i - 1 : before + i;
  }

  const fs::path& path_;
  const Progress& progress_;
  ObjParts parts_;
  std::vector<ObjCorner> corners_;
  ObjCorner before_{0, 0, 0};  ///< so many stand before the face
  std::size_t line_ = 0;
  bool free_form_ = false;
};

/// By name; where several files have one, the last one's.
std::map<std::string, PlainMaterial> read_materials(const fs::path& path, const Progress& progress) {
  std::map<std::string, PlainMaterial> out;
  for (const fs::path& mtl : mtl_files(path)) {
    if (!is_file(mtl)) {
      progress.warn(path.string() + ": material file " + mtl.string() + " is missing; grey is used");
      continue;
    }
    for (PlainMaterial& m : parse_mtl(read_file(mtl))) out.insert_or_assign(m.name, m);
  }
  return out;
}

}  // namespace

Scene import_obj(const fs::path& path, const Progress& progress) {
  if (lower(path.extension().string()) != ".obj") throw NotMyFormat(path.string(), "is no OBJ file");
  std::vector<ObjParts::Part> parts = Reader(path, progress).read();
  if (parts.empty()) throw Error(path.string(), "has no faces");
  const std::map<std::string, PlainMaterial> known = read_materials(path, progress);
  Scene scene;
  scene.name = path.stem().string();
  PlainMaterials materials(
      path, [&](const std::string& name) { return picture_beside(path, name); }, scene, progress);
  std::map<std::string, Id<Material>> used;
  for (ObjParts::Part& part : parts) {
    const auto [at, is_new] = used.try_emplace(part.material, Id<Material>(scene.materials.size()));
    if (is_new) {
      const auto found = known.find(part.material);
      if (found == known.end() && !known.empty() && !part.material.empty())
        progress.warn(path.string() + ": material '" + part.material +
                      "' is in none of its material files; grey is used");
      PlainMaterial grey;
      grey.name = part.material, grey.diffuse = kUnsaidDiffuse;
      materials.add(found == known.end() ? grey : found->second);
    }
    Instance instance;
    instance.name = !part.name.empty() ? part.name : !part.material.empty() ? part.material : scene.name;
    instance.mesh = Id<Mesh>(scene.meshes.size());
    part.mesh.name = instance.name, part.mesh.material = at->second;
    scene.meshes.push_back(std::move(part.mesh));
    scene.instances.push_back(std::move(instance));
  }
  materials.drop_unused_textures();
  return scene;
}

}  // namespace sconce
