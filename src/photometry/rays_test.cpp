// SPDX-License-Identifier: Apache-2.0
// Ray files of other programs against what they were made from.
#include "photometry/rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "core/files.h"
#include "core/test_data.h"
#include "core/text.h"
#include "photometry/lines.h"

namespace sconce {
namespace {

std::filesystem::path folder() {
  return test_data() / "photometry/tm25";
}

std::vector<SourceRay> all_rays(const std::filesystem::path& path, RayFile* file = nullptr) {
  std::vector<SourceRay> out;
  const RayFile read = read_rays(
      path, [&](std::span<const SourceRay> block) { out.insert(out.end(), block.begin(), block.end()); });
  if (file != nullptr) *file = read;
  return out;
}

// Three rays that the folder also holds as text; light along +z of the file goes to nadir.
TEST(Rays, ThreeRaysInThreeLayouts) {
  SCONCE_NEEDS_DATA(folder());
  for (const char* name : {"ThreeRays_PowerOnly.1.ray", "ThreeRays_Wavelength.1.ray",
                           "ThreeRays_Wavelength_ZMX.ray", "ThreeRays_Wavelength_ZMW_to_LT.ray"}) {
    const auto rays = all_rays(folder() / "RayFileConverter" / name);
    ASSERT_EQ(rays.size(), 3u) << name;
    EXPECT_NEAR(rays[0].position.x, -0.6668399e-3f, 1e-9f) << name;
    EXPECT_NEAR(rays[0].position.y, 0.3333333e-3f, 1e-9f) << name;
    EXPECT_NEAR(rays[0].direction.x, -0.8660254f, 1e-6f) << name;
    EXPECT_NEAR(rays[0].direction.z, -0.5f, 1e-6f) << name;
    EXPECT_NEAR(rays[2].direction.y, 0.9682459f, 1e-6f) << name;
    EXPECT_NEAR(rays[1].flux, 0.004659902f, 1e-8f) << name;
  }
}

// A cylinder of 10 mm radius from z = 0 to 20 mm.
TEST(Rays, Tm25Cylinder) {
  SCONCE_NEEDS_DATA(folder());
  RayFile file;
  const auto rays = all_rays(folder() / "Cyl10k.1.tm25ray", &file);
  EXPECT_EQ(file.format, "IES TM-25");
  ASSERT_EQ(rays.size(), 10000u);
  double flux = 0;
  for (const SourceRay& ray : rays) {
    flux += static_cast<double>(ray.flux);
    EXPECT_LT(std::hypot(ray.position.x, ray.position.y), 0.010001f);
    EXPECT_GE(ray.position.z, -0.020001f);
    EXPECT_LE(ray.position.z, 0);
  }
  EXPECT_NEAR(flux, 10000, 1e-2);
}

/// Numbers of the file, whatever their lines; other lines are comments.
std::vector<double> numbers_of(const std::filesystem::path& path) {
  std::vector<double> out;
  for (const std::string& line : lines_of(read_file(path))) {
    const std::string text = trim(line);
    if (text.empty() || std::string("+-0123456789").find(text[0]) == std::string::npos) continue;
    for (const std::string& word : split(text, ' '))
      if (!word.empty()) out.push_back(*parse_number(word));
  }
  return out;
}

// farfield.txt holds the intensity over direction cosines kx, ky (100 x 100 from -1 to 1) that the rays were
// drawn from: shares of the flux in 10 x 10 squares of (kx, ky), where d omega = dkx dky / kz, and the table
// against it.
TEST(Rays, FarFieldIsTheOneTheyWereDrawnFrom) {
  SCONCE_NEEDS_DATA(folder());
  const std::vector<double> numbers = numbers_of(folder() / "CreatePointSourceRayFile/farfield.txt");
  ASSERT_EQ(numbers.size(), 1u + 100 + 1 + 100 + 2 + 10000);
  const auto k = [&](std::size_t i) { return numbers[1 + i]; };
  const auto drawn = [&](std::size_t x, std::size_t y) { return numbers[204 + 100 * x + y]; };
  FarFieldBins bins(72, 72);
  std::vector<double> got(100), expected(100);
  double total = 0;
  const auto cell = [](double x, double y) {
    const auto at = [](double v) { return static_cast<std::size_t>(std::min(9.0, (v + 1) * 5)); };
    return 10 * at(x) + at(y);
  };
  read_rays(folder() / "CreatePointSourceRayFile/farfield.TM25ray", [&](std::span<const SourceRay> rays) {
    bins.add(rays);
    for (const SourceRay& ray : rays)
      got[cell(static_cast<double>(ray.direction.x), -static_cast<double>(ray.direction.y))] +=
          static_cast<double>(ray.flux);
  });
  const Photometry table = bins.table();
  EXPECT_NEAR(flux(table), bins.flux(), 1e-9 * bins.flux());
  for (std::size_t x = 0; x < 100; ++x)
    for (std::size_t y = 0; y < 100; ++y) {
      const double z2 = 1 - k(x) * k(x) - k(y) * k(y);
      if (!(z2 > 0)) continue;
      const double part = drawn(x, y) / std::sqrt(z2);
      expected[cell(k(x), k(y))] += part;
      total += part;
    }
  double difference = 0;
  for (std::size_t i = 0; i < 100; ++i) difference += std::abs(got[i] / bins.flux() - expected[i] / total);
  EXPECT_LT(difference, 0.03) << "100,000 rays and squares cut across the table's steps";
  // The table itself, as bright as the drawn one where that is more than a tenth of its peak.
  const double scale = bins.flux() / (total * 4 / (99.0 * 99.0));
  std::size_t compared = 0;
  double squares = 0, peak = 0;
  for (std::size_t x = 0; x < 100; ++x)
    for (std::size_t y = 0; y < 100; ++y) peak = std::max(peak, drawn(x, y));
  for (std::size_t x = 0; x < 100; ++x)
    for (std::size_t y = 0; y < 100; ++y) {
      const double z2 = 1 - k(x) * k(x) - k(y) * k(y);
      if (!(z2 > 0) || drawn(x, y) < 0.1 * peak) continue;
      const Vec3 d(static_cast<float>(k(x)), static_cast<float>(-k(y)), static_cast<float>(-std::sqrt(z2)));
      const double error = intensity(table, d) / (drawn(x, y) * scale) - 1;
      squares += error * error;
      ++compared;
    }
  EXPECT_GT(compared, 50u);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(compared)), 0.1);
}

TEST(Rays, DamageIsNamed) {
  SCONCE_NEEDS_DATA(folder());
  const std::string whole = read_file(folder() / "Cyl10k.1.tm25ray");
  const auto file = std::filesystem::temp_directory_path() / "sconce-damaged.tm25ray";
  const auto error = [&](std::string bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      all_rays(file);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error(whole.substr(0, whole.size() - 5)).find("do not fit 10000 rays"), std::string::npos);
  EXPECT_NE(error(whole.substr(0, 200)).find("cut short"), std::string::npos);
  EXPECT_NE(error("solid").find("is no ray file"), std::string::npos);
  std::string bad = whole;
  bad[36288 + 28 * 3 + 12 + 3] = '\x7f';  // the fourth ray's direction
  EXPECT_NE(error(bad).find("no ray at number 4"), std::string::npos);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace sconce
