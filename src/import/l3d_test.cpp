// SPDX-License-Identifier: Apache-2.0
// L3D luminaires: the public examples, and containers made here.
#include <gtest/gtest.h>
#include <zip.h>

#include "core/error.h"
#include "core/test_data.h"
#include "core/test_folder.h"
#include "import/import.h"

namespace sconce {
namespace {

/// A plate of 2 x 1 units that looks up, and one below it that looks down.
const char* kPlates =
    "v 1 0.5 0\nv -1 0.5 0\nv -1 -0.5 0\nv 1 -0.5 0\nv 1 0.5 -1\nv -1 0.5 -1\nv -1 -0.5 -1\nv 1 -0.5 -1\n"
    "g body\nf 1 2 3 4\ng glass\nf 8 7 6 5\n";

std::string structure(const std::string& geometry, const std::string& units = "cm") {
  return "<?xml version=\"1.0\"?>\n<Luminaire><Header/>\n<GeometryDefinitions>\n<GeometryFileDefinition "
         "id=\"a\" "
         "filename=\"a.obj\" units=\"" +
         units + "\"/>\n</GeometryDefinitions>\n<Structure>\n" + geometry + "</Structure></Luminaire>\n";
}
std::string part(const std::string& inside, const std::string& rotation = "x=\"0\" y=\"0\" z=\"0\"") {
  return "<Geometry partName=\"case\"><Position x=\"0\" y=\"0\" z=\"0.2\"/><Rotation " + rotation +
         "/>\n<GeometryReference geometryId=\"a\"/>\n" + inside + "</Geometry>\n";
}
const std::string kEmitter =
    "<LightEmittingObjects><LightEmittingObject partName=\"leo\"><Position x=\"0\" y=\"0\" "
    "z=\"-0.01\"/><Rotation x=\"0\" y=\"0\" z=\"0\"/><Rectangle sizeX=\"0.02\" "
    "sizeY=\"0.01\"/></LightEmittingObject></LightEmittingObjects>\n";
std::string surface(const std::string& faces) {
  return kEmitter +
         "<LightEmittingSurfaces><LightEmittingSurface partName=\"les\"><LightEmittingObjectReference "
         "lightEmittingPartName=\"leo\"/>\n<FaceAssignments>" +
         faces + "</FaceAssignments></LightEmittingSurface></LightEmittingSurfaces>\n";
}
const std::string kGlass = "<FaceAssignment groupIndex=\"1\" faceIndex=\"0\"/>";

/// What shines: flux (lm), mean normal weighted by area, how many instances, their corners' mean.
struct Shining {
  double lumens = 0;
  Vec3 normal{0}, place{0};
  int instances = 0;
};
Shining shining(const Scene& scene) {
  Shining out;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene[instance.mesh];
    const Material& material = scene[mesh.material];
    if (!material.emits()) continue;
    EXPECT_FALSE(material.double_sided);
    ++out.instances;
    Vec3 middle(0);
    for (const Vec3& p : mesh.positions) middle += Vec3(instance.transform * glm::vec4(p, 1));
    out.place += middle / static_cast<float>(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
      Vec3 p[3];
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = Vec3(instance.transform * glm::vec4(mesh.positions[t.v[i]], 1));
      const Vec3 normal = 0.5f * glm::cross(p[1] - p[0], p[2] - p[0]);
      out.normal += normal;
      out.lumens += static_cast<double>(glm::length(normal) * kPi * luminance(material.emission));
    }
  }
  out.normal = glm::normalize(out.normal);
  out.place = out.place / static_cast<float>(out.instances);
  return out;
}

class L3d : public testing::Test {
 protected:
  std::filesystem::path pack(const std::string& xml, const std::string& name = "a/a.obj") {
    const auto path = folder_ / "lamp.l3d";
    zip_t* zip = ::zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    const std::string obj = kPlates;
    for (const auto& [file, text] : {std::pair("structure.xml", &xml), std::pair(name.c_str(), &obj)})
      ::zip_file_add(zip, file, ::zip_source_buffer(zip, text->data(), text->size(), 0), 0);
    EXPECT_EQ(::zip_close(zip), 0);
    return path;
  }
  std::string error(const std::string& xml, const std::string& name = "a/a.obj") {
    try {
      import_l3d(pack(xml, name));
    } catch (const Error& e) {
      const std::string what = e.what();
      return what.substr(what.find("lamp.l3d"));
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST_F(L3d, FacesThatShineHang) {
  const Shining s = shining(import_l3d(pack(structure(part(surface(kGlass))))));
  EXPECT_EQ(s.instances, 1);
  EXPECT_NEAR(s.lumens, 1000, 0.1);
  EXPECT_LT(glm::length(s.normal - Vec3(0, -1, 0)), 1e-5f);
  EXPECT_LT(glm::length(s.place - Vec3(0, 0.19f, 0)), 1e-5f);  // 1 cm below the part, which is 20 cm up
}

TEST_F(L3d, FacesTurnToWhereTheirEmitterShines) {
  const Shining s = shining(import_l3d(pack(structure(part(surface("<FaceAssignment faceIndex=\"0\"/>"))))));
  EXPECT_LT(glm::length(s.normal - Vec3(0, -1, 0)), 1e-5f);
}

TEST_F(L3d, RotationsRunZThenXThenY) {
  // -z, turned by x = 90 about the axes that z = 180 has turned: towards -y of the file, which is +z here.
  const Shining s = shining(import_l3d(pack(structure(part(surface(kGlass), "x=\"90\" y=\"0\" z=\"180\"")))));
  EXPECT_LT(glm::length(s.normal - Vec3(0, 0, 1)), 1e-5f);
}

TEST_F(L3d, WithoutFacesTheEmitterShines) {
  const Shining s = shining(import_l3d(pack(structure(part(kEmitter)))));
  EXPECT_NEAR(s.lumens, 1000, 0.1);
  EXPECT_LT(glm::length(s.normal - Vec3(0, -1, 0)), 1e-5f);
  EXPECT_NEAR(static_cast<double>(s.place.y), 0.1899, 1e-6);
}

TEST_F(L3d, PublicExamples) {
  SCONCE_NEEDS_DATA(test_data() / "photometry/l3d");
  std::string said;
  Progress progress;
  progress.warning = [&](const std::string& line) { said += line + "\n"; };
  const auto example = [&](const std::string& name) {
    return import_l3d(test_data() / "photometry/l3d" / name / "structure.xml", progress);
  };
  const Shining cube = shining(example("example_000"));
  EXPECT_NEAR(cube.lumens, 1000, 0.1);
  EXPECT_LT(glm::length(cube.normal - Vec3(0, -1, 0)), 1e-5f);
  const Shining desk = shining(example("example_002"));  // arm and head turned: 30 - 30 + 90 degrees
  EXPECT_LT(glm::length(desk.normal - Vec3(0, -1, 0)), 1e-4f);
  EXPECT_GT(desk.place.y, 0.4f);
  EXPECT_EQ(shining(example("example_004")).instances, 2);  // up and down
  EXPECT_EQ(shining(example("example_006")).instances, 4);  // heads on a rail
  EXPECT_NE(said.find("example_006/head/head.obj: material file head/"), std::string::npos) << said;
  EXPECT_EQ(said.find("/tmp/"), std::string::npos) << said;
}

TEST_F(L3d, BadInputIsOneLine) {
  EXPECT_EQ(error(structure(part(surface(kGlass)), "miles")),
            "lamp.l3d/structure.xml:4: has the unit 'miles' (allowed: m, dm, cm, mm, yard, foot, inch)");
  EXPECT_EQ(error(structure(part(surface("<FaceAssignment groupIndex=\"1\" faceIndex=\"1\"/>")))),
            "lamp.l3d/a/a.obj: has 1 faces in group 1, but 'les' names face 1");
  EXPECT_EQ(error(structure(part(surface("<FaceAssignment faceIndex=\"-1\"/>")))),
            "lamp.l3d/structure.xml:11: faceIndex of FaceAssignment is no whole number from 0 on");
  EXPECT_EQ(error(structure(part(surface(kGlass))), "b.obj"),
            "lamp.l3d/structure.xml: names the file 'a/a.obj', which is not there");
  EXPECT_EQ(error(structure(part(surface(kGlass))), "../a.obj"),
            "lamp.l3d: holds the file '../a.obj' outside of it");
  EXPECT_EQ(error("<Luminaire>\n<Structure>"),
            "lamp.l3d/structure.xml:2: is no valid XML: Start-end tags mismatch");
  EXPECT_THROW(import_l3d(folder_.write("x.l3d", "no zip")), NotMyFormat);
}

}  // namespace
}  // namespace sconce
