// SPDX-License-Identifier: Apache-2.0
// Writes docs/robustness.md: `robustness DATA PAGE.md SCONCE...`. Exit code 3 where there is a finding.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "collections.h"
#include "core/error.h"
#include "core/files.h"

namespace sconce::robustness {
namespace {

/// @return the number of findings
std::size_t add_section(const std::string& data, const Program& program, std::string& page) {
  std::vector<std::string> findings, valid_refused;
  std::size_t valid = 0, files = 0;
  double slowest = 0;
  page += fmt::format(
      "\n## {}\n\n| suite | what | files | read | baked | refused | other formats | findings |\n"
      "|---|---|---|---|---|---|---|---|\n",
      program.sanitized ? "With the address and undefined-behaviour sanitizers" : "As it is built for use");
  for (const Collection& collection : collections()) {
    fmt::print(stderr, "{}: {}\n", program.path, collection.name);
    const Counts counts = try_all(collection, data, program);
    page += counts.row(collection);
    findings.insert(findings.end(), counts.findings.begin(), counts.findings.end());
    valid_refused.insert(valid_refused.end(), counts.valid_refused.begin(), counts.valid_refused.end());
    valid += counts.valid;
    files += counts.files;
    slowest = std::max(slowest, counts.slowest);
  }
  page += fmt::format("\n{} files; the slowest run took {:.1f} s, the largest {:.0f} MB.\n", files, slowest,
                      most_megabytes());
  page += fmt::format(
      "\nThe validator finds no error in {} of the files; all of them are read but {}, which must not be (it "
      "asks "
      "for a later glTF):\n\n",
      valid, valid_refused.size());
  for (const std::string& line : valid_refused) page += "- " + line + "\n";
  if (!findings.empty()) page += "\nFindings:\n\n";
  for (const std::string& line : findings) page += "- " + line + "\n";
  return findings.size();
}

constexpr const char* kHead =
    R"(# Robustness

Written by `make robustness`; not edited by hand. Every file of other people's test suites through `sconce info`; what is read
is baked with 64 x 64 texels, and pictures go through `sconce diff`, too. Each run may take 10 s of computing and 4 GB. A **finding** is a
crash, a hang, too much memory, a sanitizer's report, or a refusal that is not one line naming the file; there should be none. The
same files are a test.
)";

/// What `make fuzz` counted, and what it found before.
std::string fuzzing() {
  const std::filesystem::path root = SCONCE_SOURCE_DIR, table = root / "bench/results/fuzz.md";
  if (!std::filesystem::exists(table)) return {};
  return "\n## Made-up input\n\nlibFuzzer, with address and undefined behaviour sanitizers, on every reader "
         "(`make "
         "fuzz`; tests/fuzz). "
         "Reached: edges of the program.\n\n" +
         read_file(table) + "\n" + read_file(root / "tests/fuzz/found.md");
}

int write_page(const std::string& data, const std::string& file, std::span<char*> programs) {
  std::string page = kHead;
  std::size_t findings = 0;
  for (const char* program : programs) findings += add_section(data, program_at(program), page);
  page += fuzzing();
  write_file(file, page);
  fmt::print("{}: {} findings\n", file, findings);
  return findings == 0 ? 0 : 3;
}

}  // namespace
}  // namespace sconce::robustness

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: robustness DATA PAGE.md SCONCE...\n");
    return 2;
  }
  try {
    return sconce::robustness::write_page(argv[1], argv[2], {argv + 3, argv + argc});
  } catch (const sconce::Error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 1;
  }
}
