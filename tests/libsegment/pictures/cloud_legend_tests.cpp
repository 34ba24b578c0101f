// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_legend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ph::segment {
namespace {

/// A picture with segments of 10, 20, … points side by side, and 7 points without a segment.
CloudPicture picture_of(std::size_t segments) {
  CloudPicture picture;
  picture.raster = {4, 2, 3, 8, std::vector<std::uint16_t>(24, 255)};
  picture.points.push_back(7);
  for (std::size_t i = 0; i < segments; ++i) {
    picture.points.push_back(10 * (i + 1));
    picture.middles.push_back(std::array{80.0 * static_cast<double>(i), 5.0});
  }
  return picture;
}

std::vector<std::uint32_t> colours_of(std::size_t segments) {
  return std::vector<std::uint32_t>(segments, 0xFF0000);
}

TEST(CloudLegend, TheLargestComeFirst) {
  const ColouredPicture plot = with_legend(picture_of(3), colours_of(3), {});
  ASSERT_EQ(plot.legend.size(), 4U);
  EXPECT_EQ(plot.legend[0].name, "3");
  EXPECT_EQ(plot.legend[0].value, "30");
  EXPECT_EQ(plot.legend[0].colour, colour_in_picture(0xFF0000));
  EXPECT_EQ(plot.legend[2].name, "1");
  EXPECT_EQ(plot.legend[3].name, "none");
  EXPECT_EQ(plot.legend[3].value, "7");
  EXPECT_EQ(plot.raster.samples.size(), 24U);
  ASSERT_EQ(plot.marks.size(), 3U);
  EXPECT_EQ(plot.marks[0].text, "3");
  EXPECT_EQ(plot.marks[0].x, 160);
}

TEST(CloudLegend, ObjectsKeepTheirNumbers) {
  const std::vector<std::uint32_t> numbers{12, 5};
  const ColouredPicture plot = with_legend(picture_of(2), colours_of(2), numbers);
  EXPECT_EQ(plot.legend[0].name, "5");
  EXPECT_EQ(plot.legend[1].name, "12");
}

TEST(CloudLegend, TheOthersAreCounted) {
  const ColouredPicture all = with_legend(picture_of(17), colours_of(17), {});
  ASSERT_EQ(all.legend.size(), 18U) << "one other is listed itself";
  EXPECT_EQ(all.legend[16].name, "1");
  const ColouredPicture plot = with_legend(picture_of(118), colours_of(118), {});
  ASSERT_EQ(plot.legend.size(), 18U);
  EXPECT_EQ(plot.legend[16].name, "and 102 others");
  EXPECT_EQ(plot.legend[16].value, "52,530");  // 10 + 20 + … + 1020
  EXPECT_FALSE(plot.legend[16].colour);
  EXPECT_EQ(plot.marks.size(), 16U) << "those that the legend lists";
}

TEST(CloudLegend, NumbersDoNotCoverEachOther) {
  CloudPicture picture = picture_of(3);
  picture.middles[0] = picture.middles[2];
  picture.middles[1].reset();
  const ColouredPicture plot = with_legend(std::move(picture), colours_of(3), {});
  ASSERT_EQ(plot.marks.size(), 1U);
  EXPECT_EQ(plot.marks[0].text, "3");
}

TEST(CloudLegend, NothingToSay) {
  CloudPicture picture = picture_of(0);
  picture.points[0] = 0;
  const ColouredPicture plot = with_legend(std::move(picture), {}, {});
  EXPECT_TRUE(plot.legend.empty());
  EXPECT_TRUE(plot.marks.empty());
}

}  // namespace
}  // namespace ph::segment
