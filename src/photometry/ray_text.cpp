// SPDX-License-Identifier: Apache-2.0
// Ray files as text: LightTools' "Ray Data Export File" and Zemax' source file.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "photometry/ray_formats.h"

namespace sconce {

namespace {

class Reader {
 public:
  Reader(std::ifstream& in, uint64_t size, std::string where, const RaySink& sink, const Progress& progress)
      : in_(in), size_(size), where_(std::move(where)), sink_(sink), progress_(progress) {}

  RayFile run() {
    if (!next()) throw NotMyFormat(where_, "is empty");
    if (line_.find("LightTools") != std::string::npos) return light_tools();
    double head[2];
    if (numbers(head) == 2 && head[0] >= 1 && head[0] < 0x1p53 && head[0] == std::floor(head[0]) &&
        head[1] == std::floor(head[1]))
      return zemax(static_cast<uint64_t>(head[0]), head[1]);
    throw NotMyFormat(where_, "is no ray text");
  }

 private:
  bool next() {
    if (!std::getline(in_, line_)) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw Error(fmt::format("{}:{}", where_, at_), what, allowed);
  }

  /// Numbers of the line, at most N; -1 where a word is none.
  template <std::size_t N>
  int numbers(double (&out)[N]) const {
    int count = 0;
    const char *p = line_.data(), *end = p + line_.size();
    while (true) {
      while (p < end && (*p == ' ' || *p == '\t' || *p == ',' || *p == '\r')) ++p;
      if (p == end) return count;
      if (*p == '+') ++p;
      if (count == static_cast<int>(N)) return -1;
      const auto [after, error] = std::from_chars(p, end, out[count]);
      if (error != std::errc()) return -1;
      p = after;
      ++count;
    }
  }

  void ray(RayBlocks& blocks) {
    double v[8];
    const int count = numbers(v);
    if (count != 7 && count != 8) fail("is no ray", "7 or 8 numbers: place, direction, flux, wavelength");
    const auto f = [&](int i) { return static_cast<float>(v[i]); };
    blocks.add({f(0), f(1), f(2)}, {f(3), f(4), f(5)},
               colored_ && count == 8 ? RayColors::of_wavelength(f(7), f(6), watts_) : RayLight{f(6)});
    held_ += static_cast<double>(f(6));
    if (blocks.rays() % RayBlocks::kBlock == 0) {
      progress_.check();
      progress_.at("bytes", static_cast<uint64_t>(std::max<std::streamoff>(0, in_.tellg())), size_);
    }
  }

  /// "key: value" lines, lt_startofdata, a line a ray, lt_endofdata.
  RayFile light_tools() {
    RayFile out;
    out.format = "LightTools text";
    while (next() && trim(line_) != "lt_startofdata") {
      const std::size_t colon = line_.find(':');
      if (colon == std::string::npos) continue;
      const std::string key = trim(line_.substr(0, colon)), value = trim(line_.substr(colon + 1));
      if (key == "lt_datatype") {
        if (value != "radiant_power" && value != "luminous_power" && value != "radiometric" &&
            value != "photometric")
          fail("has the data type '" + value + "'", "radiant_power, luminous_power");
        out.luminous = value == "luminous_power" || value == "photometric";
      } else if (key == "lt_length_units" && value != "millimeters") {
        fail("has the length unit '" + value + "'", "millimeters");
      } else if (key == "lt_far_field_data" && value != "no") {
        fail("holds far-field data without places", "lt_far_field_data: no");
      } else if (key == "lt_radiant_flux" || key == "lt_luminous_flux") {
        out.stated = parse_number(value).value_or(0);
      }
    }
    if (trim(line_) != "lt_startofdata") fail("ends before lt_startofdata");
    look_at_colors();
    watts_ = colored_ && !out.luminous;
    if (watts_) out.luminous = true;
    RayBlocks blocks(sink_, where_, 1e-3);
    bool closed = false;
    while (!closed && next()) {
      closed = trim(line_) == "lt_endofdata";
      if (!closed) ray(blocks);
    }
    if (!closed) fail("ends before lt_endofdata");
    blocks.flush();
    out.rays = blocks.rays(), out.held = held_;
    return out;
  }

  /// How many rays and the code of their unit, then a line a ray.
  RayFile zemax(uint64_t count, double unit) {
    look_at_colors();
    RayBlocks blocks(sink_, where_, zemax_unit(unit, fmt::format("{}:{}", where_, at_)));
    while (next())
      if (!trim(line_).empty()) ray(blocks);
    if (blocks.rays() != count)
      fail(fmt::format("holds {} rays where its first line says {}", blocks.rays(), count));
    blocks.flush();
    progress_.warn(where_ +
                   ": the text does not say whether its fluxes are watts or lumens: lumens are assumed");
    return {"Zemax text", count, true, 0, held_};
  }

  /// Do the first rays have wavelengths, and not all the same?
  void look_at_colors() {
    const std::streampos begin = in_.tellg();
    const uint64_t line = at_;
    double v[8];
    float first = 0;
    for (std::size_t i = 0; i < kLookedAt && next() && numbers(v) == 8; ++i) {
      if (i == 0) first = static_cast<float>(v[7]);
      colored_ |= static_cast<float>(v[7]) != first;
    }
    if (!colored_ && first > 0) progress_.warn(where_ + ": " + one_wavelength(first));
    in_.clear();
    in_.seekg(begin);
    at_ = line;
  }

  std::ifstream& in_;
  uint64_t size_, at_ = 0;
  std::string where_, line_;
  bool colored_ = false, watts_ = false;
  double held_ = 0;  ///< flux of all rays as they stand
  const RaySink& sink_;
  const Progress& progress_;
};

}  // namespace

RayFile read_text_rays(std::ifstream& in, uint64_t size, const std::string& where, const RaySink& sink,
                       const Progress& progress) {
  return Reader(in, size, where, sink, progress).run();
}

}  // namespace sconce
