// SPDX-License-Identifier: Apache-2.0
#include "image/exr_parts.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/test_folder.h"
#include "image/io.h"

namespace sconce {
namespace {

/// A part of one value.
Imf::Header part(const std::string& name, const Imath::Box2i& window,
                 const std::vector<std::string>& channels) {
  Imf::Header header(Imath::Box2i({0, 0}, {7, 7}), window);
  header.setName(name);
  header.setType(Imf::SCANLINEIMAGE);
  header.insert("comments", Imf::StringAttribute("kept"));
  for (const std::string& c : channels) header.channels().insert(c, Imf::Channel(Imf::FLOAT));
  return header;
}

TEST(ExrParts, PartsAreJoinedOverTheirWindows) {
  const TemporaryFolder folder;
  const std::string path = (folder / "parts.exr").string();
  const std::vector<Imf::Header> headers{part("rgba", {{0, 0}, {3, 3}}, {"R", "G", "B", "A"}),
                                         part("RGBA_key", {{2, 2}, {5, 5}}, {"R", "G", "B"}),
                                         part("depth", {{0, 0}, {3, 3}}, {"depth.Z"})};
  {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (int p = 0; p < 3; ++p) {
      std::vector<float> values(16, static_cast<float>(p + 1));
      Imf::FrameBuffer buffer;
      const Imf::Header& h = headers[static_cast<std::size_t>(p)];
      for (auto c = h.channels().begin(); c != h.channels().end(); ++c)
        buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), h.dataWindow(), 4, 16));
      Imf::OutputPart out(file, p);
      out.setFrameBuffer(buffer);
      out.writePixels(4);
    }
  }
  const ExrParts parts = read_exr_parts(path);
  EXPECT_EQ(parts.image.channels,
            (std::vector<std::string>{"RGBA_key.R", "RGBA_key.G", "RGBA_key.B", "depth.Z", "rgba.R", "rgba.G",
                                      "rgba.B", "rgba.A"}));
  EXPECT_EQ(parts.image.width, 6);
  EXPECT_EQ(parts.display.width, 8);
  EXPECT_EQ(parts.image.at(0, 0)[0], 0);
  EXPECT_EQ(parts.image.at(2, 2)[0], 2);
  EXPECT_EQ(parts.image.at(5, 5)[4], 0);
  EXPECT_EQ(parts.image.at(3, 3)[4], 1);
  EXPECT_EQ(parts.image.text.at("comments"), "kept");
  EXPECT_TRUE(parts.left_out.empty());
  write_exr_parts(folder / "one.exr", parts);
  EXPECT_EQ(read_exr_parts(folder / "one.exr").image.data, parts.image.data);
}

TEST(ExrParts, DamageIsOneClearLine) {
  const TemporaryFolder folder;
  write_exr(folder / "x.exr", Image::rgb(8, 8), PixelType::full);
  const std::string bytes = read_file(folder / "x.exr");
  for (std::size_t length = 4; length < bytes.size(); length += 37) {
    write_file(folder / "cut.exr", bytes.substr(0, length));
    EXPECT_THROW(read_exr_parts(folder / "cut.exr"), Error) << length;
  }
  write_file(folder / "no.exr", "no picture");
  EXPECT_THROW(read_exr_parts(folder / "no.exr"), NotMyFormat);
}

}  // namespace
}  // namespace sconce
