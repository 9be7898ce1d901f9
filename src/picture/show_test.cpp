// SPDX-License-Identifier: Apache-2.0
// Pictures from cached camera hits against those of rays.
#include "picture/show.h"

#include "core/error.h"
#include "core/parallel.h"
#include "picture/test_pictures.h"

namespace sconce {
namespace {

class Show : public PictureTest {
 protected:
  void open(const PackageContents& contents) {
    PictureTest::open(contents, {{Rgb(0.5f), {0, 1, 2}, Rgb(1)}});
  }
};

// Also of pages too small for vectors, where there is no neighbour.
TEST_F(Show, IsThePictureOfRaysByEveryCurve) {
  for (const auto& [width, height] : {std::pair{8, 8}, {2, 2}, {37, 3}, {1, 4}, {4, 1}, {1, 1}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    open(lit_wall(width, height));
    const Image linear = view_->render(camera_, mix_, pages_, params_);
    const CameraHits hits = view_->hits(camera_, params_);
    EXPECT_GT(hits.shines.size(), hits.pixels.size() / 20);
    for (const ToneMapper& mapper : tone_mappers()) {
      const Exposure exposure = auto_exposure(0.4, 10);
      EXPECT_LE(largest_difference(show(hits, mix_, pages_, ToneCodes(exposure, mapper)),
                                   tone_map(linear, exposure, mapper)),
                1)
          << mapper.name;
    }
  }
}

TEST_F(Show, FadersNeedNoNewRays) {
  open(lit_wall(8, 8));
  const CameraHits hits = view_->hits(camera_, params_);
  const ToneMapper& agx = find_tone_mapper("agx");
  const Exposure exposure = auto_exposure(0.4, 10);
  for (const MixSpec& mix : {MixSpec{{Rgb(0), Rgb(0), Rgb(0)}}, MixSpec{{Rgb(4), Rgb(0), Rgb(0)}},
                             MixSpec{{Rgb(0), Rgb(0), Rgb(3)}}}) {
    const std::vector<Image> pages = mix_pages(*package_, mix);
    EXPECT_LE(largest_difference(show(hits, mix, pages, ToneCodes(exposure, agx)),
                                 tone_map(view_->render(camera_, mix, pages, params_), exposure, agx)),
              1);
  }
}

TEST_F(Show, VectorsEqualThePlainRows) {
  open(lit_wall(9, 7));
  const CameraHits hits = view_->hits(camera_, params_);
  std::vector<float> fast(3 * 70 + 1), plain = fast;
  float brightest = 0;
  for (int y = 0; y < hits.height; ++y) {
    shade_row(hits, y, pages_, fast.data());
    shade_row_plain(hits, y, pages_, plain.data());
    for (std::size_t i = 0; i < 3 * 70; ++i) {
      ASSERT_NEAR(fast[i], plain[i], 1e-6f * (1 + plain[i])) << y;
      brightest = std::max(brightest, plain[i]);
    }
  }
  EXPECT_GT(brightest, 0.5f);
}

// The s-th rays of all pixels average to the picture of so many samples.
TEST_F(Show, HitsOfSamples) {
  open(lit_wall(8, 8));
  params_.samples = 4;
  const Image expected = view_->render(camera_, mix_, pages_, params_);
  Image sum = Image::rgb(params_.width, params_.height);
  for (int s = 0; s < params_.samples; ++s) {
    const CameraHits hits = view_->hits(camera_, params_, s);
    std::vector<float> row(3 * 70 + 1);
    for (int y = 0; y < hits.height; ++y) {
      shade_row_plain(hits, y, pages_, row.data());
      for (std::size_t i = 0; i < 3 * 70; ++i) sum.at(0, y)[i] += row[i] / 4;
      hits.for_each_shine(y, [&](const CameraHits::Shine& shine) {
        const Rgb w = shine.group ? mix_.weights[shine.group.value] : Rgb(1);
        const int x = static_cast<int>(shine.x);
        sum.set_rgb(x, y, sum.rgb_at(x, y) + 0.25f * w * shine.radiance);
      });
    }
  }
  for (std::size_t i = 0; i < sum.data.size(); ++i)
    ASSERT_NEAR(sum.data[i], expected.data[i], 1e-3f * (1 + expected.data[i]));
}

TEST_F(Show, SameCodesAtAnyNumberOfThreads) {
  open(lit_wall(8, 8));
  const ToneCodes tone(auto_exposure(0.4, 10), find_tone_mapper("agx"));
  std::vector<std::vector<unsigned char>> results;
  for (const int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    results.push_back(show(view_->hits(camera_, params_), mix_, pages_, tone).data);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST_F(Show, BadRequests) {
  open(lit_wall(8, 8));
  const CameraHits hits = view_->hits(camera_, params_);
  const ToneCodes tone({}, find_tone_mapper("agx"));
  EXPECT_THROW(show(hits, {{Rgb(1)}}, pages_, tone), Error);
  EXPECT_THROW(show(hits, mix_, {pages_[0]}, tone), Error);
  EXPECT_THROW(show(hits, mix_, {pages_[0], Image::rgb(4, 4)}, tone), Error);
  params_.width = 0;
  EXPECT_THROW(view_->hits(camera_, params_), UsageError);
}

}  // namespace
}  // namespace sconce
