// SPDX-License-Identifier: Apache-2.0
// contact_sheet OUT.png COLUMNS PICTURE LABEL [PICTURE LABEL]...: pictures of one size in a grid, a label
// under each.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "image/draw.h"
#include "image/io.h"

namespace sconce::demo {
namespace {

constexpr int kMargin = 16, kDot = 2, kLabelGap = 9;
const int kLabelHeight = kLabelGap + text_height(kDot);
constexpr unsigned char kPaper = 22;
constexpr Color8 kInk = {200, 200, 200};

struct Entry {
  Image8 picture;
  std::string label;
};

void draw_picture(Image8& sheet, int x, int y, const Image8& picture) {
  const auto row = static_cast<std::size_t>(picture.width) * 3;
  for (int j = 0; j < picture.height; ++j)
    std::copy_n(&picture.data[static_cast<std::size_t>(j) * row], row,
                &sheet.data[3 * (static_cast<std::size_t>(y + j) * static_cast<std::size_t>(sheet.width) +
                                 static_cast<std::size_t>(x))]);
}

Image8 lay_out(const std::vector<Entry>& entries, int columns) {
  const int width = entries.front().picture.width, height = entries.front().picture.height;
  for (const Entry& entry : entries)
    if (entry.picture.width != width || entry.picture.height != height)
      throw Error(entry.label, "the picture is of another size than the first");
  const int count = static_cast<int>(entries.size()), rows = (count + columns - 1) / columns;
  Image8 sheet;
  sheet.width = kMargin + columns * (width + kMargin);
  sheet.height = kMargin + rows * (height + kLabelHeight + kMargin);
  sheet.data.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3,
                    kPaper);
  for (int k = 0; k < count; ++k) {
    const Entry& entry = entries[static_cast<std::size_t>(k)];
    const int x = kMargin + k % columns * (width + kMargin),
              y = kMargin + k / columns * (height + kLabelHeight + kMargin);
    draw_picture(sheet, x, y, entry.picture);
    draw_text(sheet, x, y + height + kLabelGap, entry.label, kDot, kInk);
  }
  return sheet;
}

Image8 load(const std::string& path) {
  const std::string bytes = read_file(path);
  return decode_image8({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, path, 3);
}

}  // namespace
}  // namespace sconce::demo

int main(int argc, char** argv) {
  const int columns = argc > 2 ? std::atoi(argv[2]) : 0;
  if (argc < 5 || argc % 2 == 0 || columns < 1) {
    std::fprintf(stderr, "usage: contact_sheet OUT.png COLUMNS PICTURE LABEL [PICTURE LABEL]...\n");
    return 2;
  }
  try {
    std::vector<sconce::demo::Entry> entries;
    for (int k = 3; k < argc; k += 2) entries.push_back({sconce::demo::load(argv[k]), argv[k + 1]});
    sconce::write_png(argv[1], sconce::demo::lay_out(entries, columns));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_sheet: %s\n", error.what());
    return 1;
  }
  return 0;
}
