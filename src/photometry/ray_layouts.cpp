// SPDX-License-Identifier: Apache-2.0
// Headers of binary ray files. Layouts of TM-25 and Zemax by their documents, of the others as public readers
// of them (TM25RaySetTools, pyansys' optical automation) and the shared examples show them.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "photometry/ray_formats.h"

namespace sconce {

namespace {

static_assert(std::endian::native == std::endian::little, "ray files are little-endian");

constexpr double kMillimetre = 1e-3;

class Bytes {
 public:
  /// The first bytes of a file, 512 at most.
  explicit Bytes(std::ifstream& in) {
    head_.resize(512);
    in.read(head_.data(), static_cast<std::streamsize>(head_.size()));
    head_.resize(static_cast<std::size_t>(in.gcount()));
    in.clear();
  }
  template <class T>
  T at(std::size_t offset) const {
    T v{};
    if (offset + sizeof v <= head_.size()) std::memcpy(&v, head_.data() + offset, sizeof v);
    return v;
  }
  bool starts_with(std::string_view text) const { return head_.starts_with(text); }
  std::size_t size() const { return head_.size(); }

 private:
  std::string head_;
};

/// A table of wavelengths and weights, by trapezoids: the observer's functions in the mean over it.
Xyz mean_of_spectrum(std::ifstream& in, int32_t pairs, const std::string& where) {
  Xyz sum{};
  double all = 0;
  float last[2] = {}, next[2] = {};
  for (int32_t i = 0; i < pairs; ++i, std::copy(next, next + 2, last)) {
    in.read(reinterpret_cast<char*>(next), sizeof next);
    if (!in || !(next[1] >= 0) || !std::isfinite(next[0]) || !std::isfinite(next[1]) ||
        (i > 0 && !(next[0] > last[0])))
      throw Error(where, fmt::format("is damaged at its value {}", i + 1),
                  "ascending wavelengths with weights from 0 on");
    if (i == 0) continue;
    const double width = 0.5 * (static_cast<double>(next[0]) - static_cast<double>(last[0]));
    for (const float* end : {last, next}) {
      const Xyz eye = observer(static_cast<double>(end[0]));
      const double weight = width * static_cast<double>(end[1]);
      all += weight;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * eye[c];
    }
  }
  for (double& v : sum) v = all > 0 ? v / all : 0;
  return sum;
}

/// IES TM-25-13: 256 bytes of numbers, 8 flags of what a ray holds, 9 texts of 1000 UTF-32 characters,
/// spectra, labels of further columns, a text, rays.
RayLayout tm25(const Bytes& head, std::ifstream& in, const std::string& where) {
  constexpr std::size_t kFlags = 256, kTexts = kFlags + 32, kAfterTexts = kTexts + 9 * 4000;
  if (head.size() < kTexts) throw Error(where, "is cut short in its header", "288 bytes at least");
  RayLayout out;
  out.file = {"IES TM-25", head.at<uint64_t>(20), true, 0};
  if (const int version = head.at<int32_t>(4); version != 2013)
    throw Error(where, fmt::format("is TM-25 version {}", version), "2013");
  const auto flag = [&](std::size_t i) { return head.at<int32_t>(kFlags + 4 * i) != 0; };
  // Position, direction, radiant flux, wavelength, luminous flux, Stokes (3), tristimulus (2), spectrum
  // index.
  if (!flag(0) || !flag(1)) throw Error(where, "holds rays without position or direction");
  const bool radiant = flag(2), wavelength = flag(3), luminous = flag(4);
  if (!radiant && !luminous) throw Error(where, "holds rays without flux");
  out.file.luminous = luminous;
  // Makers leave it at nothing or not a number.
  if (const float total = head.at<float>(luminous ? 12 : 16); total > 0 && std::isfinite(total))
    out.file.stated = static_cast<double>(total);
  out.flux = 6 + (luminous ? (radiant ? 1u : 0u) + (wavelength ? 1u : 0u) : 0u);
  const int spectra = head.at<int32_t>(76), more = head.at<int32_t>(80), text = head.at<int32_t>(84);
  if (spectra < 0 || more < 0 || text < 0) throw Error(where, "has negative counts in its header");
  out.numbers = 6 + (radiant ? 1u : 0u) + (wavelength ? 1u : 0u) + (luminous ? 1u : 0u) +
                (flag(5) ? 3u : 0u) + (flag(6) ? 2u : 0u) + (flag(7) ? 1u : 0u) +
                static_cast<std::size_t>(more);
  out.offset = kAfterTexts;
  for (int i = 0; i < spectra; ++i) {
    int32_t pairs = -1;
    in.seekg(static_cast<std::streamoff>(out.offset));
    in.read(reinterpret_cast<char*>(&pairs), sizeof pairs);
    if (!in || pairs < 0) throw Error(where, fmt::format("is damaged in spectrum {}", i + 1));
    out.offset += 4 + 8 * static_cast<uint64_t>(pairs);
    out.colors.spectra.push_back(mean_of_spectrum(in, pairs, fmt::format("{}: spectrum {}", where, i + 1)));
  }
  // Tristimulus values need Y, the luminous flux, beside X and Z.
  std::size_t at = 6 + (radiant ? 1u : 0u);
  const std::size_t by_wavelength = at;
  at += (wavelength ? 1u : 0u) + (luminous ? 1u : 0u) + (flag(5) ? 3u : 0u);
  if (flag(6) && luminous)
    out.colors.by = RayColors::By::tristimulus, out.colors.column = at;
  else if (flag(7) && spectra > 0)
    out.colors.by = RayColors::By::spectrum, out.colors.column = at + (flag(6) ? 2u : 0u);
  else if (wavelength)
    out.colors.by = RayColors::By::wavelength, out.colors.column = by_wavelength;
  out.offset += 2048 * static_cast<uint64_t>(more) + 4 * static_cast<uint64_t>(text);
  return out;
}

/// LightTools' binary ray data: 44 bytes, rays, "LTRFEND".
RayLayout light_tools(const Bytes& head, uint64_t size, const std::string& where) {
  RayLayout out;
  const int kind = head.at<int32_t>(12), far = head.at<int32_t>(16), color = head.at<int32_t>(20),
            units = head.at<int32_t>(24);
  if (color != 0 && color != 2)
    throw Error(where, fmt::format("has the colour code {}", color), "0 (none), 2 (wavelength)");
  if (units != 1) throw Error(where, fmt::format("has the unit code {}", units), "1 (millimetres)");
  if (far != 0 && far != 1) throw Error(where, fmt::format("has the far-field code {}", far), "0, 1");
  out.file = {"LightTools", 0, kind == 1, 0};
  out.placed = far == 0;
  out.origin = {head.at<float>(28), head.at<float>(32), head.at<float>(36)};
  if (!out.placed && !std::isfinite(glm::length(out.origin)))
    throw Error(where, "has an origin that is no number");
  out.flux = out.placed ? 6 : 3;
  out.numbers = out.flux + (color == 2 ? 2 : 1);
  if (color == 2) out.colors.by = RayColors::By::wavelength, out.colors.column = out.flux + 1;
  out.offset = 44;
  out.tail = 7;
  if (size > out.offset + out.tail) out.file.rays = (size - out.offset - out.tail) / (4 * out.numbers);
  return out;
}

/// Zemax: 208 bytes, rays; format 0 has a flux, format 2 a wavelength after it.
RayLayout zemax(const Bytes& head, const std::string& where) {
  RayLayout out;
  const int units = head.at<int32_t>(136), format = head.at<int32_t>(192), kind = head.at<int32_t>(196);
  out.unit = zemax_unit(units, where);
  if (format != 0 && format != 2) throw Error(where, fmt::format("is Zemax ray format {}", format), "0, 2");
  out.file = {"Zemax", head.at<uint32_t>(4), kind == 1, static_cast<double>(head.at<float>(112))};
  out.numbers = format == 2 ? 8 : 7;
  if (format == 2) out.colors.by = RayColors::By::wavelength, out.colors.column = 7;
  out.offset = 208;
  return out;
}

/// ASAP .dis: five records, 140 bytes, rays of seven numbers. It does not say its units.
RayLayout asap(const Bytes& head) {
  RayLayout out;
  // Negative in its header, as there the count stands where an image has its height.
  const int64_t count = -static_cast<int64_t>(head.at<int32_t>(108));
  out.file = {"ASAP", static_cast<uint64_t>(std::max<int64_t>(0, count)), false, 0};
  out.offset = 140;
  out.assumed = "says no units: millimetres and watts are assumed";
  return out;
}

/// SPEOS .ray: no mark of its own. 28 bytes (watts first, lumens last), rays with a wavelength in nm before
/// their power in watts.
std::optional<RayLayout> speos(const Bytes& head, uint64_t size) {
  constexpr std::size_t kHeader = 28, kRay = 32;
  if (size < kHeader + kRay || (size - kHeader) % kRay != 0) return std::nullopt;
  const Vec3 direction(head.at<float>(kHeader + 12), head.at<float>(kHeader + 16),
                       head.at<float>(kHeader + 20));
  const float wavelength = head.at<float>(kHeader + 24), watts = head.at<float>(0),
              lumens = head.at<float>(24);
  if (!(std::abs(glm::length(direction) - 1) < 1e-3f && wavelength > 100 && wavelength < 10000 && watts > 0 &&
        std::isfinite(watts) && lumens >= 0 && std::isfinite(lumens)))
    return std::nullopt;
  RayLayout out;
  out.file = {"SPEOS", (size - kHeader) / kRay, false, static_cast<double>(watts)};
  out.offset = kHeader;
  out.numbers = 8;
  out.flux = 7;
  out.colors.by = RayColors::By::wavelength, out.colors.column = 6;
  return out;
}

}  // namespace

double zemax_unit(double code, const std::string& where) {
  constexpr double kUnits[] = {1, 0.0254, 0.01, 0.3048, kMillimetre};
  if (!(code >= 0 && code <= 4)) throw Error(where, fmt::format("has the unit code {}", code), "0 to 4");
  return kUnits[static_cast<int>(code)];
}

RayLayout ray_layout(std::ifstream& in, uint64_t size, const std::string& where) {
  constexpr int kZemax = 1010,
                kAsap = 4 * 256 * 7 + 247;  // first words: a version; a code of seven numbers a ray
  const Bytes head(in);
  if (head.starts_with("TM25")) return tm25(head, in, where);
  if (head.starts_with("LTRF")) return light_tools(head, size, where);
  if (head.at<int32_t>(0) == kZemax && head.size() >= 208) return zemax(head, where);
  if (head.at<int32_t>(0) == kAsap) return asap(head);
  if (const auto layout = speos(head, size)) return *layout;
  throw NotMyFormat(
      where, "is no ray file that can be read",
      "IES TM-25, LightTools .ray (binary, text), Zemax .dat and .sdf (binary, text), SPEOS .ray, ASAP .dis");
}

}  // namespace sconce
