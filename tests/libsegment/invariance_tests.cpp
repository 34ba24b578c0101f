// SPDX-License-Identifier: MIT
// Changes that must not change the segmentation: another order of the points, duplicates, scaling
// by powers of two, threads, holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "ph/persistence.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

using test::TableScene;

/// A scene with four boxes, two of which are close together, and noise of a millimetre.
std::vector<float> cluttered() {
  const TableScene scene({{{-0.22, -0.05, 0}, {-0.10, 0.07, 0.12}},
                          {{0.10, -0.05, 0}, {0.2, 0.05, 0.1}},
                          {{-0.04, -0.2, 0}, {0.05, -0.1, 0.08}},
                          {{0.07, -0.2, 0}, {0.2, -0.1, 0.05}}});
  std::vector<float> xyz = scene.xyz();
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.001F);
  for (float& c : xyz) c += noise(random);
  return xyz;
}

class Invariance : public testing::TestWithParam<Method> {
 protected:
  Segmentation segment(const CloudView& cloud, SegmentOptions options = {},
                       const RunContext& context = default_context()) const {
    options.method = GetParam();
    return segment::segment(cloud, options, context);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Invariance,
                         testing::Values(Method::surface, Method::paper, Method::supervoxels),
                         [](const auto& method) {
                           return std::string(test::name_of(method.param));
                         });

TEST_P(Invariance, OrderOfThePoints) {
  const std::vector<float> xyz = cluttered();
  const Segmentation s = segment(CloudView{xyz, {}});
  EXPECT_GE(s.cut.segments.size(), 3U);
  std::vector<std::size_t> order(xyz.size() / 3);
  std::iota(order.begin(), order.end(), 0U);
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    std::vector<float> shuffled;
    for (const std::size_t i : order) {
      for (std::size_t k = 0; k < 3; ++k) shuffled.push_back(xyz[3 * i + k]);
    }
    const Segmentation t = segment(CloudView{shuffled, {}});
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(t.cut.labels[i], s.cut.labels[order[i]]) << i;
    }
    EXPECT_EQ(t.tree.merge_tree.merges, s.tree.merge_tree.merges);
    EXPECT_TRUE(t.tree.vertices == s.tree.vertices);
  }
}

// Uses method paper. Method surface takes the noise of depth into account, and this noise does not
// scale with the scene.
TEST(Scaling, PowersOfTwo) {
  const std::vector<float> xyz = cluttered();
  const SegmentOptions o{.method = Method::paper};
  const Segmentation s = segment(CloudView{xyz, {}}, o);
  for (const double scale : {0.125, 1024.0}) {
    std::vector<float> scaled;
    for (const float c : xyz) scaled.push_back(static_cast<float>(c * scale));
    const Segmentation t =
        segment(CloudView{scaled, {}}, {.method = o.method,
                                        .voxel = o.voxel_size() * scale,
                                        .max_range = o.max_range * scale,
                                        .plane_distance = o.plane_margin() * scale,
                                        .distance = o.distance * scale});
    EXPECT_EQ(t.cut.labels, s.cut.labels);
    ASSERT_EQ(t.barcode.size(), s.barcode.size());
    for (std::size_t i = 0; i < s.barcode.size(); ++i) {
      ASSERT_EQ(t.barcode[i].death, s.barcode[i].death * scale);
    }
  }
}

TEST_P(Invariance, Duplicates) {
  const std::vector<float> xyz = cluttered();
  const Segmentation s = segment(CloudView{xyz, {}});
  std::vector<float> twice = xyz;
  twice.insert(twice.end(), xyz.begin(), xyz.end());
  const Segmentation t = segment(CloudView{twice, {}});
  std::vector<std::uint32_t> expected = s.cut.labels;
  expected.insert(expected.end(), s.cut.labels.begin(), s.cut.labels.end());
  EXPECT_EQ(t.cut.labels, expected);
  EXPECT_EQ(t.tree.merge_tree.merges, s.tree.merge_tree.merges);
}

TEST_P(Invariance, AllPointsEqual) {
  const std::vector<float> xyz(3 * 100000, 0.5F);
  const Segmentation s = segment(CloudView{xyz, {}}, {.min_size = 1});
  ASSERT_EQ(s.cut.segments.size(), 1U);
  EXPECT_EQ(s.cut.segments[0].voxels, 1);
  EXPECT_EQ(s.cut.segments[0].points, 100000);
  EXPECT_FALSE(s.tree.plane);
}

// The requested number of threads must not change the result. The pipeline runs on one thread, and
// only the homology of segments uses several threads.
TEST_P(Invariance, Threads) {
  const std::vector<float> xyz = cluttered();
  const Segmentation s = segment(CloudView{xyz, {}});
  for (const int threads : {1, 2, 7}) {
    RunContext context;
    context.threads = threads;
    const Segmentation t = segment(CloudView{xyz, {}}, {}, context);
    EXPECT_EQ(t.cut.labels, s.cut.labels);
    EXPECT_EQ(t.tree.merge_tree.merges, s.tree.merge_tree.merges);
  }
}

TEST(Signatures, AreTheSameForAnyNumberOfThreads) {
  std::vector<float> xyz;  // a bowl, which has a loop and enough voxels for several threads
  for (double a = 0.3; a < 1.57; a += 0.01)
    for (double b = 0; b < 6.2832; b += 0.01)
      for (const double c : {0.15 * std::sin(a) * std::cos(b), 0.15 * std::sin(a) * std::sin(b),
                             1 + 0.15 * std::cos(a)})
        xyz.push_back(static_cast<float>(c));
  const Segmentation s = segment(CloudView{xyz, {}}, {.plane = false, .objects = false});
  ASSERT_FALSE(s.cut.segments.empty());
  const auto bars = [&](int threads) {
    RunContext context;
    context.threads = threads;
    return signature(s.tree, s.cut, std::vector{1U}, context);
  };
  const Barcode one = bars(1);
  EXPECT_GT(one.bars(1).size(), 0U);
  for (const int threads : {2, 3, 7})
    EXPECT_EQ(first_difference(bars(threads), one), "") << threads;
}

TEST_P(Invariance, Holes) {
  const std::vector<float> xyz = cluttered();
  std::vector<float> dense;
  std::vector<std::uint32_t> expected;
  const Segmentation s = segment(CloudView{xyz, {}});
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    if (std::isnan(xyz[3 * i])) continue;
    dense.insert(dense.end(), {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    expected.push_back(s.cut.labels[i]);
  }
  ASSERT_LT(dense.size(), xyz.size());
  EXPECT_EQ(segment(CloudView{dense, {}}).cut.labels, expected);
}

}  // namespace
}  // namespace ph::segment
