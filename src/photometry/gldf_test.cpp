// SPDX-License-Identifier: Apache-2.0
// GLDF containers, made here: product.xml as its documentation describes it, and photometric files.
#include <gtest/gtest.h>
#include <zip.h>

#include <numbers>

#include "core/error.h"
#include "core/test_folder.h"
#include "photometry/formats.h"

namespace sconce {
namespace {

const char* kLamp = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 9\n0 180\n0\n50 50\n";

/// @param files  content type and text of ID="file" @param emitters  of the product @param variants  likewise
std::string product(const std::string& file, const std::string& emitters, const std::string& variants = "") {
  return "<?xml version=\"1.0\" "
         "encoding=\"UTF-8\"?>\n<Root>\n<Header><Manufacturer>Maker</Manufacturer></Header>\n"
         "<GeneralDefinitions>\n<Files>\n" +
         file +
         "</Files>\n<Photometries><Photometry id=\"p\"><PhotometryFileReference fileId=\"f\"/></Photometry>"
         "<Photometry id=\"q\"><PhotometryFileReference "
         "fileId=\"g\"/></Photometry></Photometries>\n<Emitters>\n" +
         emitters + "</Emitters></GeneralDefinitions>\n<ProductDefinitions><Variants>" + variants +
         "</Variants></ProductDefinitions></Root>\n";
}
const std::string kFile = "<File id=\"f\" contentType=\"ldc/ies\" type=\"localFileName\">lamp.ies</File>\n";
std::string emitter(const std::string& id, const std::string& photometry, const std::string& more = "") {
  return "<Emitter id=\"" + id + "\"><FixedLightEmitter>" + more + "<PhotometryReference photometryId=\"" +
         photometry + "\"/></FixedLightEmitter></Emitter>\n";
}

class Gldf : public testing::Test {
 protected:
  std::filesystem::path pack(const std::string& xml, const std::string& lamp = kLamp) {
    const auto path = folder_ / "lamp.gldf";
    zip_t* zip = ::zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    const auto add = [&](const char* name, const std::string& text) {
      ::zip_file_add(zip, name, ::zip_source_buffer(zip, text.data(), text.size(), 0), 0);
    };
    add("product.xml", xml);
    add("ldc/lamp.ies", lamp);
    EXPECT_EQ(::zip_close(zip), 0);
    return path;
  }
  std::string error(const std::string& xml, const std::string& lamp = kLamp) {
    try {
      read_photometry(pack(xml, lamp));
    } catch (const Error& e) {
      const std::string what = e.what();
      return what.substr(what.find("lamp.gldf"));
    }
    return "no error";
  }
  TemporaryFolder folder_;
};

TEST_F(Gldf, TheFirstVariantsPhotometry) {
  const Photometry lamp = read_photometry(pack(product(kFile, emitter("e", "p"))));
  EXPECT_NEAR(flux(lamp), 200 * std::numbers::pi, 1e-9);
  EXPECT_EQ(lamp.format, "LM-63-2002");
  EXPECT_TRUE(lamp.notes.empty());
  const Photometry noted = read_photometry(pack(
      product(kFile, emitter("e", "p", "<RatedLuminousFlux>800</RatedLuminousFlux>") + emitter("other", "q"),
              "<Variant id=\"a\"><Geometry><ModelGeometryReference><EmitterReference emitterId=\"e\"/>"
              "</ModelGeometryReference></Geometry></Variant><Variant id=\"b\"/>")));
  ASSERT_EQ(noted.notes.size(), 2u);
  EXPECT_EQ(noted.notes[0], "of 2 variants the first, 'a', is taken");
  EXPECT_EQ(noted.notes[1],
            "product.xml rates the emitter at 800 lm, its photometric file gives 628.3 lm; the file counts");
}

TEST_F(Gldf, BadInputIsOneLine) {
  EXPECT_EQ(error(product(kFile, emitter("e", "p") + emitter("e2", "q"))),
            "lamp.gldf/product.xml:9: the emitters refer to 2 photometries (allowed: one; of several the "
            "parts' places are "
            "not known)");
  EXPECT_EQ(error(product(kFile, emitter("e", "r"))),
            "lamp.gldf/product.xml:4: refers to the Photometry 'r', which is not there");
  EXPECT_EQ(error(product(kFile, emitter("e", "q"))),
            "lamp.gldf/product.xml:8: refers to the File 'g', which is not there");
  EXPECT_EQ(error(product("<File id=\"f\" contentType=\"ldc/ies\" type=\"localFileName\">no.ies</File>",
                          emitter("e", "p"))),
            "lamp.gldf: holds no file 'ldc/no.ies'");
  EXPECT_EQ(error(product("<File id=\"f\" contentType=\"ldc/ies\" type=\"url\">x</File>", emitter("e", "p"))),
            "lamp.gldf/product.xml:6: the photometry 'x' lies on the net (allowed: a file in the container)");
  EXPECT_EQ(error(product(kFile, emitter("e", "p")), std::string(kLamp).substr(0, 58)),
            "lamp.gldf/ldc/lamp.ies:5: ends before vertical angle 2 of 2");
  EXPECT_NE(error("<Root>\n<Gen").find("lamp.gldf/product.xml:2: is no valid XML"), std::string::npos);
  EXPECT_EQ(error("<Root/>"), "lamp.gldf/product.xml:1: has no GeneralDefinitions (allowed: a GLDF product)");
}

}  // namespace
}  // namespace sconce
