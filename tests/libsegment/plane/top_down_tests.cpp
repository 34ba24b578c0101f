// SPDX-License-Identifier: MIT
// Cameras that look straight down on a table: the perpendicular from the origin meets the plane
// inside the picture. As a result, the coordinates of the plane's squares have both signs and pass
// through -1.
#include <gtest/gtest.h>

#include <random>

#include "tests/libsegment/plane/top_down_scene.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::segment {
namespace {

TEST(TopDown, LabelsAreRightAndTreesAreReadBack) {
  ph::test::for_each_seed(40, [](auto& random, bool, std::int64_t) {
    const test::TopDownScene scene(random);
    test::expect_right(scene, Method::surface);
  });
  ph::test::for_each_seed(10, [](auto& random, bool, std::int64_t) {
    const test::TopDownScene scene(random);
    test::expect_right(scene, Method::paper);
    test::expect_right(scene, Method::supervoxels);
  });
}

/// Two slabs of random points at a right angle.
std::vector<float> slabs(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> along(-0.5F, 0.5F), across(-0.02F, 0.02F);
  std::vector<float> xyz;
  for (int i = 0; i < 4000; ++i)
    for (const float c : {along(random), along(random), 1 + across(random)}) xyz.push_back(c);
  for (int i = 0; i < 4000; ++i)
    for (const float c : {along(random), across(random), 1 + along(random)}) xyz.push_back(c);
  return xyz;
}

TEST(TopDown, TreesOfSlabsAtRightAnglesAreReadBack) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<float> xyz = slabs(seed);
    for (const double voxel : {0.01, 0.02, 0.05})
      test::expect_read_back(segment(CloudView{xyz, {}}, {.voxel = voxel}));
  }
}

}  // namespace
}  // namespace ph::segment
