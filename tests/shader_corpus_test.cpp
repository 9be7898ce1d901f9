// SPDX-License-Identifier: Apache-2.0
// The position override on real vertex shaders, those of OGRE, OpenSceneGraph and three.js as they are
// installed: the reference compiler takes each before and after.
#include <gtest/gtest.h>

#include <regex>

#include "browser.h"
#include "core/error.h"
#include "shader/test_glslang.h"
#include "shader/vertex_override.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

void expect_taken(const std::set<std::string>& shaders, std::size_t at_least) {
  testing::Test::RecordProperty("shaders", static_cast<int>(shaders.size()));
  EXPECT_GE(shaders.size(), at_least);
  expect_valid_glsl(shaders, "vert");
  std::set<std::string> after;
  for (const std::string& shader : shaders) after.insert(override_vertex_position(shader, "a shader"));
  EXPECT_EQ(after.size(), shaders.size());
  expect_valid_glsl(after, "vert");
}

// What WebGL is handed for its materials, with and without lights, shadows, fog, maps, bones, morphs,
// instances.
TEST(ShaderCorpus, ThreeJs) {
  SCONCE_NEEDS_BROWSER();
  const TemporaryFolder folder;
  const test::Outcome outcome =
      test::run_program("node", {SCONCE_SOURCE_DIR "/web/test/three_shaders.mjs", (folder / ".").string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::set<std::string> shaders;
  // glslang knows an `average` of its own in every version, and GLSL does not.
  for (const auto& entry : fs::directory_iterator(folder / "."))
    shaders.insert(std::regex_replace(read_file(entry.path()), std::regex("\\baverage\\b"), "average_of"));
  expect_taken(shaders, 800);
}

#ifdef OSG_LIBRARIES
// The texts in its libraries: shaders of particles, terrain, volumes, letters, shadows, the shader generator.
TEST(ShaderCorpus, OpenSceneGraph) {
  std::vector<fs::path> libraries;
  for (const auto& entry : fs::directory_iterator(OSG_LIBRARIES)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("libosg") && name.ends_with(".so")) libraries.push_back(entry.path());
    if (name.starts_with("osgPlugins-"))
      for (const auto& plugin : fs::directory_iterator(entry.path())) libraries.push_back(plugin.path());
  }
  std::set<std::string> shaders;
  std::size_t of_geometry = 0;
  for (const fs::path& library : libraries) {
    const std::string bytes = read_file(library);
    for (std::size_t at = bytes.find("void main("); at != std::string::npos;
         at = bytes.find("void main(", at + 1)) {
      const std::size_t begin = bytes.rfind('\0', at) + 1;
      std::string text = bytes.substr(begin, bytes.find('\0', at) - begin);
      if (text.find("gl_Position") == std::string::npos) continue;
      // As OpenSceneGraph fills them in for OpenGL 2.
      text = std::regex_replace(text, std::regex("\\$OSG_(GLSL_VERSION|PRECISION_FLOAT)"), "");
      text = std::regex_replace(text, std::regex("\\$OSG_VARYING_OUT"), "varying");
      if (text.find("#version") == std::string::npos) text.insert(0, "#version 110\n");
      if (text.find("EmitVertex") != std::string::npos) {
        ++of_geometry;
        EXPECT_THROW(override_vertex_position(text, "a shader"), Error);
      } else {
        shaders.insert(text);
      }
    }
  }
  EXPECT_GE(of_geometry, 1u);
  expect_taken(shaders, 15);
}
#endif

#ifdef OGRE_SHADERS
class OgreShaders : public testing::Test {
 protected:
  /// OGRE's includes put in, each once.
  std::string with_includes(std::string text, std::set<std::string>& done) const {
    static const std::regex include("#include [<\"]([^>\"]+)[>\"]");
    std::smatch match;
    while (std::regex_search(text, match, include)) {
      const std::string name = match[1];
      std::string inner;
      if (done.insert(name).second)
        for (const fs::path place : {OGRE_SHADERS "/GLSL", OGRE_SHADERS "/../ShadowVolume"})
          if (fs::exists(place / name)) inner = with_includes(read_file(place / name), done);
      text.replace(static_cast<std::size_t>(match.position()), static_cast<std::size_t>(match.length()),
                   inner);
    }
    return text;
  }
  /// @param text  without #version
  std::string complete(const std::string& text, const std::string& version) const {
    std::set<std::string> done;
    return "#version " + version + "\n#define OGRE_GLSL " + version + "\n#define OGRE_VERTEX_SHADER 1\n" +
           with_includes(text, done);
  }
  /// As OGRE's own preprocessor does before OpenGL sees it.
  std::string preprocessed(const std::string& text) const {
    write_file(folder_ / "x.vert", text);
    const test::Outcome outcome =
        test::run_program("glslangValidator", {"-E", (folder_ / "x.vert").string()});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    return outcome.out;
  }
  TemporaryFolder folder_;
};

TEST_F(OgreShaders, Installed) {
  std::set<std::string> shaders;
  for (const auto& entry : fs::directory_iterator(OGRE_SHADERS "/../ShadowVolume"))
    if (entry.path().extension() == ".vert")
      shaders.insert(preprocessed(complete(read_file(entry.path()), "150")));
  expect_taken(shaders, 5);
}

// Rewritten as the generator writes them; its libraries are put in afterwards.
TEST_F(OgreShaders, Generated) {
  const fs::path cache = folder_ / "cache";
  fs::create_directory(cache);
  const test::Outcome outcome =
      test::run_program(OGRE_RADIOSITY, {(folder_ / "room").string(), "--shiny", cache.string()},
                        test::with_display("640x480", 300));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::set<std::string> before, after;
  for (const auto& entry : fs::directory_iterator(cache)) {
    if (!entry.path().string().ends_with("_VS.glsl")) continue;
    const std::string text = read_file(entry.path());
    const auto rest = [](const std::string& whole) { return whole.substr(whole.find('\n') + 1); };
    before.insert(complete(rest(text), "450"));
    after.insert(complete(rest(override_vertex_position(text, entry.path().filename().string())), "450"));
  }
  EXPECT_GE(before.size(), 4u);
  EXPECT_EQ(after.size(), before.size());
  expect_valid_glsl(before, "vert");
  expect_valid_glsl(after, "vert");
}
#endif

}  // namespace
}  // namespace sconce
