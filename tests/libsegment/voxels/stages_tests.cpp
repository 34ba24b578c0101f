// SPDX-License-Identifier: MIT
// Tests each stage separately, on data with known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "libsegment/src/plane/stages.hpp"
#include "libsegment/src/tree/cross_check.hpp"
#include "libsegment/src/voxels/rips_graph.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/detail/segment/tree_barcode.hpp"
#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::segment {
namespace {

using test::kHole;

std::vector<Index> all_of(Index n) {
  std::vector<Index> indices(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) indices[static_cast<std::size_t>(i)] = i;
  return indices;
}

Points random_points(Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  Points points(n, 3);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < 3; ++k) points(i, k) = coordinate(random);
  }
  return points;
}

TEST(RangeFilter, KeepsWhatIsInRangeAndNoHole) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> xyz = {0, 0, 1, kHole, 0,     1,     0,   0, 2,
                                  0, 0, 3, 0,     kHole, kHole, inf, 0, 1};
  EXPECT_EQ(range_filter({xyz, {}}, 2, {}), (std::vector<Index>{0, 2}));
  EXPECT_EQ(range_filter({xyz, {}}, kInfinity, {}), (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(range_filter({xyz, {1e200, 0, 0}}, kInfinity, {}), (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(range_filter({xyz, {0, 0, 3}}, 1, {}), (std::vector<Index>{2, 3}));
  EXPECT_EQ(range_filter({xyz, {}}, 0, {}), (std::vector<Index>{}));
}

TEST(RangeFilter, CropIncludesItsBorders) {
  const std::vector<float> xyz = {0, 0, 1, 0, 0, 2, 1, 0, 1, 1, 1, 1};
  const Box box{{0, 0, 1}, {1, 0, 1}};
  EXPECT_EQ(range_filter({xyz, {}}, 10, box), (std::vector<Index>{0, 2}));
}

TEST(VoxelGrid, MeansOfTheOccupiedVoxels) {
  const std::vector<float> xyz = {0.25F, 0.25F, 0.25F, 2.5F,  0.5F, 0.5F,
                                  0.75F, 0.25F, 0.5F,  -0.5F, 0.5F, 0.5F};
  const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(4), 1);
  ASSERT_EQ(grid.centroids.rows(), 3);
  EXPECT_EQ(grid.counts, (std::vector<Index>{1, 2, 1}));
  EXPECT_EQ(grid.voxel_of, (std::vector<std::uint32_t>{1, 2, 1, 0}));
  EXPECT_EQ(grid.centroids(0, 0), -0.5);
  EXPECT_EQ(grid.centroids(1, 0), 0.5);
  EXPECT_EQ(grid.centroids(1, 1), 0.25);
  EXPECT_EQ(grid.centroids(1, 2), 0.375);
  EXPECT_EQ(grid.centroids(2, 0), 2.5);
}

TEST(VoxelGrid, ZeroesOfBothSignsShareAVoxelAndBordersGoUp) {
  const std::vector<float> xyz = {0.0F, 0, 0, -0.0F, -0.0F, -0.0F, 1, 0, 0};
  const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(3), 1);
  EXPECT_EQ(grid.voxel_of, (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(VoxelGrid, EqualsASlowOneWithManyVoxels) {
  const Points points = random_points(60000, 7);
  std::vector<float> xyz;
  for (Index i = 0; i < points.size(); ++i) {
    xyz.push_back(static_cast<float>(points.data()[i] * 4 - 2));
  }
  const double voxel = 0.1;
  const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(points.rows()), voxel);
  // The keys are the coordinates (z, y, x) of the voxels.
  std::map<std::array<double, 3>, std::pair<std::array<double, 3>, Index>> slow;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    auto& [sum, count] = slow[{std::floor(xyz[i + 2] / voxel), std::floor(xyz[i + 1] / voxel),
                               std::floor(xyz[i] / voxel)}];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += xyz[i + k];
    ++count;
  }
  ASSERT_EQ(static_cast<std::size_t>(grid.centroids.rows()), slow.size());
  Index v = 0;
  for (const auto& [cell, entry] : slow) {
    EXPECT_EQ(grid.counts[static_cast<std::size_t>(v)], entry.second);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(grid.centroids(v, static_cast<Index>(k)),
                  entry.first[k] / static_cast<double>(entry.second), 1e-9);
    }
    ++v;
  }
}

TEST(VoxelGrid, InOrderHoweverFarApart) {
  const Points points = random_points(3000, 5);
  for (const float size : {1e-2F, 1.0F, 1e9F}) {  // up to 2^120 voxels in the bounding box
    std::vector<float> xyz;
    for (Index i = 0; i < points.rows(); ++i)
      for (Index k = 0; k < 3; ++k) xyz.push_back(size * static_cast<float>(points(i, k) - 0.5));
    const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(points.rows()), 1e-3);
    const auto from_last = [](const Vec3& c) { return Vec3{c[2], c[1], c[0]}; };
    EXPECT_TRUE(std::ranges::is_sorted(grid.cells, std::ranges::less(), from_last)) << size;
    for (std::size_t i = 0; i < grid.voxel_of.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(grid.cells[grid.voxel_of[i]][k], std::floor(double{xyz[3 * i + k]} / 1e-3));
  }
}

TEST(VoxelGrid, EmptyAndHugeAndTooSmall) {
  EXPECT_EQ(voxel_grid({{}, {}}, {}, 0.01).centroids.rows(), 0);
  const std::vector<float> far = {3e38F, -3e38F, 0, 1, 1, 1};
  EXPECT_EQ(voxel_grid({far, {}}, all_of(2), 1e-6).centroids.rows(), 2);
  EXPECT_THROW(voxel_grid({far, {}}, all_of(2), 1e-300), Error);
}

TEST(FiltrationValue, IsTheNextLevel) {
  EXPECT_EQ(filtration_value(0, 1, 10), 0);
  EXPECT_EQ(filtration_value(0.5, 1, 2), 0.5);
  EXPECT_EQ(filtration_value(0.50001, 1, 2), 1);
  EXPECT_EQ(filtration_value(1e-9, 1, 4), 0.25);
  EXPECT_EQ(filtration_value(0.3, 1, 0), 0.3);
  for (const double distance : {0.016, 0.025, 0.03, 1.0 / 3}) {
    for (int steps = 1; steps < 60; ++steps) {
      EXPECT_EQ(filtration_value(distance, distance, steps), distance);
      for (int k = 1; k < steps; ++k) {
        const double level = k * distance / steps;
        EXPECT_EQ(filtration_value(level, distance, steps), level);
        EXPECT_GT(filtration_value(std::nextafter(level, 1), distance, steps), level);
      }
    }
  }
}

class RipsGraphTest : public testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(RipsGraphTest, IsTheRipsFiltrationOfTheLibrary) {
  const auto [distance, steps] = GetParam();
  const Points points = random_points(400, 3);
  const FilteredGraph graph = rips_graph(points, distance, steps);
  std::vector<WeightedEdge> edges = SparseDistances::within(points, distance).edges();
  for (WeightedEdge& e : edges) e.value = filtration_value(e.value, distance, steps);
  const Rips rips(SparseDistances(points.rows(), edges), {.threshold = distance});
  EXPECT_EQ(graph.edge_count(), rips.graph(RipsForm::edges).edge_count());
  const Barcode ours = barcode_of(merge_tree(graph));
  EXPECT_EQ(first_difference(
                ours, persistence(
                          rips, {.max_dim = 0, .engine = Engine::standard, .min_persistence = -1})),
            "");
  EXPECT_EQ(cross_check(graph, ours), "");
  EXPECT_EQ(merge_tree(graph).components(kInfinity), merge_tree(rips).components(kInfinity));
}
INSTANTIATE_TEST_SUITE_P(DistancesAndSteps, RipsGraphTest,
                         testing::Combine(testing::Values(0.0, 0.02, 0.08, 0.3, 2.0),
                                          testing::Values(0, 1, 10, 5000)));

TEST(RipsGraph, EqualPointsAndTies) {
  Points grid(27 * 2, 3);  // a 3x3x3 grid with distances of 1, each point twice
  for (Index i = 0; i < 54; ++i) {
    grid.set_row(i, {static_cast<double>(i / 2 % 3), static_cast<double>(i / 6 % 3),
                     static_cast<double>(i / 18)});
  }
  const FilteredGraph graph = rips_graph(grid, 1, 0);
  EXPECT_EQ(graph.edge_count(), 27U + 54U * 4U);
  const MergeTree tree = merge_tree(graph);
  EXPECT_EQ(tree.merges.size(), 53U);
  EXPECT_EQ(cross_check(graph, barcode_of(tree)), "");
  EXPECT_EQ(rips_graph(grid, 0, 0).edge_count(), 27U);
  EXPECT_EQ(rips_graph(grid, 0, 10).edge_count(), 27U);
}

TEST(RipsGraph, FarFromTheOrigin) {
  const Points points{{1e12, 0, 0}, {1e12 + 1, 0, 0}, {1e12 + 3, 0, 0}};
  EXPECT_EQ(rips_graph(points, 1, 0).edge_count(), 1U);
  EXPECT_EQ(rips_graph(points, 2, 0).edge_count(), 2U);
}

TEST(RipsGraph, KeepsTheMemoryLimit) {
  RunContext context;
  context.memory.set_limit(100000);
  EXPECT_TRUE(ph::test::fails_with(ErrorKind::resource, [&] {
    rips_graph(random_points(2000, 1), 2, 10, context);
  })) << "two million edges in 100 kB";
}

}  // namespace
}  // namespace ph::segment
