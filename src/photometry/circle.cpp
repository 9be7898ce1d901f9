// SPDX-License-Identifier: Apache-2.0
#include "photometry/circle.h"

#include <cmath>

namespace sconce {

namespace {

bool equal(double a, double b) {
  return std::abs(a - b) < 1e-6;
}

}  // namespace

bool fill_circle(Photometry& table, const std::vector<double>& h, const std::vector<double>& candela) {
  const std::size_t n = h.size(), rows = table.polars.size();
  const double first = h.front(), last = h.back();
  const auto plane = [&](double azimuth, std::size_t of) {
    table.azimuths.push_back(azimuth);
    const auto from = candela.begin() + static_cast<std::ptrdiff_t>(of * rows);
    table.candela.insert(table.candela.end(), from, from + static_cast<std::ptrdiff_t>(rows));
  };
  if (n == 1) {
    plane(0, 0), plane(360, 0);
    return true;
  }
  if (equal(first, 90) && equal(last, 270)) {  // mirrored about C90-C270: C and 180 - C are one
    for (std::size_t i = n; i-- > 0;)
      if (h[i] < 180 + 1e-6) plane(180 - h[i], i);
    for (std::size_t i = 1; i + 1 < n; ++i) plane(h[i], i);
    for (std::size_t i = n; i-- > 0;)
      if (h[i] > 180 - 1e-6) plane(540 - h[i], i);
    close_circle(table);
    return true;
  }
  const bool open = last > 180 && !equal(last, 180) && !equal(last, 360);
  if (!equal(first, 0) || last > 360 + 1e-6 || (last < 180 - 1e-6 && !equal(last, 90)) ||
      (open && 360 - last > 1.5 * (last - h[n - 2])))
    return false;
  for (std::size_t i = 0; i < n; ++i) plane(h[i], i);
  if (equal(last, 90)) {
    for (std::size_t i = n - 1; i-- > 0;) plane(180 - h[i], i);
    for (std::size_t i = 1; i < n; ++i) plane(180 + h[i], i);
    for (std::size_t i = n - 1; i-- > 0;) plane(360 - h[i], i);
  } else if (equal(last, 180)) {
    for (std::size_t i = n - 1; i-- > 0;) plane(360 - h[i], i);
  } else if (open) {
    close_circle(table);
  }
  return true;
}

void close_circle(Photometry& p) {
  const std::size_t rows = p.polars.size();
  const double gap = p.azimuths.front() + 360 - p.azimuths.back();
  if (p.azimuths.back() < 360) {
    const double at = (360 - p.azimuths.back()) / gap;
    const std::vector<double> first(p.candela.begin(), p.candela.begin() + static_cast<std::ptrdiff_t>(rows)),
        last(p.candela.end() - static_cast<std::ptrdiff_t>(rows), p.candela.end());
    for (std::size_t g = 0; g < rows; ++g) p.candela.push_back(last[g] + at * (first[g] - last[g]));
    p.azimuths.push_back(360);
  }
  if (p.azimuths.front() > 0) {
    const std::vector<double> seam(p.candela.end() - static_cast<std::ptrdiff_t>(rows), p.candela.end());
    p.candela.insert(p.candela.begin(), seam.begin(), seam.end());
    p.azimuths.insert(p.azimuths.begin(), 0);
  }
}

}  // namespace sconce
