// SPDX-License-Identifier: Apache-2.0
// What docs/validation.md is made of: values that others know, and ours beside them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sconce::validation {

struct Row {
  std::string what;
  double reference = 0, ours = 0;
  double allowed = 0.01;  ///< relative, or absolute where `absolute`
  bool absolute = false;

  double error() const;  ///< in the measure of `allowed`
  bool passes() const;
  /// What does not change with our own rounding: a page is stale when these differ.
  std::string key() const;
};

struct Section {
  std::string title, text;  ///< text: what it is and whose the reference is
  std::vector<Row> rows;
};

struct SectionRow {
  const char* name;
  Section (*make)(const std::filesystem::path& data);  ///< root of the shared data
};
/// All sections, in the page's order.
const std::vector<SectionRow>& sections();

Section direct_light(const std::filesystem::path& data);
Section measured_lamps(const std::filesystem::path& data);
Section between_surfaces(const std::filesystem::path& data);
Section form_factors(const std::filesystem::path& data);
Section cie_171(const std::filesystem::path& data);
Section changed_lamps(const std::filesystem::path& data);
Section file_fluxes(const std::filesystem::path& data);
Section glare_tables(const std::filesystem::path& data);

/// The page as Markdown.
std::string page(const std::vector<Section>& made);
std::size_t failing(const std::vector<Section>& made);

}  // namespace sconce::validation
