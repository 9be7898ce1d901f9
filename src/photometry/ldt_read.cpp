// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "photometry/circle.h"
#include "photometry/formats.h"
#include "photometry/lines.h"

namespace sconce {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr int kMostPlanes = 3600, kMostAngles = 3600;
constexpr std::size_t kDirectRatios = 10;

/// The lines of an EULUMDAT file one after the other; each has its meaning by its place.
class Reader {
 public:
  Reader(std::string_view text, const std::string& where) : lines_(lines_of(text)), where_(where) {}

  Photometry run() {
    check_mine();
    out_.format = "EULUMDAT";
    keyword("MANUFAC");
    line_ = 3;  // type and symmetry were read by check_mine
    const int planes = integer("the number of C planes, Mc", 1, kMostPlanes);
    number("the distance of C planes, Dc", 0);
    const auto angles =
        static_cast<std::size_t>(integer("the number of intensities in a plane, Ng", 1, kMostAngles));
    number("the distance of intensities, Dg", 0);
    keyword("TEST"), keyword("LUMINAIRE"), keyword("LUMCAT"), keyword("_FILE"), keyword("ISSUEDATE");
    for (const char* what : {"the luminaire's length", "the luminaire's width", "the luminaire's height"})
      number(what, 0);
    read_opening();
    number("the downward flux fraction, DFF", 0);
    const double output_ratio = number("the light output ratio, LORL", 0);
    const double conversion = number("the conversion factor", 1);
    const double tilt = number("the tilt in measurement", 0);
    if (tilt != 0)
      note(fmt::format("measured at a tilt of {} degrees; the table is taken as it stands", tilt));
    read_lamps();
    for (std::size_t i = 0; i < kDirectRatios; ++i) number("direct ratio DR", 0);
    std::vector<double> c = ascending(static_cast<std::size_t>(planes), "C angle");
    out_.polars = ascending(angles, "G angle");
    if (out_.polars.front() < 0 || out_.polars.back() > 180) fail("G angles leave the range", "0 to 180");
    read_intensities(c, (conversion > 0 ? conversion : 1) * out_.lamps.front().lumens / 1000);
    if (output_ratio > 0) out_.stated = out_.lamps.front().lumens * output_ratio / 100;
    return std::move(out_);
  }

 private:
  void note(const std::string& what) { out_.notes.push_back(fmt::format("line {}: {}", line_, what)); }
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw Error(fmt::format("{}:{}", where_, line_), what, allowed);
  }

  /// An LDT is known by its second and third line: type 1 to 3, symmetry 0 to 4.
  void check_mine() {
    const auto code = [&](std::size_t line) {
      return line < lines_.size() ? parse_number(trim(lines_[line])).value_or(-1) : -1;
    };
    const auto need = [&](std::size_t line, bool good, const char* what, const char* allowed) {
      if (!good) throw NotMyFormat(fmt::format("{}:{}", where_, line + 1), what, allowed);
    };
    const auto whole = [&](std::size_t line, double most) {
      return code(line) >= 0 && code(line) <= most && code(line) == std::floor(code(line));
    };
    const double symmetry = code(2);
    // Makers write type 0 for point symmetric lamps.
    need(1, whole(1, 3), "is no type of an EULUMDAT file", "1 to 3");
    need(2, whole(2, 4), "is no symmetry of an EULUMDAT file, Isym", "0 to 4");
    need(3, code(3) > 0, "is no number of C planes of an EULUMDAT file, Mc", "a whole number from 1 to 3600");
    symmetry_ = static_cast<int>(symmetry);
  }

  const std::string& next(const std::string& what) {
    if (line_ >= lines_.size()) {
      line_ = std::max<std::size_t>(lines_.size(), 1);
      fail("ends before " + what);
    }
    return lines_[line_++];
  }
  void keyword(const char* key) {
    if (std::string text = trim(next(key)); !text.empty()) out_.keywords.emplace_back(key, std::move(text));
  }

  /// A line's number; `otherwise` where the line is empty.
  double number(const std::string& what, double otherwise) {
    std::string text = trim(next(what));
    if (text.empty()) return otherwise;
    if (std::replace(text.begin(), text.end(), ',', '.');
        !told_comma_ && lines_[line_ - 1].find(',') != std::string::npos) {
      note("decimal commas are read as points");
      told_comma_ = true;
    }
    const auto v = parse_number(text);
    if (!v || !std::isfinite(*v))
      fail("'" + trim(lines_[line_ - 1]) + "' stands where " + what + " should", "a number");
    return *v;
  }
  double needed(const std::string& what) {
    const double v = number(what, std::nan(""));
    if (std::isnan(v)) fail("the line is empty where " + what + " should stand", "a number");
    return v;
  }
  int integer(const std::string& what, int least, int most) {
    const double v = needed(what);
    if (v != std::floor(v) || v < least || v > most)
      fail(what + " is " + fmt::format("{}", v), fmt::format("a whole number from {} to {}", least, most));
    return static_cast<int>(v);
  }
  std::vector<double> ascending(std::size_t count, const std::string& what) {
    std::vector<double> out;
    while (out.size() < count) {
      const double v = needed(fmt::format("{} {} of {}", what, out.size() + 1, count));
      if (!out.empty() && !(v > out.back()))
        fail(fmt::format("{} {} of {} is not above the one before", what, out.size() + 1, count));
      out.push_back(v);
    }
    return out;
  }

  /// Length lies along C90 (the long axis of a batten), width along C0; width 0 means round.
  void read_opening() {
    const double length = number("the length of the luminous area", 0), width = number("its width", 0);
    double height = 0;
    for (const char* plane : {"C0", "C90", "C180", "C270"})
      height = std::max(height, number(fmt::format("the luminous height at {}", plane), 0));
    if (length < 0 || width < 0) fail("the luminous area has a negative size", "millimetres");
    const bool round = width == 0 && length > 0;
    if (round) out_.opening.shape = Opening::Shape::cylinder;
    out_.opening.size =
        Vec3(static_cast<float>((round ? length : width) * kMillimetre),
             static_cast<float>(length * kMillimetre), static_cast<float>(height * kMillimetre));
  }

  void read_lamps() {
    const std::string count_text = trim(next("the number of lamp sets"));
    const double sets = count_text.empty() ? 1 : parse_number(count_text).value_or(0);
    if (!(sets >= 1 && sets <= 20 && sets == std::floor(sets)))
      fail("the number of lamp sets is '" + count_text + "'", "1 to 20");
    for (int set = 0; set < static_cast<int>(sets); ++set) {
      LampSet lamp;
      const double count = number("the number of lamps", 1);
      if (count < 0) out_.absolute = true;
      lamp.count = std::max(1.0, std::abs(count));
      lamp.name = trim(next("the type of lamps"));
      lamp.lumens = needed("the lamps' luminous flux");
      if (!(lamp.lumens > 0))
        fail("the lamps' luminous flux is not positive", "lumens > 0: intensities are per 1000 of them");
      lamp.color = trim(next("the lamps' colour"));
      lamp.rendering = trim(next("the lamps' colour rendering"));
      lamp.watts = number("the wattage", 0);
      out_.lamps.push_back(std::move(lamp));
    }
  }

  /// Which planes the file holds of its Mc, by symmetry; the others are mirrored.
  std::vector<double> held(std::vector<double>& c) {
    const std::size_t n = c.size();
    const auto take = [&](std::size_t from, std::size_t count) {
      if (from + count > n)
        fail(fmt::format("Mc = {} does not fit symmetry {}", n, symmetry_), "a multiple of 4");
      return std::vector<double>(c.begin() + static_cast<std::ptrdiff_t>(from),
                                 c.begin() + static_cast<std::ptrdiff_t>(from + count));
    };
    switch (symmetry_) {
      case 1:
        return {0};
      case 2:
        return take(0, n / 2 + 1);
      case 3: {
        // From C270 through C0 to C90.
        std::vector<double> out = take(3 * n / 4, n - 3 * n / 4);
        const std::vector<double> rest = take(0, n / 4 + 1);
        for (const double v : rest) out.push_back(v + 360);
        return out;
      }
      case 4:
        return take(0, n / 4 + 1);
      default:
        return c;
    }
  }

  void read_intensities(std::vector<double>& c, double factor) {
    if (c.front() < 0 || c.back() > 360) fail("C angles leave the range", "0 to 360");
    const std::vector<double> planes = held(c);
    const std::size_t rows = out_.polars.size();
    std::vector<double> values;
    std::size_t negative = 0;
    for (std::size_t i = 0; i < planes.size() * rows; ++i) {
      double v = needed(fmt::format("intensity {} of {}", i + 1, planes.size() * rows)) * factor;
      if (v < 0) v = 0, ++negative;
      values.push_back(v);
    }
    if (negative > 0) note(fmt::format("{} intensities are negative and count as 0", negative));
    std::size_t more = 0;
    for (std::size_t i = line_; i < lines_.size(); ++i) more += parse_number(trim(lines_[i])).has_value();
    if (more > 0)
      note(fmt::format(
          "{} numbers after the last intensity are ignored; do the symmetry (line 3) and the numbers of "
          "planes and angles (lines 4 and 6) fit?",
          more));
    const auto mirror = [&](auto&& image) {
      for (std::size_t i = 0; i < planes.size(); ++i)
        for (const double at : image(planes[i])) put(at, values, i);
    };
    switch (symmetry_) {
      case 1:
        put(0, values, 0), put(360, values, 0);
        break;
      case 2:
        mirror([](double a) { return std::array{a, 360 - a}; });
        break;
      case 3:
        mirror([](double a) { return std::array{std::fmod(a, 360), std::fmod(540 - a, 360)}; });
        break;
      case 4:
        mirror([](double a) { return std::array{a, 180 - a, 180 + a, 360 - a}; });
        break;
      default:
        mirror([](double a) { return std::array{a}; });
        break;
    }
    for (const auto& [azimuth, column] : table_) {
      out_.azimuths.push_back(azimuth);
      out_.candela.insert(out_.candela.end(), column.begin(), column.end());
    }
    close_circle(out_);
  }

  /// Sorted by angle; what is there already stays.
  void put(double azimuth, const std::vector<double>& values, std::size_t plane) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(plane * out_.polars.size());
    const std::vector<double> column(from, from + static_cast<std::ptrdiff_t>(out_.polars.size()));
    const auto after = std::lower_bound(table_.begin(), table_.end(), azimuth - 1e-6,
                                        [](const auto& entry, double v) { return entry.first < v; });
    if (after != table_.end() && after->first < azimuth + 1e-6) return;
    table_.insert(after, {azimuth, column});
  }

  std::vector<std::string> lines_;
  std::string where_;
  std::size_t line_ = 0;  ///< lines read so far: the number of the one read last
  int symmetry_ = 0;
  bool told_comma_ = false;
  std::vector<std::pair<double, std::vector<double>>> table_;
  Photometry out_;
};

}  // namespace

Photometry parse_ldt(std::string_view text, const std::string& where) {
  return Reader(text, where).run();
}

}  // namespace sconce
