// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "photometry/doctor.h"
#include "photometry/formats.h"
#include "photometry/test_ugr.h"
#include "rows.h"

namespace sconce::validation {

Section file_fluxes(const std::filesystem::path& data) {
  Section out{
      "Flux that files state",
      "Every file of the shared photometry that states its luminaire's flux, lm, against the integral over "
      "its table. Where a table "
      "is too coarse for its beam, the two ways of integrating it (linear, trapezoids) set what is allowed.",
      {}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data / "photometry"))
    if (const std::string type = lower(entry.path().extension().string());
        (type == ".ies" || type == ".ldt") && entry.path().stem() != "Truncated Profile - 01")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const Photometry lamp = read_photometry(file);
    if (!lamp.stated) continue;
    const FluxBounds bounds = flux_bounds(lamp);
    const bool within = *lamp.stated >= bounds.low && *lamp.stated <= bounds.high;
    const double allowed = std::max(0.005, within ? bounds.high / bounds.low - 1 : 0);
    out.rows.push_back({file.filename().string(), *lamp.stated, flux(lamp), allowed});
  }
  return out;
}

Section glare_tables(const std::filesystem::path& data) {
  Section out{"UGR tables",
              "Five files, 19 rooms x 10 columns, against the tables of DIALux, Relux and CIE 190. Shares of "
              "cells within 0.1 of the "
              "nearest of the references (the bar is 90 % over all), and the furthest that a cell lies "
              "outside of their span (0.3). "
              "docs/luminaires.md says where they differ among themselves.",
              {}};
  std::size_t cells = 0, near = 0;
  for (const char* sample : kUgrSamples) {
    const UgrComparison c = compare_ugr(data / "photometry/ldt/eulumdat-ugr", sample);
    cells += c.cells, near += c.near;
    out.rows.push_back({fmt::format("sample {}: cells near, {} references", sample, c.references), 1,
                        static_cast<double>(c.near) / static_cast<double>(c.cells), 0.2, true});
    out.rows.push_back({fmt::format("sample {}: furthest outside", sample), 0, c.outside, 0.3001, true});
  }
  out.rows.push_back(
      {"all 950 cells: near", 1, static_cast<double>(near) / static_cast<double>(cells), 0.1, true});
  return out;
}

}  // namespace sconce::validation
