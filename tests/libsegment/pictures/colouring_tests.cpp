// SPDX-License-Identifier: MIT
#include "ph/detail/segment/colouring.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "ph/error.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using Neighbours = std::vector<std::vector<std::size_t>>;

/// A row of `k` segments without gaps. Each segment is `width` pixels wide and 2 pixels high.
struct Stripes {
  explicit Stripes(std::uint32_t k, Index width) {
    std::vector<float> xyz(static_cast<std::size_t>(6 * width) * k, 1.0F);
    cloud = test::cloud_of(xyz, width * static_cast<Index>(k), 2);
    for (Index i = 0; i < cloud.size(); ++i) {
      segmentation.cut.labels.push_back(static_cast<std::uint32_t>(i % cloud.width / width) + 1);
    }
    segmentation.cut.segments.resize(k);
  }
  Cloud cloud;
  Segmentation segmentation;
};

TEST(Colouring, NeighboursInTheImage) {
  const Stripes wide(3, 10);
  EXPECT_EQ(neighbouring_segments(wide.cloud, wide.segmentation.cut),
            (Neighbours{{1}, {0, 2}, {1}}));
  const Stripes narrow(3, 2);  // segments 0 and 2 are less than five pixels apart
  EXPECT_EQ(neighbouring_segments(narrow.cloud, narrow.segmentation.cut),
            (Neighbours{{1, 2}, {0, 2}, {0, 1}}));
}

TEST(Colouring, NeighboursInSpaceAreThoseThatTouch) {
  Cloud cloud;  // an unorganised cloud
  SceneCut cut;
  cut.segments.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) cut.segments[i].label = i + 1;
  cut.segments[0].neighbours = {{3, 0.1}, {2, 0.2}};
  cut.segments[1].neighbours = {{1, 0.2}};
  cut.segments[2].neighbours = {{1, 0.1}};
  EXPECT_EQ(neighbouring_segments(cloud, cut), (Neighbours{{1, 2}, {0}, {0}}));
  const auto colours = label_colours(cut);
  EXPECT_NE(colours[0], colours[1]);
  EXPECT_NE(colours[0], colours[2]);
}

TEST(Colouring, NeighboursDiffer) {
  Neighbours all(7), ring(50);
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < 7; ++j) {
      if (i != j) all[i].push_back(j);
    }
  }
  const auto seven = segment_colours(all);
  EXPECT_EQ(std::set(seven.begin(), seven.end()).size(), 7U);
  for (std::size_t i = 0; i < 50; ++i) ring[i] = {(i + 1) % 50, (i + 49) % 50};
  const auto colours = segment_colours(ring);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_NE(colours[i], colours[(i + 1) % 50]);
  EXPECT_EQ(std::set(colours.begin(), colours.end()).size(), 7U) << "spread over the palette";
  EXPECT_TRUE(segment_colours({}).empty());
}

TEST(Colouring, ColouredCloudKeepsPointsAndLabels) {
  const Stripes stripes(2, 10);
  std::vector<std::uint32_t> labels = stripes.segmentation.cut.labels;
  labels[0] = 0;
  const Cloud out =
      coloured_cloud(stripes.cloud, labels, std::vector<std::uint32_t>{0x112233, 0xFF});
  EXPECT_EQ(out.width, 20);
  EXPECT_EQ(out.height, 2);
  EXPECT_EQ(out.xyz(), stripes.cloud.xyz());
  const auto rgb = out.rgb().value();
  EXPECT_EQ(rgb[1], 0x112233U);
  EXPECT_EQ(rgb[19], 0xFFU);
  EXPECT_EQ(rgb[0] & 0xFF, rgb[0] >> 8 & 0xFF);
}

TEST(Colouring, PictureTintsAndOutlines) {
  const Stripes stripes(2, 10);
  const std::vector<std::uint32_t> colours = {0xFF0000, 0x0000FF};
  const Raster raster = picture(stripes.cloud, stripes.segmentation.cut.labels, colours);
  EXPECT_EQ(raster.width, 20);
  EXPECT_EQ(raster.height, 2);
  EXPECT_EQ(raster.channels, 3);
  EXPECT_GT(raster.at(2, 0, 0), raster.at(2, 0, 2));
  EXPECT_LT(raster.at(15, 0, 0), raster.at(15, 0, 2));
  for (const int channel : {0, 1, 2}) EXPECT_EQ(raster.at(9, 0, channel), 255);
  Cloud row = stripes.cloud;
  row.width *= row.height;
  row.height = 1;
  EXPECT_THROW(picture(row, stripes.segmentation.cut.labels, colours), Error);
}

}  // namespace
}  // namespace ph::segment
