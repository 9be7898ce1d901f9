// SPDX-License-Identifier: Apache-2.0
// The house rules that a program can check: who includes whom, licence lines, lengths, and docs that know
// every verb.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/files.h"
#include "core/text.h"

namespace fs = std::filesystem;
using namespace sconce;

namespace {

const fs::path kRoot = SCONCE_SOURCE_DIR;
constexpr std::size_t kLongest = 400;  ///< lines a file may have

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string shown(const fs::path& file) {
  return fs::relative(file, kRoot).string();
}

const std::vector<fs::path>& cpp_files() {
  static const std::vector<fs::path> files = [] {
    std::vector<fs::path> all;
    for (const char* folder : {"src", "apps", "tests", "bench", "scenes", "examples"}) {
      const std::vector<fs::path> some = files_below(folder, {".cpp", ".h"});
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return files;
}

struct Include {
  std::string path;
  bool quoted;
};

std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const std::string& line : split(read_file(file), '\n')) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) includes.push_back({match[2], match[1] == "\""});
  }
  return includes;
}

/// Module -> all that it may include, itself among them.
std::map<std::string, std::set<std::string>> read_layers() {
  std::map<std::string, std::set<std::string>> allowed;
  for (const std::string& line : split(read_file(kRoot / "src/LAYERS"), '\n')) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    EXPECT_NE(colon, std::string::npos) << "src/LAYERS: " << line;
    const std::string module = line.substr(0, colon);
    std::set<std::string>& reach = allowed[module];
    reach.insert(module);
    for (const std::string& name : split(trim(line.substr(colon + 1)), ' ')) {
      if (name.empty()) continue;
      EXPECT_TRUE(allowed.contains(name))
          << "src/LAYERS: " << module << " names " << name << " before it is listed";
      reach.insert(allowed[name].begin(), allowed[name].end());
    }
  }
  return allowed;
}

}  // namespace

TEST(Layers, EveryModuleIsListed) {
  const auto allowed = read_layers();
  ASSERT_GE(allowed.size(), 10u);
  for (const auto& entry : fs::directory_iterator(kRoot / "src")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(allowed.contains(entry.path().filename().string()))
        << shown(entry.path()) << " is not in src/LAYERS";
  }
}

TEST(Layers, IncludesKeepToTheList) {
  const auto allowed = read_layers();
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", {".cpp", ".h"})) {
    const std::string module = fs::relative(file, kRoot / "src").begin()->string();
    ASSERT_TRUE(allowed.contains(module)) << shown(file);
    for (const Include& include : includes_of(file)) {
      if (!include.quoted) continue;
      const std::string from = include.path.substr(0, include.path.find('/'));
      // Shaders and scripts are included as the literals that CMake makes of them.
      const bool literal = include.path.ends_with(".glsl.h") || include.path.ends_with(".py.h");
      const bool lamp = literal && from == "lights";  // a text that users copy, in no module
      EXPECT_TRUE(fs::exists(kRoot / (lamp ? "examples" : "src") /
                             include.path.substr(0, include.path.size() - (literal ? 2 : 0))))
          << shown(file) << " includes \"" << include.path << "\"";
      if (lamp) continue;
      EXPECT_TRUE(allowed.at(module).contains(from))
          << shown(file) << " includes \"" << include.path << "\"; " << module << " may use "
          << join(std::vector<std::string>(allowed.at(module).begin(), allowed.at(module).end()), ", ");
      ++checked;
    }
  }
  EXPECT_GT(checked, 50u);
}

TEST(Layers, LibrariesStayInTheirPlace) {
  struct Rule {
    const char *pattern, *place;
    std::vector<const char*> also = {};
  };
  const Rule rules[] = {{R"(^embree)", "src/trace/", {"bench/replay"}},  // measures against bare Embree calls
                        {R"(^(Imf|Imath|half\.h|OpenEXR/))", "src/image/"},
                        {R"(stb_image)", "src/image/"},
                        {R"(^tbb/)", "src/core/", {"bench/replay"}},
                        {R"(^(epoxy|EGL|GL)/)", "src/gpu/", {"examples/", "tests/foreign_gl_test"}},  // hosts
                        {R"(^(GLFW/|imgui|backends/imgui))", "apps/viewer/"},
                        {R"(^hwy/)", "src/mix/", {"src/tone/", "src/picture/", "src/transfer/"}},
                        {R"(^CLI/)", "apps/sconce/options.cpp"}};
  std::map<std::string, int> found;
  for (const fs::path& file : cpp_files()) {
    for (const Include& include : includes_of(file)) {
      for (const Rule& rule : rules) {
        if (!std::regex_search(include.path, std::regex(rule.pattern))) continue;
        ++found[rule.pattern];
        const auto allowed = [&](const char* place) { return shown(file).starts_with(place); };
        EXPECT_TRUE(allowed(rule.place) || std::any_of(rule.also.begin(), rule.also.end(), allowed))
            << shown(file) << " includes " << include.path << ", which only " << rule.place << " may";
      }
    }
  }
  for (const Rule& rule : rules)
    EXPECT_GT(found[rule.pattern], 0) << rule.place << " includes nothing like " << rule.pattern;
}

TEST(House, EveryFileNamesItsLicence) {
  std::vector<fs::path> files = cpp_files();
  for (const char* folder :
       {"src", "apps", "tests", "bench", "scenes", "solvers", "examples", "cmake", "tools", ".ci"}) {
    const auto scripts = files_below(folder, {".cmake", ".sh", ".py", ".txt", ".glsl", ""});
    files.insert(files.end(), scripts.begin(), scripts.end());
  }
  for (const char* file : {"CMakeLists.txt", "Makefile"}) files.push_back(kRoot / file);
  ASSERT_GT(files.size(), 50u);
  for (const fs::path& file : files) {
    if (file.filename() == "LAYERS") continue;
    const std::string text = read_file(file);
    EXPECT_NE(text.substr(0, 200).find("SPDX-License-Identifier: Apache-2.0"), std::string::npos)
        << shown(file);
  }
}

TEST(House, NoFileIsTooLong) {
  for (const fs::path& file : cpp_files()) {
    const std::string text = read_file(file);
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    EXPECT_LE(lines, kLongest) << shown(file);
  }
}

TEST(House, DocsKnowEveryVerb) {
  const std::string table = read_file(kRoot / "apps/sconce/main.cpp");
  static const std::regex row(R"re(\{"([a-z]+)", ")re");
  std::string docs = read_file(kRoot / "README.md");
  for (const fs::path& file : files_below("docs", {".md"})) docs += read_file(file);
  int verbs = 0;
  for (std::sregex_iterator match(table.begin(), table.end(), row), end; match != end; ++match, ++verbs) {
    EXPECT_NE(docs.find("sconce " + (*match)[1].str()), std::string::npos)
        << "no word on sconce " << (*match)[1];
    EXPECT_TRUE(fs::exists(kRoot / "apps/sconce" / ((*match)[1].str() + ".cpp"))) << (*match)[1];
  }
  EXPECT_GE(verbs, 6);
}
