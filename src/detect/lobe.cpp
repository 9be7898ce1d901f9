// SPDX-License-Identifier: Apache-2.0
#include "detect/lobe.h"

namespace sconce {

namespace {

constexpr float kIntensity = 0.5f;         // leaves 8-bit targets room for highlights
constexpr float kDim = 0.01f;              // cards below it tell nothing
constexpr float kLeast = 1, kMost = 4096;  // exponents

/// Angles, radians: of the light to the normal, of the eye to the mirrored light, in their plane and about
/// the normal.
struct Setting {
  float light, eye, turn;
};
constexpr std::array<float, 3> kLights{0.3f, 0.7f, 1.0f};
constexpr std::array<std::array<float, 2>, 9> kEyes{
    {{0, 0}, {0.06f, 0}, {-0.06f, 0}, {0.18f, 0}, {-0.18f, 0}, {0.4f, 0}, {-0.4f, 0}, {0, 0.5f}, {0, 1.2f}}};
constexpr std::array<Setting, 2> kHeldOut{{{0.5f, 0.1f, 0.2f}, {0.85f, -0.3f, 0}}};

/// What a texel showed under one setting.
struct Reading {
  float cosine, mirror, halfway;  ///< of the light to the normal; of the lobe's angles
  Rgb light;                      ///< without emission, share of a white card's that faces the light
};

class LobeFitter {
 public:
  LobeFitter(const World& world, const HostRenderer& host, uint32_t triangle, const Rgb& emission, int texels,
             CaptureCost& cost)
      : world_(world),
        host_(host),
        triangle_(triangle),
        emission_(emission),
        space_(face_cells(std::array{triangle}, std::array{texels})),
        cost_(cost) {}

  std::optional<Lobe> run() {
    std::vector<Reading> readings;
    for (const float light : kLights)
      for (const auto& [eye, turn] : kEyes) read({light, eye, turn}, readings);
    if (readings.empty()) return std::nullopt;
    Lobe best;
    double least = 1e300;
    for (const bool halfway : {false, true}) {
      // A coarse row of exponents, then finer ones about the best.
      float from = kLeast, ratio = 2;
      for (int round = 0; round < 4; ++round) {
        float middle = from;
        double lowest = 1e300;
        const float to = round == 0 ? kMost : from * std::pow(ratio, 16.0f);
        for (float n = from; n <= 1.0001f * to; n *= ratio) {
          Lobe lobe;
          lobe.halfway = halfway, lobe.exponent = n;
          const double error = solve(readings, lobe);
          if (error < lowest) lowest = error, middle = n;
          if (error < least) least = error, best = lobe;
        }
        from = std::max(kLeast, middle / ratio);
        ratio = std::pow(ratio, 1.0f / 8);
      }
    }
    readings.clear();
    for (const Setting& setting : kHeldOut) {
      readings.clear();
      read(setting, readings);
      Rgb sum;
      for (const Reading& r : readings)
        sum += r.light - best.diffuse * r.cosine - best.strength * shape(r, best);
      if (!readings.empty()) sum *= 1 / static_cast<float>(readings.size());
      best.residual = std::max({best.residual, std::abs(sum.r), std::abs(sum.g), std::abs(sum.b)});
    }
    return best;
  }

 private:
  static float shape(const Reading& r, const Lobe& lobe) {
    return std::pow(std::max(0.0f, lobe.halfway ? r.halfway : r.mirror), lobe.exponent);
  }

  void read(const Setting& setting, std::vector<Reading>& out) {
    const Vec3 normal = world_.face_normals[triangle_];
    const Frame frame(normal);
    const auto towards = [&](float angle, float turn) {
      return std::cos(angle) * normal +
             std::sin(angle) * (std::cos(turn) * frame.x + std::sin(turn) * frame.y);
    };
    DrawRequest request;
    request.lights = DrawRequest::Lights::probe;
    request.probe = {towards(setting.light, 0), kIntensity};
    request.eye = world_.bounds.center() +
                  10 * world_.bounds.diagonal() * towards(-setting.light + setting.eye, setting.turn);
    const Captured drawn = capture(host_, space_, request, "a face under one of many lights");
    request.white_card = true;
    const Captured card = capture(host_, space_, request, "a white card under one of many lights");
    cost_ += drawn.cost, cost_ += card.cost;
    const auto& [a, b, c] = space_.corners[0];
    const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
    each_pixel(space_, 0, [&](std::size_t pixel) {
      const Rgb& white = card.light[pixel];
      if (drawn.is_clipped(pixel) || card.is_clipped(pixel) ||
          !(std::min({white.r, white.g, white.b}) > kDim))
        return;
      const Vec2 at = inverse * (pixel_middle(space_, pixel) - a);
      const Vec3 n = world_.normal(triangle_, at), to = request.probe.to_light;
      const Vec3 eye = glm::normalize(request.eye - world_.position(triangle_, at));
      Reading r{glm::dot(n, to), 0, 0, {}};
      if (!(r.cosine > 0)) return;
      r.mirror = glm::dot(2 * r.cosine * n - to, eye);
      r.halfway = glm::dot(n, normalize_or(to + eye, n));
      const Rgb lit = drawn.light[pixel] - emission_;
      r.light = Rgb(lit.r / white.r, lit.g / white.g, lit.b / white.b) * r.cosine;
      out.push_back(r);
    });
  }

  /// Diffuse part and strength by least squares. @return sum of squares left
  static double solve(std::span<const Reading> readings, Lobe& lobe) {
    double cc = 0, cf = 0, ff = 0;
    std::array<double, 3> cy{}, fy{}, yy{};
    for (const Reading& r : readings) {
      const auto c = static_cast<double>(r.cosine), f = static_cast<double>(shape(r, lobe));
      cc += c * c, cf += c * f, ff += f * f;
      const std::array<float, 3> y{r.light.r, r.light.g, r.light.b};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<double>(y[k]);
        cy[k] += c * v, fy[k] += f * v, yy[k] += v * v;
      }
    }
    const double determinant = cc * ff - cf * cf;
    std::array<float, 3> diffuse{}, strength{};
    double left = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double s = determinant > 1e-9 * cc * ff ? (cc * fy[k] - cf * cy[k]) / determinant : 0;
      s = std::max(s, 0.0);
      const double d = (cy[k] - cf * s) / cc;
      left += yy[k] - 2 * (d * cy[k] + s * fy[k]) + d * d * cc + 2 * d * s * cf + s * s * ff;
      diffuse[k] = static_cast<float>(d), strength[k] = static_cast<float>(s);
    }
    lobe.diffuse = Rgb(diffuse[0], diffuse[1], diffuse[2]);
    lobe.strength = Rgb(strength[0], strength[1], strength[2]);
    return left;
  }

  const World& world_;
  const HostRenderer& host_;
  uint32_t triangle_;
  Rgb emission_;
  TextureSpace space_;
  CaptureCost& cost_;
};

}  // namespace

std::optional<Lobe> fit_lobe(const World& world, const HostRenderer& host, uint32_t triangle,
                             const Rgb& emission, int texels, CaptureCost& cost) {
  return LobeFitter(world, host, triangle, emission, texels, cost).run();
}

}  // namespace sconce
