// SPDX-License-Identifier: Apache-2.0
// Broken files end in a result or in one clear line, never otherwise; docs/robustness.md holds what is
// counted now.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files.h"
#include "core/test_data.h"
#include "robustness/collections.h"

namespace sconce::robustness {

void PrintTo(const Collection& collection, std::ostream* out) {
  *out << collection.name;
}

namespace {

class EveryCollection : public testing::TestWithParam<Collection> {};
INSTANTIATE_TEST_SUITE_P(Files, EveryCollection, testing::ValuesIn(collections()),
                         [](const auto& collection) {
                           std::string name = collection.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryCollection, HasNoFindingsAndStandsInThePage) {
  SCONCE_NEEDS_DATA(test_data() / "conformance");
  const Counts counts = try_all(GetParam(), test_data(), program_at(SCONCE_PROGRAM));
  for (const std::string& finding : counts.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(counts.valid_refused.size(), GetParam().name == std::string("gltf-validator") ? 1u : 0u);
  const std::string page = read_file(std::filesystem::path(SCONCE_SOURCE_DIR) / "docs/robustness.md");
  EXPECT_NE(page.find(counts.row(GetParam())), std::string::npos)
      << "not in the page: " << counts.row(GetParam()) << "make robustness";
}

}  // namespace
}  // namespace sconce::robustness
