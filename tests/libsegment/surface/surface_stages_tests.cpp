// SPDX-License-Identifier: MIT
// The stages of method surface one by one: neighbours, normals, concavity, basins.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "libsegment/src/surface/concavity.hpp"
#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/eigen.hpp"
#include "ph/error.hpp"
#include "tests/libsegment/scenery.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::segment {
namespace {

using test::all_of;

TEST(VoxelPairs, ThoseWithinARadiusInTheirOrder) {
  for (const std::uint32_t size : {0U, 1U, 255U, 256U, 257U, 1000U}) {
    VoxelPairs pairs;
    for (std::uint32_t i = 0; i < size; ++i)
      pairs.push_back({i, i + 1, static_cast<float>(i * 7 % 10)});
    std::vector<std::uint32_t> expected, found;
    for (const VoxelPair& p : pairs)
      if (p.distance < 5) expected.push_back(p.u);
    for_each_within(pairs, 5, [&](const VoxelPair& p) { found.push_back(p.u); });
    EXPECT_EQ(found, expected);
  }
}

TEST(VoxelPairs, AreAllThatAreClose) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-0.04F, 0.05F);
  for (const double radius : {0.3, 1.0, 2.4, 3.0}) {
    std::vector<float> xyz(3 * 1500);
    for (float& c : xyz) c = coordinate(random);
    constexpr double voxel = 0.006;
    const VoxelGrid grid = voxel_grid({xyz, {}}, all_of(xyz), voxel);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> expected;
    for (Index v = 0; v < grid.centroids.rows(); ++v)
      for (Index u = 0; u < v; ++u) {
        const double d =
            (as_matrix(grid.centroids).row(u) - as_matrix(grid.centroids).row(v)).norm();
        if (d < radius * voxel) expected[{u, v}] = d;
      }
    const VoxelPairs pairs = close_voxels(grid, voxel, radius);
    EXPECT_EQ(pairs.size(), expected.size());
    for (const VoxelPair& p : pairs) {
      const auto it = expected.find({p.u, p.v});
      ASSERT_NE(it, expected.end());
      EXPECT_FLOAT_EQ(p.distance, static_cast<float>(it->second));
    }
  }
}

TEST(VoxelPairs, FarAwayThereAreNoneAndAnError) {
  const auto refuses = [](const VoxelGrid& grid) {
    return ph::test::fails_with(ErrorKind::usage, [&] { close_voxels(grid, 0.005, 3); });
  };
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const double sign : {-1.0, 1.0}) {
      VoxelGrid grid{std::vector<Vec3>(1), Points(1, 3), {1}, {0}};
      grid.cells[0][axis] = sign * 0x1p52;
      EXPECT_EQ(close_voxels(grid, 0.005, 3).size(), 0U);
      grid.cells[0][axis] = sign * 0x1p53;
      EXPECT_TRUE(refuses(grid)) << axis << ' ' << sign;
    }
  }
}

/// The kind of the error if one point is segmented with these options; empty if there is no error.
std::optional<ErrorKind> failure(const std::vector<float>& xyz, const Vec3& viewpoint,
                                 const SegmentOptions& options) {
  try {
    segment(CloudView{xyz, viewpoint}, options);
  } catch (const Error& error) {
    return error.kind();
  }
  return std::nullopt;
}

TEST(VoxelPairs, EveryWayToVoxelsWithoutNeighboursIsRefused) {
  for (const Method method : {Method::surface, Method::supervoxels}) {
    const auto far = static_cast<float>(0x1p70);
    EXPECT_EQ(failure({0, 0, far}, {0, 0, far}, {.method = method}), ErrorKind::usage);
    EXPECT_EQ(
        failure({0, 1e20F, 0}, {}, {.method = method, .voxel = 0.005, .max_range = kInfinity}),
        ErrorKind::usage);
    EXPECT_EQ(failure({0, 0, 1}, {}, {.method = method, .voxel = 1e-17}), ErrorKind::usage);
  }
  EXPECT_EQ(failure({0, 0, 1}, {}, {.method = Method::paper, .voxel = 1e-17}), std::nullopt);
  EXPECT_EQ(failure({0, 1e20F, 0}, {}, {.max_range = kInfinity}), std::nullopt)
      << "the default voxel grows with the range";
}

TEST(VoxelPairs, HugeVoxelsAreRefusedOrHoldAll) {
  const std::vector<float> xyz = {0, 0, 1, 3e38F, 0, 1, -3e38F, 0, 1};
  for (const Method method : {Method::surface, Method::paper, Method::supervoxels}) {
    for (const double voxel : {6e307, 1e308, 1e-300, 1.1e30})
      EXPECT_EQ(failure(xyz, {}, {.method = method, .voxel = voxel}), ErrorKind::usage) << voxel;
    SegmentOptions huge{.method = method, .voxel = 1e30, .min_size = 1, .max_range = kInfinity};
    huge.spacing = 1e30;
    EXPECT_EQ(segment(CloudView{xyz, {}}, huge).tree.vertices.rows(), 3);
    huge.max_range = 2;
    EXPECT_EQ(segment(CloudView{xyz, {}}, huge).tree.vertices.rows(), 1);
  }
}

/// Two half planes that meet in the line y = z = 0, seen from high above. On both sides of this
/// line, they rise at a given angle.
Points valley(double angle, double step) {
  std::vector<Vec3> points;
  for (double x = -0.05; x < 0.05; x += step) {
    for (double t = -0.05; t < 0.05; t += step)
      points.push_back({x, t * std::cos(angle), std::abs(t) * std::sin(angle)});
  }
  Points result(static_cast<Index>(points.size()), 3);
  for (Index i = 0; i < result.rows(); ++i)
    for (Index k = 0; k < 3; ++k)
      result(i, k) = points[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return result;
}

std::vector<VoxelPair> pairs_within(const Points& points, double radius) {
  std::vector<VoxelPair> pairs;
  for (std::uint32_t v = 0; v < points.rows(); ++v)
    for (std::uint32_t u = 0; u < v; ++u)
      if (const double d = (as_matrix(points).row(u) - as_matrix(points).row(v)).norm(); d < radius)
        pairs.push_back({u, v, static_cast<float>(d)});
  return pairs;
}

TEST(Normals, AreTheDirectionsOfLeastSpread) {
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  for (int round = 0; round < 2000; ++round) {
    // Random points. Their shapes range from a ball to a strip of 10 mm by 10 um by 10 nm.
    const Eigen::Vector3d sizes(1, std::pow(10, -1.0 * (round % 4)),
                                std::pow(10, -1.0 * (round % 7)));
    const Eigen::Matrix3d turn = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    PointMatrix points(3 + round % 20, 3);
    for (Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3d p(gauss(random), gauss(random), gauss(random));
      points.row(i) = (0.01 * (turn * (sizes.array() * p.array()).matrix())).transpose();
    }
    const Eigen::RowVector3d mean = points.colwise().mean();
    const Eigen::Matrix3d scatter =
        (points.rowwise() - mean).transpose() * (points.rowwise() - mean);
    std::vector<VoxelPair> pairs;
    for (std::uint32_t v = 1; v < points.rows(); ++v)
      pairs.push_back({0, v, static_cast<float>((points.row(v) - points.row(0)).norm())});
    const Points normals = surface_normals(to_points(points), pairs, 1, {0, 0, 10});
    const Eigen::Vector3d n = as_matrix(normals).row(0).transpose();
    ASSERT_NEAR(n.norm(), 1, 1e-12);
    // The least spread is unique, even if several directions have it.
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[0];
    ASSERT_NEAR(n.dot(scatter * n), least, 1e-9 * scatter.trace()) << sizes.transpose();
  }
}

TEST(Concavity, IsLargeInValleysAndZeroOnRidges) {
  for (const double angle : {-0.6, 0.0, 0.3, 0.6}) {
    const Points points = valley(angle, 0.005);
    const auto pairs = pairs_within(points, 0.015);
    const Points normals = surface_normals(points, pairs, 0.012, {0, 0, 10});
    const std::vector<double> f = concavity(points, normals, pairs);
    double seam = 0, flat = 0;
    for (Index v = 0; v < points.rows(); ++v) {
      EXPECT_NEAR(as_matrix(normals).row(v).norm(), 1, 1e-9);
      EXPECT_GT(normals(v, 2), 0);
      const double value = f[static_cast<std::size_t>(v)];
      EXPECT_GE(value, 0);
      if (std::abs(points(v, 1)) < 0.004) seam = std::max(seam, value);
      if (std::abs(points(v, 1)) > 0.03) flat = std::max(flat, value);
    }
    EXPECT_LT(flat, 1e-9);
    if (angle <= 0)
      EXPECT_LT(seam, 1e-9);
    else
      EXPECT_GT(seam, 0.3 * std::sin(angle));
  }
}

/// A corner of a box on a larger box, seen from above: the top of the lower box (z = 0) and two
/// walls of the upper box, which meet at the origin.
Points corner_on_a_box(double step) {
  std::vector<Vec3> points;
  for (double x = -0.05; x < 0.05; x += step)
    for (double y = -0.05; y < 0.05; y += step)
      if (x < 0 || y < 0) points.push_back({x, y, 0});
  for (double z = step; z < 0.05; z += step) {
    points.push_back({0, 0, z});
    for (double t = step; t < 0.05; t += step) {
      points.push_back({0, t, z});
      points.push_back({t, 0, z});
    }
  }
  Points result(static_cast<Index>(points.size()), 3);
  for (Index i = 0; i < result.rows(); ++i)
    for (Index k = 0; k < 3; ++k)
      result(i, k) = points[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return result;
}

TEST(Concavity, IsLargeWhereASeamGoesAroundACorner) {
  const Points points = corner_on_a_box(0.005);
  const auto pairs = pairs_within(points, 0.015);
  const Points normals = surface_normals(points, pairs, 0.012, {-1, -1, 1});
  const std::vector<double> f = concavity(points, normals, pairs);
  int places = 0;
  for (std::uint32_t v = 0; v < f.size(); ++v) {
    // Next to the vertical edge and a little above the seam, the surface is a ridge in one
    // direction and a valley in the other.
    if (std::abs(points(v, 2) - 0.01) > 1e-9 ||
        std::abs(points(v, 0) + points(v, 1) - 0.005) > 1e-9)
      continue;
    double sum = 0;
    int count = 0;
    for (const VoxelPair& pair : pairs)
      if (pair.u == v || pair.v == v) {
        sum += rise(points, normals, pair);
        ++count;
      }
    EXPECT_LT(sum / count, 0.03) << "the mean over all directions hides the valley";
    EXPECT_GT(f[v], 0.13);
    ++places;
  }
  EXPECT_EQ(places, 2);
}

TEST(Concavity, FewNeighboursHaveNoNormalAndNoValue) {
  Points points{{0, 0, 1}, {0, 0.01, 1}};
  const auto pairs = pairs_within(points, 0.02);
  const Points normals = surface_normals(points, pairs, 0.02, {});
  EXPECT_TRUE(std::isnan(normals(0, 0)));
  EXPECT_EQ(concavity(points, normals, pairs), (std::vector<double>{0, 0}));
}

TEST(MergeTree, BasinsAreWhatTheCutLeaves) {
  // A path with the values 0 5 1 9 2 3. The minima have the values 0, 1 and 2, and the merges are
  // at 5 and 9.
  const std::vector<double> values = {0, 5, 1, 9, 2, 3};
  std::vector<WeightedEdge> edges;
  for (Index v = 1; v < 6; ++v) edges.push_back({v - 1, v, 0.0});
  const MergeTree tree = merge_tree(FilteredGraph::lower_star(values, edges));
  const auto sizes = [&](double persistence, Index size) {
    std::map<Index, Index> count;
    for (const Index b : tree.basins(persistence, size)) ++count[b];
    std::vector<Index> result;
    for (const auto& [basin, n] : count) result.push_back(n);
    std::ranges::sort(result);
    return result;
  };
  EXPECT_EQ(sizes(1, 1), (std::vector<Index>{2, 2, 2}));
  EXPECT_EQ(sizes(5, 1), (std::vector<Index>{2, 4}));  // the merge at 5 has persistence 4
  EXPECT_EQ(sizes(8, 1), (std::vector<Index>{6}));
  // The component that merges at 5 has only one vertex, which is too few.
  EXPECT_EQ(sizes(1, 2), (std::vector<Index>{2, 4}));
}

}  // namespace
}  // namespace ph::segment
