// SPDX-License-Identifier: Apache-2.0
// L3D: a luminaire as OBJ parts, which of their faces shine, and how the parts hang together. A zip (.l3d) or
// its unpacked folder, by its structure.xml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/scratch_folder.h"
#include "core/text.h"
#include "import/import.h"
#include "import/l3d_obj.h"
#include "photometry/zip_file.h"
#include "scene/append.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr const char* kStructure = "structure.xml";
constexpr float kLumens = 1000;  // of all that shines: the format says none
constexpr int kSides = 64;       // of a disk
constexpr float kLift = 1e-4f;   // of an emitter above the face that it stands for, m

bool is_structure(const fs::path& path) {
  return lower(path.filename().string()) == kStructure;
}

/// A path inside that does not lead out of it.
bool is_inside(const fs::path& name) {
  if (name.is_absolute()) return false;
  for (const fs::path& part : name)
    if (part == "..") return false;
  return true;
}

/// Everything of a zip into a folder.
void unpack(const fs::path& path, const fs::path& to) {
  const ZipFile zip(path, "L3D");
  for (const std::string& name : zip.names()) {
    if (!is_inside(name)) throw Error(path.string(), "holds the file '" + name + "' outside of it");
    fs::create_directories((to / name).parent_path());
    write_file(to / name, zip.read(name));
  }
}

double area_of(const Scene& scene, const Instance& instance) {
  double area = 0;
  const Mesh& mesh = scene[instance.mesh];
  for (const Triangle& t : mesh.triangles) {
    Vec3 p[3];
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = Vec3(instance.transform * glm::vec4(mesh.positions[t.v[i]], 1));
    area += 0.5 * static_cast<double>(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
  }
  return area;
}

/// Turns faces round that look away from where their emitter shines.
void face(Mesh& mesh, const Mat4& transform, const Vec3& direction) {
  Vec3 normal(0);
  for (const Triangle& t : mesh.triangles)
    normal += glm::cross(mesh.positions[t.v[1]] - mesh.positions[t.v[0]],
                         mesh.positions[t.v[2]] - mesh.positions[t.v[0]]);
  if (glm::dot(Vec3(transform * glm::vec4(normal, 0)), direction) >= 0) return;
  for (Triangle& t : mesh.triangles) std::swap(t.v[1], t.v[2]);
  for (Vec3& n : mesh.normals) n = -n;
}

/// The emitter itself, for luminaires that say no faces.
Scene plate(const L3dEmitter& emitter) {
  Scene scene;
  Material material;
  material.name = l3d_material(0);
  scene.materials.push_back(material);
  Mesh mesh;
  mesh.material = Id<Material>(0);
  const int sides = emitter.round ? kSides : 4;
  for (int i = 0; i < sides; ++i) {
    const float a = 2 * kPi * (static_cast<float>(i) + 0.5f) / static_cast<float>(sides);
    const Vec2 at =
        emitter.round ? Vec2(std::cos(a), std::sin(a)) : Vec2(i == 0 || i == 3 ? 1 : -1, i < 2 ? 1 : -1);
    mesh.positions.emplace_back(0.5f * emitter.size * at, -kLift);
  }
  for (int i = 1; i + 1 < sides; ++i)
    mesh.triangles.push_back({{0, static_cast<uint32_t>(i + 1), static_cast<uint32_t>(i)}});  // towards -z
  scene.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.mesh = Id<Mesh>(0);
  scene.instances.push_back(std::move(instance));
  return scene;
}

class Builder {
 public:
  Builder(const fs::path& path, const Progress& progress) : path_(path), progress_(progress) {
    if (!is_structure(path)) unpack(path, scratch_.path());
    structure_ =
        parse_l3d(read_file(is_structure(path) ? path : scratch_.path() / kStructure), place(kStructure));
    if (is_structure(path))
      for (const auto& [id, geometry] : structure_.geometries)
        if (std::error_code ec; is_inside(id) && fs::is_directory(path.parent_path() / id, ec))
          fs::copy(path.parent_path() / id, scratch_.path() / id);
  }

  Scene run() {
    for (const L3dPart& part : structure_.parts) add(part);
    if (shining_.empty())
      for (const L3dEmitter& emitter : structure_.emitters)
        join(plate(emitter), upright_ * emitter.transform, emitter.name, {{emitter.name, emitter.name}});
    double weight = 0;
    for (const auto& [instance, intensity] : shining_)
      weight += intensity * area_of(scene_, scene_.instances[instance]);
    for (const auto& [instance, intensity] : shining_)
      material_of(instance).emission =
          Rgb(weight > 0 ? static_cast<float>(intensity * static_cast<double>(kLumens / kPi) / weight) : 0);
    if (!shining_.empty())
      progress_.warn(fmt::format(
          "{}: an L3D says no luminous flux: what shines in it gives {:g} lm together (luminaire field "
          "--lumens, or [emission] of a side file, say another)",
          path_.string(), kLumens));
    scene_.name =
        is_structure(path_) ? fs::absolute(path_).parent_path().filename().string() : path_.stem().string();
    return std::move(scene_);
  }

 private:
  std::string place(const std::string& file) const {
    return (is_structure(path_) ? path_.parent_path() / file : path_ / file).string();
  }

  void add(const L3dPart& part) {
    const L3dGeometry& geometry = structure_.geometries.at(part.geometry);
    const std::string name = part.geometry + "/" + geometry.file;
    if (!is_inside(name)) throw Error(place(kStructure), "names the file '" + name + "' outside of it");
    const fs::path file = scratch_.path() / name;
    if (std::error_code ec; !fs::is_regular_file(file, ec))
      throw Error(place(kStructure), "names the file '" + name + "', which is not there");
    // Beside its materials, which it names.
    const fs::path marked = file.parent_path() / fmt::format("sconce-{}.obj", parts_++);
    write_file(marked, marked_obj(read_file(file), part.surfaces, place(name)));
    Progress renamed = progress_;
    renamed.warning = [&](const std::string& line) {
      std::string said = line;
      if (said.starts_with(marked.string())) said = place(name) + said.substr(marked.string().size());
      progress_.warn(replaced(said));
    };
    Scene scene;
    try {
      scene = import_obj(marked, renamed);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& e) {
      throw Error(place(name), "cannot be read: " + replaced(e.what()));
    }
    std::vector<std::pair<std::string, std::string>> names;
    for (const L3dSurface& surface : part.surfaces) names.emplace_back(surface.name, surface.emitter);
    join(std::move(scene), upright_ * part.transform * glm::mat4(scaled(geometry.unit)), part.name, names,
         part.surfaces);
  }

  /// Without the folder that nobody knows.
  std::string replaced(std::string line) const {
    const std::string ours = scratch_.path().string() + "/";
    for (std::size_t at = line.find(ours); at != std::string::npos; at = line.find(ours))
      line.replace(at, ours.size(), "");
    return line;
  }
  static Mat4 scaled(double unit) {
    Mat4 out(static_cast<float>(unit));
    out[3][3] = 1;
    return out;
  }

  /// @param names  of surfaces and their emitters, by number of their material
  void join(Scene part, const Mat4& transform, const std::string& name,
            const std::vector<std::pair<std::string, std::string>>& names,
            const std::vector<L3dSurface>& surfaces = {}) {
    for (Instance& instance : part.instances) {
      instance.name = name;
      instance.transform = transform * instance.transform;
    }
    const std::size_t first = scene_.instances.size();
    append(scene_, std::move(part));
    for (std::size_t i = first; i < scene_.instances.size(); ++i)
      for (std::size_t k = 0; k < names.size(); ++k) {
        if (material_of(i).name != l3d_material(k)) continue;
        Instance& instance = scene_.instances[i];
        material_of(i).double_sided = false;  // as OBJ's are
        instance.name = names[k].first;
        for (const L3dEmitter& emitter : structure_.emitters)
          if (emitter.name == names[k].second)
            face(scene_.meshes[instance.mesh.value], instance.transform,
                 Vec3(upright_ * emitter.transform * glm::vec4(0, 0, -1, 0)));
        shining_.emplace_back(i, surfaces.empty() ? 1.0 : surfaces[k].intensity);
      }
  }
  Material& material_of(std::size_t instance) {
    return scene_.materials[scene_[scene_.instances[instance].mesh].material.value];
  }

  const fs::path& path_;
  const Progress& progress_;
  ScratchFolder scratch_;
  L3dStructure structure_;
  /// The luminaire's z is up: it hangs, nadir -y, C0 +x.
  const Mat4 upright_{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
  Scene scene_;
  std::vector<std::pair<std::size_t, double>> shining_;  ///< instances, their intensity
  int parts_ = 0;
};

}  // namespace

Scene import_l3d(const fs::path& path, const Progress& progress) {
  if (lower(path.extension().string()) != ".l3d" && !is_structure(path))
    throw NotMyFormat(path.string(), "is no L3D luminaire");
  return Builder(path, progress).run();
}

std::vector<fs::path> l3d_files(const fs::path& path) {
  if (lower(path.extension().string()) != ".l3d" && !is_structure(path))
    throw NotMyFormat(path.string(), "is no L3D luminaire");
  std::vector<fs::path> out;
  if (!is_structure(path)) return out;
  for (const auto& [id, geometry] : parse_l3d(read_file(path), path.string()).geometries)
    if (std::error_code ec; is_inside(id) && fs::is_directory(path.parent_path() / id, ec))
      for (const auto& entry : fs::directory_iterator(path.parent_path() / id))
        if (entry.is_regular_file()) out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

}  // namespace sconce
