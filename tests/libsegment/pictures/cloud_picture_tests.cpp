// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_picture.hpp"
#include "ph/eigen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

/// A small square one metre in front of the sensor, and a large square behind it at twice the
/// distance.
class CloudPictures : public testing::Test {
 protected:
  CloudPictures() {
    std::vector<float> xyz;
    for (const auto& [half, z] : {std::pair(0.1F, 1.0F), std::pair(0.4F, 2.0F)})
      for (int i = 0; i <= 80; ++i)
        for (int j = 0; j <= 80; ++j) {
          const float x = half * static_cast<float>(i - 40) / 40;
          const float y = half * static_cast<float>(j - 40) / 40;
          xyz.insert(xyz.end(), {x, y, z});
          labels_.push_back(z == 1 ? 1 : 2);
        }
    const float none = std::numeric_limits<float>::quiet_NaN();
    xyz.insert(xyz.end(), {none, 0, 1});
    labels_.push_back(0);
    cloud_ = test::cloud_of(xyz, static_cast<Index>(labels_.size()), 1);
    scene_.width = cloud_.width;
    scene_.voxel = 0.02;
    scene_.counts.assign(1600, 8);
    scene_.vertices = to_points(PointMatrix::Constant(1600, 3, 1.0));
  }
  Raster picture(const ViewTurn& turn = {}) const {
    return cloud_picture(&cloud_, scene_, labels_, kColours, turn, default_context()).raster;
  }
  /// The segment that is visible at a place, 1 or 2; 0 if none is.
  static int seen(const Raster& raster, double x, double y) {
    const auto u = static_cast<Index>(x * static_cast<double>(raster.width)),
               v = static_cast<Index>(y * static_cast<double>(raster.height));
    const int red = raster.at(u, v, 0), blue = raster.at(u, v, 2);
    return red > blue + 40 ? 1 : blue > red + 40 ? 2 : 0;
  }

  static constexpr std::array<std::uint32_t, 2> kColours{0xFF0000, 0x0000FF};
  Cloud cloud_;
  SceneTree scene_;
  std::vector<std::uint32_t> labels_;
};

TEST_F(CloudPictures, WhatIsNearerHidesWhatIsBehind) {
  const Raster raster = picture();
  EXPECT_EQ(raster.channels, 3);
  EXPECT_LE(std::max(raster.width, raster.height), 1040);
  EXPECT_EQ(seen(raster, 0.5, 0.5), 1);
  EXPECT_EQ(seen(raster, 0.2, 0.5), 2);
  EXPECT_EQ(seen(raster, 0.02, 0.5), 0) << "a margin";
  EXPECT_EQ(raster.at(0, 0), 255) << "white";
}

TEST_F(CloudPictures, FromBehind) {
  const Raster raster = picture({.right = 180});
  EXPECT_EQ(seen(raster, 0.5, 0.5), 2);
  for (double x = 0.01; x < 1; x += 0.01) EXPECT_NE(seen(raster, x, 0.5), 1) << x;
}

TEST_F(CloudPictures, TheEyeGoesToTheRightAndUp) {
  scene_.height = 1;
  scene_.plane = Plane{{0, -1, 0}, 0, 0.5};  // the y axis points down
  // Seen from the right, the near square moves to the left in front of the far one. Seen from
  // above, it moves down.
  EXPECT_EQ(seen(picture({.right = 35}), 0.1, 0.5), 1);
  EXPECT_EQ(seen(picture({.up = 35}), 0.5, 0.9), 1);
  EXPECT_EQ(seen(picture({.right = -35}), 0.9, 0.5), 1);
}

TEST_F(CloudPictures, NoSegmentsNoPoints) {
  std::ranges::fill(labels_, 0);
  const Raster grey = picture();
  EXPECT_EQ(seen(grey, 0.5, 0.5), 0);
  EXPECT_LT(grey.at(grey.width / 2, grey.height / 2), 255);
  const Cloud empty = test::cloud_of({}, 0, 1);
  const Raster nothing = cloud_picture(&empty, SceneTree(), {}, {}, {}, default_context()).raster;
  EXPECT_EQ(nothing.samples, (std::vector<std::uint16_t>{255, 255, 255}));
}

TEST_F(CloudPictures, NumbersStandWhereTheSegmentIsSeen) {
  const auto of = [&](const ViewTurn& turn) {
    return cloud_picture(&cloud_, scene_, labels_, kColours, turn, default_context());
  };
  const CloudPicture front = of({});
  EXPECT_EQ(front.points, (std::vector<std::size_t>{0, 81 * 81, 81 * 81}))
      << "holes are not counted";
  ASSERT_EQ(front.middles.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    ASSERT_TRUE(front.middles[i]);
    const auto [x, y] = *front.middles[i];
    EXPECT_EQ(seen(front.raster, x / static_cast<double>(front.raster.width),
                   y / static_cast<double>(front.raster.height)),
              static_cast<int>(i) + 1);
  }
  EXPECT_NEAR((*front.middles[0])[0], static_cast<double>(front.raster.width) / 2, 8);
  EXPECT_FALSE(of({.right = 180}).middles[0]) << "it is hidden";
}

TEST_F(CloudPictures, OnePoint) {
  const Cloud one = test::cloud_of({1, 2, 3}, 1, 1);
  const Raster raster = cloud_picture(&one, SceneTree(), std::vector<std::uint32_t>{1}, kColours,
                                      {.right = 10, .up = 90}, default_context())
                            .raster;
  EXPECT_EQ(raster.width, raster.height);
  EXPECT_EQ(seen(raster, 0.5, 0.5), 1);
}

}  // namespace
}  // namespace ph::segment
