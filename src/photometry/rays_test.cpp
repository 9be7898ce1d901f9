// SPDX-License-Identifier: Apache-2.0
// Ray files of other programs against what they were made from.
#include "photometry/rays.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

#include "core/error.h"
#include "core/files.h"
#include "core/observer.h"
#include "core/sobol.h"
#include "core/test_data.h"
#include "core/test_folder.h"
#include "core/text.h"
#include "photometry/light_field.h"
#include "photometry/lines.h"
#include "photometry/ray_writer.h"

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

// Three rays, binary and as text; light along +z of the file goes to nadir.
TEST(Rays, ThreeRaysInFourLayouts) {
  SCONCE_NEEDS_DATA(folder());
  for (const char* name :
       {"ThreeRays_PowerOnly.1.ray", "ThreeRays_Wavelength.1.ray", "ThreeRays_Wavelength_ZMX.ray",
        "ThreeRays_Wavelength_ZMW_to_LT.ray", "ThreeRays_Wavelength.1.txt"}) {
    RayFile file;
    const auto rays = all_rays(folder() / "RayFileConverter" / name, &file);
    ASSERT_EQ(rays.size(), 3u) << name;
    EXPECT_NEAR(rays[0].position.x, -0.6668399e-3f, 1e-9f) << name;
    EXPECT_NEAR(rays[0].position.y, 0.3333333e-3f, 1e-9f) << name;
    EXPECT_NEAR(rays[0].direction.x, -0.8660254f, 1e-6f) << name;
    EXPECT_NEAR(rays[0].direction.z, -0.5f, 1e-6f) << name;
    EXPECT_NEAR(rays[2].direction.y, 0.9682459f, 1e-6f) << name;
    EXPECT_NEAR(file.held, 0.0093198, 1e-7) << name;
    // Watts of 550, 450 and 620 nm are lumens.
    const bool colored = std::string_view(name).find("Wavelength") != std::string_view::npos;
    EXPECT_EQ(file.luminous, colored) << name;
    EXPECT_NEAR(rays[1].flux, colored ? 0.004659902f * 683 * 0.038f : 0.004659902f, 1e-6f) << name;
    const Xyz blue = xyz_of(rays[1].color);
    if (colored) {
      EXPECT_NEAR(blue[0] / blue[1], 0.3362 / 0.038, 0.01) << name;
      EXPECT_NEAR(blue[2] / blue[1], 1.7721 / 0.038, 0.05) << name;
    } else {
      EXPECT_EQ(rays[1].color, Rgb(1));
    }
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

// Planes crowd about the pole; a table of many must not show the noise of the few rays between them there.
TEST(Rays, FarFieldIsEvenAboutThePole) {
  FarFieldBins bins(72, 180);
  std::vector<SourceRay> rays;
  constexpr uint32_t kRays = 1 << 19;
  for (uint32_t i = 0; i < kRays; ++i) {  // Lambertian
    const Vec2 u = sobol_pair(i, 0, 3);
    const float s = std::sqrt(u.x), phi = 2 * kPi * u.y;
    rays.push_back({Vec3(0), {s * std::cos(phi), s * std::sin(phi), -std::sqrt(1 - u.x)}, kPi / kRays});
  }
  bins.add(rays);
  const Photometry table = bins.table();
  for (std::size_t a = 0; a < table.azimuths.size(); ++a)
    for (std::size_t g = 0; g < 12; ++g)
      EXPECT_NEAR(table.at(a, g), std::cos(static_cast<double>(g) * std::numbers::pi / 180), 0.35)
          << a << " " << g;
}

template <class... T>
std::string bytes_of(T... values) {
  std::string out;
  (out.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return out;
}

// The other layouts, as public readers of them describe them: two rays at (1, 2, 3) mm, along +z and (0, 0.6,
// 0.8).
TEST(Rays, OtherLayouts) {
  const TemporaryFolder folder;
  const auto expect_two = [&](const std::filesystem::path& path, const char* format, bool luminous,
                              bool placed) {
    RayFile file;
    const auto rays = all_rays(path, &file);
    EXPECT_EQ(file.format, format);
    EXPECT_EQ(file.luminous, luminous) << format;
    ASSERT_EQ(rays.size(), 2u) << format;
    EXPECT_LT(glm::length(rays[1].position - (placed ? Vec3(1, -2, -3) : Vec3(7, -8, -9)) * 1e-3f), 1e-8f)
        << format;
    EXPECT_LT(glm::length(rays[0].direction - Vec3(0, 0, -1)), 1e-6f) << format;
    EXPECT_LT(glm::length(rays[1].direction - Vec3(0, -0.6f, -0.8f)), 1e-6f) << format;
    // Where wavelengths are told, 683 lm/W at 550 and 620 nm.
    const bool lumens = std::string_view(format) == "SPEOS";
    EXPECT_FLOAT_EQ(rays[0].flux, lumens ? 0.25f * 683 * 0.995f : 0.25f) << format;
    EXPECT_FLOAT_EQ(rays[1].flux, lumens ? 0.5f * 683 * 0.381f : 0.5f) << format;
  };
  const auto ray = [](float dy, float dz) { return bytes_of(1.0f, 2.0f, 3.0f, 0.0f, dy, dz); };
  expect_two(
      folder.write("speos.ray", bytes_of(0.75f, 0, 0, 0, 0, 0, 200.0f) + ray(0, 1) + bytes_of(550.0f, 0.25f) +
                                    ray(0.6f, 0.8f) + bytes_of(620.0f, 0.5f)),
      "SPEOS", true, true);
  std::string asap =
      bytes_of(4 * 256 * 7 + 247) + std::string(104, '\0') + bytes_of(-2) + std::string(28, '\0');
  expect_two(folder.write("rays.dis", asap + ray(0, 1) + bytes_of(0.25f) + ray(0.6f, 0.8f) + bytes_of(0.5f)),
             "ASAP", false, true);
  expect_two(folder.write("far.ray", "LTRF" +
                                         bytes_of(2, 0, 1, 1, 0, 1, 7.0f, 8.0f, 9.0f, 0.75f, 0.0f, 0.0f, 1.0f,
                                                  0.25f, 0.0f, 0.6f, 0.8f, 0.5f) +
                                         "LTRFEND"),
             "LightTools", true, false);
  expect_two(folder.write("zemax.dat", "2 4\n1 2 3 0 0 1 0.25\n1 2 3 0 +6e-1 0.8 0.5 0.55\n"), "Zemax text",
             true, true);
  const auto error = [&](const char* name, const std::string& text) {
    try {
      all_rays(folder.write(name, text));
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error("a.dat", "2 4\n1 2 3 0 0 1 0.25\n1 2 x\n").find("a.dat:3: is no ray"), std::string::npos);
  EXPECT_NE(
      error("a.dat", "2 4\n1 2 3 0 0 1 0.25\n").find("a.dat:2: holds 1 rays where its first line says 2"),
      std::string::npos);
  EXPECT_NE(error("a.dat", "inf 4\n").find("a.dat: is no ray file"), std::string::npos);
  EXPECT_NE(error("a.dat", "2 9\n").find("a.dat:1: has the unit code 9"), std::string::npos);
  EXPECT_NE(
      error("a.ray", "# LightTools 9\nlt_datatype: photons\n").find("a.ray:2: has the data type 'photons'"),
      std::string::npos);
  EXPECT_NE(error("a.ray", "# LightTools 9\nlt_startofdata\n1 2 3 0 0 1 1\n")
                .find("a.ray:3: ends before lt_endofdata"),
            std::string::npos);
}

/// A TM-25 file of watts that are luminous by spectra, of lumens with tristimulus values, and of one
/// wavelength.
TEST(Rays, ColoursOfTm25) {
  const TemporaryFolder folder;
  const auto file = [&](std::array<int, 8> flags, const std::string& spectra, int count,
                        const std::string& rays) {
    std::string head = "TM25" + bytes_of(2013, 0, 0.0f, 0.0f, uint64_t{2}) + std::string(256 - 28, '\0');
    std::memcpy(head.data() + 76, &count, sizeof count);
    for (const int flag : flags) head += bytes_of(flag);
    return folder.write("colours.tm25ray", head + std::string(36000, '\0') + spectra + rays);
  };
  const std::string at = bytes_of(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
  // Equal energy from 380 to 770 nm, whose luminosity integrates to 106.857 nm; one line of 600 nm.
  std::string flat = bytes_of(40);
  for (int i = 0; i < 40; ++i) flat += bytes_of(380.0f + 10 * static_cast<float>(i), 1.0f);
  flat += bytes_of(2, 600.0f, 2.0f, 600.001f, 2.0f);
  RayFile read;
  auto rays = all_rays(
      file({1, 1, 1, 0, 0, 0, 0, 1}, flat, 2, at + bytes_of(1.0f, 1.0f) + at + bytes_of(2.0f, 2.0f)), &read);
  EXPECT_TRUE(read.luminous);
  EXPECT_NEAR(read.held, 3, 1e-6);
  EXPECT_NEAR(rays[0].flux, 683 * 106.857 / 390, 0.2);
  EXPECT_NEAR(rays[1].flux, 2 * 683 * 0.631, 0.01);
  const Xyz even = xyz_of(rays[0].color);  // illuminant E
  EXPECT_NEAR(even[0], 1, 0.003);
  EXPECT_NEAR(even[2], 1, 0.003);
  // Lumens, X and Z.
  rays = all_rays(file({1, 1, 0, 0, 1, 0, 1, 0}, "", 0,
                       at + bytes_of(2.0f, 1.9f, 2.2f) + at + bytes_of(1.0f, 1.0f, 0.5f)),
                  &read);
  EXPECT_EQ(rays[0].flux, 2);
  EXPECT_NEAR(xyz_of(rays[0].color)[0], 0.95, 1e-4);
  EXPECT_NEAR(xyz_of(rays[1].color)[2], 0.5, 1e-4);
  // Written with their colours, they come back.
  RayWriter writer(folder / "again.tm25ray", true, true);
  writer.add(rays);
  writer.finish();
  const auto again = all_rays(folder / "again.tm25ray");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].flux, rays[i].flux);
    EXPECT_LT(std::abs((again[i].color - rays[i].color).b), 1e-4f);
    EXPECT_LT(std::abs((again[i].color - rays[i].color).r), 1e-4f);
  }
  // One wavelength is a mark: watts stay watts.
  Progress progress;
  std::string said;
  progress.warning = [&](const std::string& line) { said = line; };
  const auto path =
      file({1, 1, 1, 1, 0, 0, 0, 0}, "", 0, at + bytes_of(1.0f, 550.0f) + at + bytes_of(1.0f, 550.0f));
  read = read_rays(
      path, [](std::span<const SourceRay>) {}, progress);
  EXPECT_FALSE(read.luminous);
  EXPECT_NE(said.find("all rays have the wavelength 550"), std::string::npos) << said;
}

/// Peak memory of this process, bytes.
double peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// A Lambertian disk of 1.5 M rays with unequal flux, 42 MB: every way through keeps the flux, memory stays
// far below the file.
TEST(Rays, ManyRaysAreStreamedAndKeepTheirFlux) {
  constexpr uint64_t kRays = 1500000;
  const TemporaryFolder folder;
  const auto path = folder / "many.tm25ray";
  RayWriter writer(path, true);
  std::vector<SourceRay> block;
  double written = 0;
  for (uint64_t i = 0; i < kRays; ++i) {
    const Vec2 a = sobol_pair(static_cast<uint32_t>(i), 0, 7), b = sobol_pair(static_cast<uint32_t>(i), 1, 7);
    const float r = 0.02f * std::sqrt(a.x), phi = 6.2831853f * a.y, s = std::sqrt(b.x),
                psi = 6.2831853f * b.y;
    block.push_back({{r * std::cos(phi), r * std::sin(phi), 0},
                     {s * std::cos(psi), s * std::sin(psi), -std::sqrt(1 - b.x)},
                     1e-3f * (0.1f + a.x)});
    written += static_cast<double>(block.back().flux);
    if (block.size() == 10000) writer.add(block), block.clear();
  }
  writer.finish();
  FarFieldBins bins(24, 36);
  LightFieldBuilder builder(
      make_light_field(NearBasis::spline, Vec2(-0.02f), Vec2(0.02f), 0.01, 0.1, 0.1, 24));
  std::size_t largest = 0;
  const double before = peak_memory();
  const RayFile file = read_rays(path, [&](std::span<const SourceRay> rays) {
    largest = std::max(largest, rays.size());
    bins.add(rays);
    builder.add(rays);
  });
  EXPECT_LT(peak_memory() - before, 16e6);
  EXPECT_LE(largest, 65536u);
  EXPECT_EQ(file.rays, kRays);
  EXPECT_NEAR(file.stated / written, 1, 1e-7) << "a 32-bit float in the header";
  EXPECT_NEAR(bins.flux() / written, 1, 1e-9);
  EXPECT_NEAR(flux(bins.table()) / written, 1, 1e-9);
  EXPECT_NEAR((builder.kept() + builder.lost()) / written, 1, 1e-9);
  const double kept = builder.kept();
  EXPECT_NEAR(flux(std::move(builder).finish()) / kept, 1, 1e-7) << "its pixels are 32-bit floats";
  EXPECT_NEAR(intensity(bins.table(), Vec3(0, 0.6f, -0.8f)) / (0.8 * written / M_PI), 1, 0.04)
      << "Lambert, 5,000 rays a bin";
}

TEST(Rays, DamageIsNamed) {
  SCONCE_NEEDS_DATA(folder());
  const std::string whole = read_file(folder() / "Cyl10k.1.tm25ray");
  const TemporaryFolder scratch;
  const auto file = scratch / "damaged.tm25ray";
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
}

}  // namespace
}  // namespace sconce
