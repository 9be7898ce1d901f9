// SPDX-License-Identifier: Apache-2.0
#include "rows.h"

#include <fmt/format.h>

#include <cmath>

namespace sconce::validation {

namespace {

std::string percent_or_plain(const Row& row, double v) {
  return row.absolute ? fmt::format("{:.2g}", v) : fmt::format("{:.2g} %", 100 * v);
}

}  // namespace

double Row::error() const {
  return absolute ? ours - reference : ours / reference - 1;
}

bool Row::passes() const {
  return std::abs(error()) <= allowed;
}

std::string Row::key() const {
  return fmt::format("| {} | {:.6g} |", what, reference);
}

const std::vector<SectionRow>& sections() {
  static const std::vector<SectionRow> kSections = {
      {"direct", direct_light},      {"luminaires", measured_lamps},
      {"between", between_surfaces}, {"form-factors", form_factors},
      {"cie171", cie_171},           {"mixes", changed_lamps},
      {"files", file_fluxes},        {"ugr", glare_tables}};
  return kSections;
}

std::size_t failing(const std::vector<Section>& made) {
  std::size_t count = 0;
  for (const Section& section : made)
    for (const Row& row : section.rows) count += !row.passes();
  return count;
}

std::string page(const std::vector<Section>& made) {
  std::size_t rows = 0;
  for (const Section& section : made) rows += section.rows.size();
  std::string out = fmt::format(
      "# Validation\n\nWritten by `make validate`; not edited by hand. {} values that are known from "
      "elsewhere, beside what sconce "
      "computes: {} of them further off than allowed. `tests/validation/` holds what each row does; the same "
      "rows are a test.\n",
      rows, failing(made));
  for (const Section& section : made) {
    out += fmt::format(
        "\n## {}\n\n{}\n\n| what | reference | sconce | error | allowed | |\n|---|---|---|---|---|---|\n",
        section.title, section.text);
    for (const Row& row : section.rows)
      out +=
          fmt::format("{} {:.6g} | {} | {} | {} |\n", row.key(), row.ours, percent_or_plain(row, row.error()),
                      percent_or_plain(row, row.allowed), row.passes() ? "ok" : "**off**");
  }
  return out;
}

}  // namespace sconce::validation
