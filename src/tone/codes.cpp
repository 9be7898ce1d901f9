// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set (Highway's foreach_target); the best one that the processor has is
// called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tone/codes.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.
#include <hwy/highway.h>

#include "core/error.h"
#include "core/parallel.h"
#include "tone/codes.h"
#include "tone/curve.h"

HWY_BEFORE_NAMESPACE();
namespace sconce::HWY_NAMESPACE {

namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<uint8_t, Ints>;
using V = hn::Vec<Floats>;

struct Colours {
  V r, g, b;
};

inline V dot(const Rgb& row, const Colours& c) {
  const Floats d;
  return hn::MulAdd(hn::Set(d, row.r), c.r,
                    hn::MulAdd(hn::Set(d, row.g), c.g, hn::Mul(hn::Set(d, row.b), c.b)));
}

/// OctaveTable::operator().
inline V look_up(const OctaveTable& table, V v) {
  const Floats d;
  const Ints di;
  const auto piece =
      hn::Sub(hn::ShiftRight<OctaveTable::kShift>(hn::BitCast(di, v)), hn::Set(di, OctaveTable::kFirst - 1));
  const auto i = hn::Min(hn::Max(piece, hn::Zero(di)), hn::Set(di, static_cast<int>(table.base.size()) - 1));
  return hn::MulAdd(hn::GatherIndex(d, table.slope.data(), i), v, hn::GatherIndex(d, table.base.data(), i));
}

/// Nearest entries of the codes of [0,1].
inline hn::Vec<Bytes> display(const ToneCodes::Tables& tables, V v) {
  const Floats d;
  const Ints di;
  const V last = hn::Set(d, static_cast<float>(tables.display.size() - 4));
  const V at = hn::MulAdd(hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f)), last, hn::Set(d, 0.5f));
  const auto codes =
      hn::GatherOffset(di, reinterpret_cast<const int*>(tables.display.data()), hn::ConvertTo(di, at));
  return hn::DemoteTo(Bytes(), hn::And(codes, hn::Set(di, 255)));
}

/// @param pixels  whole vectors of them
void map_vectors(const ToneCodes::Tables& t, const float* linear, std::size_t pixels, uint8_t* codes) {
  const Floats d;
  // As curve::clean(): NaN and negative are 0.
  const auto expose = [&](V v) {
    const V exposed = hn::Mul(v, hn::Set(d, t.scale));
    return hn::IfThenElseZero(hn::Gt(exposed, hn::Zero(d)), hn::Min(exposed, hn::Set(d, 1e9f)));
  };
  for (std::size_t i = 0; i < pixels; i += hn::Lanes(d)) {
    Colours c;
    hn::LoadInterleaved3(d, linear + 3 * i, c.r, c.g, c.b);
    c = {expose(c.r), expose(c.g), expose(c.b)};
    if (t.curve.kind == ToneCurve::Kind::luminance) {
      const V gain = look_up(t.f, dot(t.curve.weights, c));
      c = {hn::Mul(c.r, gain), hn::Mul(c.g, gain), hn::Mul(c.b, gain)};
    } else {
      const Colours v{look_up(t.f, dot(t.curve.before[0], c)), look_up(t.f, dot(t.curve.before[1], c)),
                      look_up(t.f, dot(t.curve.before[2], c))};
      c = {dot(t.curve.after[0], v), dot(t.curve.after[1], v), dot(t.curve.after[2], v)};
    }
    hn::StoreInterleaved3(display(t, c.r), display(t, c.g), display(t, c.b), Bytes(), codes + 3 * i);
  }
}

std::size_t lanes() {
  return hn::Lanes(Floats());
}

}  // namespace
}  // namespace sconce::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>

namespace sconce {

HWY_EXPORT(map_vectors);
HWY_EXPORT(lanes);

namespace {

constexpr std::size_t kDisplay = 1 << 13;  // entries: the steepest part moves by 0.4 codes between two

template <class F>
OctaveTable make_octave_table(const F& f) {
  constexpr int kPieces = (OctaveTable::kHigh - OctaveTable::kLow) << OctaveTable::kBits;
  const auto edge = [](int piece) {
    return double{std::bit_cast<float>((OctaveTable::kFirst + piece) << OctaveTable::kShift)};
  };
  OctaveTable table;
  const auto constant = [&](double v) { table.base.push_back(static_cast<float>(f(v))); };
  constant(edge(0));
  table.slope.push_back(0);
  for (int piece = 0; piece < kPieces; ++piece) {
    const double low = edge(piece), high = edge(piece + 1), slope = (f(high) - f(low)) / (high - low);
    table.base.push_back(static_cast<float>(f(low) - slope * low));
    table.slope.push_back(static_cast<float>(slope));
  }
  constant(edge(kPieces));
  table.slope.push_back(0);
  return table;
}

uint8_t display_code(const ToneCodes::Tables& tables, float v) {
  return tables.display[static_cast<std::size_t>(v * static_cast<float>(kDisplay - 1) + 0.5f)];
}

}  // namespace

float OctaveTable::operator()(float v) const {
  const int piece = (std::bit_cast<int>(v) >> kShift) - (kFirst - 1);
  const auto i = static_cast<std::size_t>(std::clamp(piece, 0, static_cast<int>(base.size()) - 1));
  return base[i] + slope[i] * v;
}

ToneCodes::ToneCodes(const Exposure& exposure, const ToneMapper& mapper)
    : exposure_(exposure), mapper_(&mapper) {
  tables_.scale = exposure.scale;
  if (mapper.curve != nullptr) {
    tables_.curve = *mapper.curve;
    const bool luminance = mapper.curve->kind == ToneCurve::Kind::luminance;
    tables_.f = make_octave_table([&](double v) {
      const double f = double{mapper.curve->f(std::min(static_cast<float>(v), 1e9f), exposure.params)};
      return luminance ? f / v : f;
    });
  }
  for (std::size_t i = 0; i < kDisplay; ++i) {
    const float t = std::pow(static_cast<float>(i) / static_cast<float>(kDisplay - 1), tables_.curve.power);
    tables_.display.push_back(static_cast<uint8_t>(linear_to_srgb(t) * 255.0f + 0.5f));
  }
  tables_.display.resize(kDisplay + 3);
}

void ToneCodes::map(const float* linear, std::size_t pixels, unsigned char* codes) const {
  if (mapper_->curve == nullptr) {
    for (std::size_t i = 0; i < 3 * pixels; i += 3) {
      const Rgb c =
          mapper_->map(Rgb(linear[i], linear[i + 1], linear[i + 2]) * exposure_.scale, exposure_.params);
      codes[i] = display_code(tables_, c.r);
      codes[i + 1] = display_code(tables_, c.g);
      codes[i + 2] = display_code(tables_, c.b);
    }
    return;
  }
  const std::size_t vector = HWY_DYNAMIC_DISPATCH(lanes)(), rest = pixels % vector, whole = pixels - rest;
  HWY_DYNAMIC_DISPATCH(map_vectors)(tables_, linear, whole, codes);
  if (rest == 0) return;
  // The last pixels go through copies as long as a vector.
  std::vector<float> tail(3 * vector);
  std::vector<uint8_t> tail_codes(3 * vector);
  std::copy_n(linear + 3 * whole, 3 * rest, tail.begin());
  HWY_DYNAMIC_DISPATCH(map_vectors)(tables_, tail.data(), vector, tail_codes.data());
  std::copy_n(tail_codes.begin(), 3 * rest, codes + 3 * whole);
}

Image8 ToneCodes::map(const Image& linear) const {
  if (linear.stride() != 3) throw Error({}, "tone curves need a picture of R, G and B");
  Image8 out{linear.width, linear.height, 3, std::vector<unsigned char>(3 * linear.pixels())};
  const auto width = static_cast<std::size_t>(linear.width);
  parallel_for(static_cast<std::size_t>(linear.height), 8,
               [&](std::size_t y) { map(&linear.data[3 * y * width], width, &out.data[3 * y * width]); });
  return out;
}

}  // namespace sconce
#endif
