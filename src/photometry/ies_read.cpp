// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "photometry/circle.h"
#include "photometry/formats.h"
#include "photometry/lines.h"

namespace sconce {

namespace {

constexpr double kFoot = 0.3048;
constexpr int kMostAngles = 10000;  // a file with more is no luminaire but damage

struct Header {
  const char* text;
  const char* name;
  int year;
};
constexpr Header kHeaders[] = {
    {"IESNA86", "LM-63-1986", 1986},          {"IESNA91", "LM-63-1991", 1991},
    {"IESNA95", "LM-63-1995", 1995},          {"IESNA:LM-63-1995", "LM-63-1995", 1995},
    {"IESNA:LM-63-2002", "LM-63-2002", 2002}, {"IES:LM-63-2019", "LM-63-2019", 2019},
};

bool equal(double a, double b) {
  return std::abs(a - b) < 1e-6;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& where, const std::filesystem::path& folder)
      : lines_(lines_of(text)), where_(where), folder_(folder) {}

  Photometry run() {
    const std::size_t tilt = find_tilt();
    read_header(tilt);
    Numbers numbers(lines_, tilt + 1, where_);
    read_tilt(trim(lines_[tilt].substr(lines_[tilt].find('=') + 1)), at(tilt), numbers);
    read_table(numbers);
    if (numbers.more()) note(numbers.line(), "text after the last candela value is ignored");
    return std::move(out_);
  }

 private:
  std::string at(std::size_t index) const { return where_ + ":" + std::to_string(index + 1); }
  void note(int line, const std::string& what) {
    out_.notes.push_back(fmt::format("line {}: {}", line, what));
  }

  [[noreturn]] void fail(int line, const std::string& what, const std::string& allowed) const {
    throw Error(fmt::format("{}:{}", where_, line), what, allowed);
  }

  /// The line TILT=; a text without one is no LM-63.
  std::size_t find_tilt() const {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (trim(lines_[i]).starts_with("TILT=")) return i;
    if (!lines_.empty() && trim(lines_[0]).starts_with("IES"))
      throw Error(at(lines_.size() - 1),
                  "ends before the line TILT=", "TILT=NONE, TILT=INCLUDE or TILT=<file>");
    throw NotMyFormat(where_, "is no IES LM-63 file: it has no line TILT=");
  }

  void read_header(std::size_t tilt) {
    const std::string first = lines_.empty() ? "" : trim(lines_[0]);
    std::size_t line = 0;
    for (const Header& header : kHeaders) {
      if (first != header.text) continue;
      out_.format = header.name;
      year_ = header.year;
      line = 1;
    }
    if (out_.format.empty()) {
      // The 1986 standard has no header: its first line is a label like any other.
      out_.format = "LM-63-1986";
      year_ = 1986;
      if (first.starts_with("IES")) {
        line = 1;
        std::string known;
        for (const Header& header : kHeaders) known += (known.empty() ? "" : ", ") + std::string(header.text);
        note(1, "unknown header '" + first + "' is read as LM-63-1986 (known: " + known + ")");
      }
    }
    for (; line < tilt; ++line) read_label(trim(lines_[line]));
    if (const auto lumens = absolute_lumens()) out_.stated = lumens;
  }

  void read_label(const std::string& text) {
    const std::size_t end = text.find(']');
    if (!text.starts_with('[') || end == std::string::npos) {
      if (!text.empty()) out_.keywords.emplace_back("", text);
      return;
    }
    const std::string key = text.substr(1, end - 1), value = trim(text.substr(end + 1));
    if (key == "MORE" && !out_.keywords.empty())
      out_.keywords.back().second += " " + value;
    else
      out_.keywords.emplace_back(key, value);
  }

  /// Makers' own keywords for the flux of the luminaire as a whole.
  std::optional<double> absolute_lumens() const {
    for (const char* key : {"_ABSOLUTELUMENS", "_ABSLUMENS", "ABSOLUTELUMENS"})
      if (const auto v = parse_number(out_.keyword(key)); v && *v > 0) return v;
    return std::nullopt;
  }

  void read_tilt(const std::string& tilt, const std::string& place, Numbers& numbers) {
    if (tilt == "NONE") return;
    if (tilt == "INCLUDE") {
      read_tilt_table(numbers);
      return;
    }
    const std::filesystem::path file = folder_ / tilt;
    std::error_code ec;
    if (tilt.empty() || folder_.empty() || !std::filesystem::is_regular_file(file, ec))
      throw Error(place, "TILT file '" + tilt + "' is not there",
                  "TILT=NONE, TILT=INCLUDE or a file beside this one");
    const std::vector<std::string> lines = lines_of(read_file(file));
    Numbers other(lines, 0, file.string());
    read_tilt_table(other);
  }

  void read_tilt_table(Numbers& numbers) {
    out_.tilt.geometry = numbers.integer("the lamp-to-luminaire geometry of TILT", 1, 3);
    const auto count = static_cast<std::size_t>(numbers.integer("the number of tilt angles", 1, kMostAngles));
    out_.tilt.angles = numbers.ascending(count, "tilt angle");
    out_.tilt.factors = numbers.list(count, "tilt factor");
    for (const double f : out_.tilt.factors)
      if (f < 0) numbers.fail("a tilt factor is negative", "factors from 0 on");
  }

  void read_table(Numbers& numbers) {
    const double lamps = numbers.next("the number of lamps"), lumens = numbers.next("the lumens per lamp"),
                 multiplier = numbers.next("the candela multiplier");
    if (!(lamps > 0)) numbers.fail("the number of lamps is not positive");
    if (!(multiplier > 0)) numbers.fail("the candela multiplier is not positive", "a factor > 0");
    const int vertical = numbers.integer("the number of vertical angles", 1, kMostAngles),
              horizontal = numbers.integer("the number of horizontal angles", 1, kMostAngles),
              type = numbers.integer("the photometric type", 1, 3),
              units = numbers.integer("the units type", 1, 2);
    out_.type = type == 1 ? Photometry::Type::c : type == 2 ? Photometry::Type::b : Photometry::Type::a;
    const double width = numbers.next("the width"), length = numbers.next("the length"),
                 height = numbers.next("the height");
    read_opening(width, length, height, units == 1 ? kFoot : 1);
    const int sizes = numbers.line();
    const double ballast = numbers.next("the ballast factor"),
                 second = numbers.next("the ballast-lamp factor"), watts = numbers.next("the input watts");
    // In 2019 the second number became the file generation type, which is no factor.
    const double factor = multiplier * ballast * (year_ >= 2019 ? 1 : second);
    if (!(factor > 0)) numbers.fail("the ballast factors are not positive", "factors > 0");
    if (year_ == 2002 && second != 1)
      note(numbers.line(), "the ballast-lamp factor is not 1, which LM-63-2002 asks for");

    out_.absolute = lumens < 0;
    if (lumens < 0 && lumens != -1)
      note(sizes, fmt::format("{:g} lumens per lamp count as -1, absolute photometry", lumens));
    if (lumens == 0) note(sizes, "0 lumens per lamp; the candela values are taken as they stand");
    LampSet lamp;
    lamp.count = lamps;
    lamp.lumens = out_.absolute ? 0 : lamps * lumens;
    lamp.watts = watts;
    lamp.name = out_.keyword("LAMP");
    lamp.color = out_.keyword("_CCT");
    lamp.rendering = out_.keyword("_CRI");
    out_.lamps = {lamp};

    const auto nv = static_cast<std::size_t>(vertical), nh = static_cast<std::size_t>(horizontal);
    const std::vector<double> v = numbers.ascending(nv, "vertical angle");
    check_vertical(v, numbers);
    const std::vector<double> h = numbers.ascending(nh, "horizontal angle");
    const int angles = numbers.line();
    std::vector<double> candela = numbers.list(nv * nh, "candela value");
    std::size_t negative = 0;
    for (double& c : candela) {
      c *= factor;
      if (c < 0) c = 0, ++negative;
    }
    if (negative > 0)
      note(numbers.line(), fmt::format("{} candela values are negative and count as 0", negative));
    if (out_.type == Photometry::Type::c)
      expand_c(h, v, candela, angles);
    else
      expand_ab(h, v, candela, angles);
  }

  /// LM-63-1995, 2002: signs say which shape. Width lies along C90, length along C0.
  void read_opening(double width, double length, double height, double unit) {
    Opening& o = out_.opening;
    const bool round_w = width < 0, round_l = length < 0, round_h = height < 0;
    if (round_w && length == 0 && !(round_h && year_ >= 2002))
      length = width;  // 1995 leaves the other diameter out
    if (round_w && round_h && length > 0 && year_ >= 2002) {
      o.shape = Opening::Shape::cylinder, o.axis = 0;  // lies along C0
    } else if (!round_w && round_l && round_h) {
      o.shape = Opening::Shape::cylinder, o.axis = 1;
    } else if (round_w && round_h && length == 0) {
      o.shape = Opening::Shape::cylinder, o.axis = 0;  // a circle that faces C0
    } else if (round_w && round_h) {
      o.shape = Opening::Shape::ellipsoid;
    } else if (round_w || round_l) {
      o.shape = Opening::Shape::cylinder;
    }
    o.size = Vec3(static_cast<float>(std::abs(length) * unit), static_cast<float>(std::abs(width) * unit),
                  static_cast<float>(std::abs(height) * unit));
    if (o.radius() > 50)
      out_.notes.push_back(
          fmt::format("the luminous opening is {:.0f} m across; are its units right?", 2 * o.radius()));
  }

  void check_vertical(const std::vector<double>& v, const Numbers& numbers) {
    const bool c = out_.type == Photometry::Type::c;
    const double least = c ? 0 : -90, most = c ? 180 : 90;
    if (v.front() < least - 1e-6 || v.back() > most + 1e-6)
      numbers.fail(fmt::format("vertical angles reach from {} to {}", v.front(), v.back()),
                   c ? "0 to 180 for type C" : "-90 to 90 for types A and B");
    const bool legal =
        c ? (equal(v.front(), 0) || equal(v.front(), 90)) && (equal(v.back(), 90) || equal(v.back(), 180))
          : (equal(v.front(), 0) || equal(v.front(), -90)) && equal(v.back(), 90);
    if (!legal)
      note(numbers.line(),
           fmt::format(
               "vertical angles reach from {} to {}, where the standard wants {}; beyond them it is dark",
               v.front(), v.back(), c ? "0 or 90 to 90 or 180" : "-90 or 0 to 90"));
  }

  void expand_c(const std::vector<double>& h, const std::vector<double>& v,
                const std::vector<double>& candela, int line) {
    out_.polars = v;
    if (!fill_circle(out_, h, candela))
      fail(line, fmt::format("horizontal angles reach from {} to {}", h.front(), h.back()),
           "from 0 to 0, 90, 180 or 360, or from 90 to 270");
    if (h.back() > 180 + 1e-6 && !equal(h.back(), 360) && !equal(h.back(), 270))
      note(line,
           fmt::format("horizontal angles end at {}; the circle is closed with the plane at 0", h.back()));
  }

  /// Horizontal angles from 0 on are mirrored. Type B turns about the horizontal axis, so its planes are the
  /// vertical angles.
  void expand_ab(const std::vector<double>& h, const std::vector<double>& v,
                 const std::vector<double>& candela, int line) {
    if (h.front() < -90 - 1e-6 || h.back() > 90 + 1e-6)
      fail(line, fmt::format("horizontal angles reach from {} to {}", h.front(), h.back()),
           "-90 to 90 for types A and B, or 0 to 90 where both sides are alike");
    std::vector<double> sides;
    std::vector<std::size_t> source;
    if (equal(h.front(), 0))
      for (std::size_t i = h.size() - 1; i > 0; --i) sides.push_back(-h[i]), source.push_back(i);
    for (std::size_t i = 0; i < h.size(); ++i) sides.push_back(h[i]), source.push_back(i);
    const bool b = out_.type == Photometry::Type::b;
    out_.azimuths = b ? v : sides;
    for (const double polar : b ? sides : v) out_.polars.push_back(90 + polar);
    for (std::size_t a = 0; a < out_.azimuths.size(); ++a)
      for (std::size_t g = 0; g < out_.polars.size(); ++g)
        out_.candela.push_back(candela[source[b ? g : a] * v.size() + (b ? a : g)]);
  }

  std::vector<std::string> lines_;
  std::string where_;
  std::filesystem::path folder_;
  int year_ = 1986;
  Photometry out_;
};

}  // namespace

Photometry parse_ies(std::string_view text, const std::string& where, const std::filesystem::path& folder) {
  return Reader(text, where, folder).run();
}

}  // namespace sconce
