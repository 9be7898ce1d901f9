// SPDX-License-Identifier: Apache-2.0
// docs/validation.md holds what is computed now, and no row of it is off.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files.h"
#include "core/test_data.h"
#include "validation/rows.h"

namespace sconce::validation {

void PrintTo(const SectionRow& section, std::ostream* out) {
  *out << section.name;
}

namespace {

class EverySection : public testing::TestWithParam<SectionRow> {};
INSTANTIATE_TEST_SUITE_P(Rows, EverySection, testing::ValuesIn(sections()), [](const auto& section) {
  std::string name = section.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(EverySection, HoldsAndStandsInThePage) {
  SCONCE_NEEDS_DATA(test_data());
  const std::string page = read_file(std::filesystem::path(SCONCE_SOURCE_DIR) / "docs/validation.md");
  EXPECT_EQ(page.find("**off**"), std::string::npos);
  const Section section = GetParam().make(test_data());
  EXPECT_FALSE(section.rows.empty());
  EXPECT_NE(page.find("## " + section.title), std::string::npos) << "make validate";
  for (const Row& row : section.rows) {
    EXPECT_TRUE(row.passes()) << row.what << ": " << row.ours << " of " << row.reference;
    EXPECT_NE(page.find(row.key()), std::string::npos)
        << "not in the page: " << row.what << "; make validate";
  }
}

}  // namespace
}  // namespace sconce::validation
