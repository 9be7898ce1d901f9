// SPDX-License-Identifier: Apache-2.0
#include "scene/sun_position.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

namespace sconce {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

double wrapped(double degrees) {
  return degrees - 360 * std::floor(degrees / 360);
}

}  // namespace

SunPosition sun_position(double seconds, double latitude, double longitude) {
  const double days = seconds / 86400 - 10957.5;  // since J2000, 2000-01-01 12:00
  const double centuries = days / 36525;
  const double mean_longitude = 280.46646 + centuries * (36000.76983 + centuries * 0.0003032);
  const double anomaly = kDegree * wrapped(357.52911 + centuries * (35999.05029 - centuries * 0.0001537));
  const double center = (1.914602 - centuries * (0.004817 + centuries * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - 0.000101 * centuries) * std::sin(2 * anomaly) +
                        0.000289 * std::sin(3 * anomaly);
  const double node = kDegree * (125.04 - 1934.136 * centuries);
  const double apparent = kDegree * wrapped(mean_longitude + center - 0.00569 - 0.00478 * std::sin(node));
  const double obliquity = kDegree * (23.439291 - 0.0130042 * centuries + 0.00256 * std::cos(node));
  const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(apparent), std::cos(apparent));
  const double declination = std::asin(std::sin(obliquity) * std::sin(apparent));
  const double sidereal = wrapped(280.46061837 + 360.98564736629 * days + longitude);
  const double hour = kDegree * sidereal - right_ascension;
  const double phi = kDegree * latitude;
  const double elevation = std::asin(std::sin(phi) * std::sin(declination) +
                                     std::cos(phi) * std::cos(declination) * std::cos(hour));
  const double from_south =
      std::atan2(std::sin(hour), std::cos(hour) * std::sin(phi) - std::tan(declination) * std::cos(phi));
  return {elevation / kDegree, wrapped(from_south / kDegree + 180)};
}

std::optional<double> parse_time(std::string_view text, double longitude) {
  const std::string copy(text);
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  if (std::sscanf(copy.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) !=
      5)
    return std::nullopt;
  std::string_view rest = text.substr(static_cast<std::size_t>(used));
  double second = 0;
  int length = 0;
  if (rest.starts_with(':')) {
    if (std::sscanf(std::string(rest).c_str(), ":%lf%n", &second, &length) != 1) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(length));
  }
  double zone = longitude / 15;  // hours
  if (rest == "Z") {
    zone = 0;
  } else if (!rest.empty()) {
    int hours = 0, minutes = 0;
    length = 0;
    char sign[2] = {};
    if (std::sscanf(std::string(rest).c_str(), "%1[+-]%2d:%2d%n", sign, &hours, &minutes, &length) != 3 ||
        static_cast<std::size_t>(length) != rest.size() || hours > 14 || minutes > 59)
      return std::nullopt;
    zone = (sign[0] == '-' ? -1 : 1) * (hours + minutes / 60.0);
  }
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0 && second < 61))
    return std::nullopt;
  const double midnight = 86400.0 * static_cast<double>(sys_days(date).time_since_epoch().count());
  return midnight + 3600 * (hour - zone) + 60 * minute + second;
}

Vec3 towards_sun(const SunPosition& sun, double north) {
  const double h = kDegree * sun.elevation, a = kDegree * (sun.azimuth + north);
  return {static_cast<float>(std::sin(a) * std::cos(h)), static_cast<float>(std::sin(h)),
          static_cast<float>(-std::cos(a) * std::cos(h))};
}

}  // namespace sconce
