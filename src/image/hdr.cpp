// SPDX-License-Identifier: Apache-2.0
// Format: Ward, "Real Pixels", Graphics Gems II; Radiance file formats, "picture file".
#include "image/hdr.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "image/io.h"
#include "image/primaries.h"

namespace sconce {

namespace {

using Rgbe = std::array<unsigned char, 4>;

struct Header {
  std::array<double, 3> scale{1, 1, 1};  ///< product of EXPOSURE and COLORCORR
  bool xyz = false;
  std::array<float, 8> primaries = kRec709Primaries;
  char slow_axis = 'Y', slow_sign = '-', fast_sign = '+';
  int slow = 0, fast = 0;  ///< scan lines, pixels along one
};

class Reader {
 public:
  Reader(std::span<const unsigned char> bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  [[noreturn]] void damaged(const char* what) const {
    throw Error(where_, std::string("damaged Radiance picture: ") + what);
  }
  unsigned char byte() {
    if (at_ >= bytes_.size()) damaged("ends too early");
    return bytes_[at_++];
  }
  Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }
  std::string line() {
    std::string text;
    for (unsigned char c = byte(); c != '\n'; c = byte()) text.push_back(static_cast<char>(c));
    return text;
  }
  std::size_t left() const { return bytes_.size() - at_; }
  std::array<int, 4> peek() const {
    std::array<int, 4> out{-1, -1, -1, -1};
    for (std::size_t i = 0; i < 4 && i < left(); ++i) out[i] = bytes_[at_ + i];
    return out;
  }

 private:
  std::span<const unsigned char> bytes_;
  const std::string& where_;
  std::size_t at_ = 0;
};

std::vector<double> numbers(const std::string& text) {
  std::vector<double> out;
  for (const std::string& word : split(text, ' '))
    if (const auto v = parse_number(word)) out.push_back(*v);
  return out;
}

void read_variable(const std::string& line, Header& header, const Reader& reader) {
  const auto equals = line.find('=');
  if (equals == std::string::npos) return;
  const std::string name = line.substr(0, equals), value = trim(line.substr(equals + 1));
  const std::vector<double> v = numbers(value);
  if (name == "FORMAT") {
    header.xyz = value == "32-bit_rle_xyze";
    if (!header.xyz && value != "32-bit_rle_rgbe") reader.damaged("unknown FORMAT");
  } else if (name == "EXPOSURE" && v.size() == 1 && v[0] > 0) {
    for (double& s : header.scale) s *= v[0];
  } else if (name == "COLORCORR" && v.size() == 3 && v[0] > 0 && v[1] > 0 && v[2] > 0) {
    for (std::size_t c = 0; c < 3; ++c) header.scale[c] *= v[c];
  } else if (name == "PRIMARIES" && v.size() == 8) {
    for (std::size_t c = 0; c < 8; ++c) header.primaries[c] = static_cast<float>(v[c]);
  }
}

Header read_header(Reader& reader) {
  Header header;
  for (std::string line = reader.line(); !line.empty(); line = reader.line())
    read_variable(line, header, reader);
  char fast_axis = 0, rest = 0;
  if (std::sscanf(reader.line().c_str(), "%c%c %9d %c%c %9d%c", &header.slow_sign, &header.slow_axis,
                  &header.slow, &header.fast_sign, &fast_axis, &header.fast, &rest) != 6)
    reader.damaged("no resolution line");
  const auto sign = [](char c) { return c == '+' || c == '-'; };
  const bool axes =
      (header.slow_axis == 'Y' && fast_axis == 'X') || (header.slow_axis == 'X' && fast_axis == 'Y');
  if (!axes || !sign(header.slow_sign) || !sign(header.fast_sign) || header.slow < 1 || header.fast < 1)
    reader.damaged("no resolution line");
  // Run-length coding reaches 127 bytes in 2; the old coding of flat pictures more, so a fixed allowance
  // comes on top.
  if (4.0 * header.slow * header.fast > 64e6 + 128.0 * static_cast<double>(reader.left()))
    reader.damaged("claims more pixels than its bytes can hold");
  return header;
}

/// Four separate runs, one per component.
void read_new_line(Reader& reader, std::vector<Rgbe>& line) {
  reader.pixel();  // 2, 2, length
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t x = 0; x < line.size();) {
      const std::size_t code = reader.byte();
      const bool run = code > 128;
      const std::size_t count = run ? code - 128 : code;
      if (count == 0 || count > line.size() - x) reader.damaged("run beyond the line");
      unsigned char value = run ? reader.byte() : 0;
      for (const std::size_t end = x + count; x < end; ++x) line[x][c] = run ? value : reader.byte();
    }
}

/// Whole pixels; (1, 1, 1, n) repeats the last one, n shifted by 8 for every such pixel in a row.
void read_old_line(Reader& reader, std::vector<Rgbe>& line) {
  int shift = 0;
  for (std::size_t x = 0; x < line.size();) {
    const Rgbe p = reader.pixel();
    if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
      line[x++] = p;
      shift = 0;
      continue;
    }
    const std::size_t count = std::size_t{p[3]} << shift;
    if (x == 0 || shift > 16 || count > line.size() - x) reader.damaged("run beyond the line");
    for (const std::size_t end = x + count; x < end; ++x) line[x] = line[x - 1];
    shift += 8;
  }
}

bool is_new_line(const Reader& reader, std::size_t length) {
  const auto head = reader.peek();
  return length >= 8 && length < 32768 && head[0] == 2 && head[1] == 2 && head[2] >= 0 && head[2] < 128 &&
         static_cast<std::size_t>(head[2]) * 256 + static_cast<std::size_t>(std::max(0, head[3])) == length;
}

Rgb decode(const Rgbe& p, const std::array<double, 3>& scale) {
  if (p[3] == 0) return {};
  const auto channel = [&](std::size_t c) {
    return static_cast<float>(std::ldexp(p[c] + 0.5, p[3] - 136) / scale[c]);
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

Image decode_hdr(std::span<const unsigned char> bytes, const std::string& where) {
  Reader reader(bytes, where);
  const auto magic = reader.peek();
  if (magic[0] != '#' || magic[1] != '?') throw NotMyFormat(where, "is not a Radiance picture");
  reader.line();
  const Header header = read_header(reader);
  const bool upright = header.slow_axis == 'Y';
  Image image = upright ? Image::rgb(header.fast, header.slow) : Image::rgb(header.slow, header.fast);
  std::vector<Rgbe> line(static_cast<std::size_t>(header.fast));
  for (int i = 0; i < header.slow; ++i) {
    is_new_line(reader, line.size()) ? read_new_line(reader, line) : read_old_line(reader, line);
    // +X runs to the right, +Y runs up.
    const bool slow_reversed = header.slow_sign == (upright ? '+' : '-');
    const bool fast_reversed = header.fast_sign == (upright ? '-' : '+');
    const int s = slow_reversed ? header.slow - 1 - i : i;
    for (int j = 0; j < header.fast; ++j) {
      const int f = fast_reversed ? header.fast - 1 - j : j;
      const Rgb c = decode(line[static_cast<std::size_t>(j)], header.scale);
      upright ? image.set_rgb(f, s, c) : image.set_rgb(s, f, c);
    }
  }
  image.primaries = header.primaries;
  if (header.xyz) {
    image.primaries = {1, 0, 0, 1, 0, 0, 1.0f / 3, 1.0f / 3};
    to_rec709(image);
  }
  return image;
}

Image read_hdr(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return decode_hdr({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, path.string());
}

}  // namespace sconce
