// SPDX-License-Identifier: MIT
#include "ph/points.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "ph/distance_to_measure.hpp"
#include "ph/eigen.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/persistence.hpp"
#include "ph/voxel_image.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

TEST(PointsOwner, IsWhatItWasMadeOf) {
  const Points points{{0, 1}, {2, 3}, {4, 5}};
  EXPECT_EQ(points.rows(), 3);
  EXPECT_EQ(points.cols(), 2);
  EXPECT_EQ(points(2, 1), 5);
  EXPECT_EQ(points.row(1)[0], 2);
  EXPECT_TRUE(std::ranges::equal(points.coordinates(), std::array{0, 1, 2, 3, 4, 5}));
  const Points zero(2, 3);
  EXPECT_TRUE(std::ranges::all_of(zero.coordinates(), [](double x) { return x == 0; }));
  EXPECT_EQ(Points().rows(), 0);
  EXPECT_EQ(Points(0, 3).cols(), 3);
  EXPECT_EQ(Points(7, 0).rows(), 7);
  expect_error(ErrorKind::usage, "point 1: found 1 coordinates, expected 2", [] {
    Points{{0, 1}, {2}};
  });
  expect_error(ErrorKind::usage, "no negative number", [] { Points(-1, 2); });
  expect_error(ErrorKind::usage, "-1 x 3", [] { PointsView(nullptr, -1, 3); });
  EXPECT_THROW(Points(Index{1} << 40, Index{1} << 40), std::bad_alloc);
}

TEST(PointsOwner, CopiesMovesAndShrinks) {
  Points points{{0, 1}, {2, 3}, {4, 5}};
  Points copy = points;
  copy(0, 0) = 9;
  EXPECT_EQ(points(0, 0), 0);
  EXPECT_NE(copy, points);
  const Points moved = std::move(copy);
  EXPECT_EQ(moved(0, 0), 9);
  EXPECT_EQ(copy.rows(), 0);  // NOLINT: what was moved from is empty
  points.keep_rows(2);
  EXPECT_EQ(points, (Points{{0, 1}, {2, 3}}));
  points.keep_rows(0);
  EXPECT_EQ(points.rows(), 0);
  points = moved;
  EXPECT_EQ(points, moved);
}

TEST(PointsOwner, TakesNumbersOfAnyType) {
  const std::array<std::uint16_t, 6> shorts{0, 65535, 2, 3, 4, 5};
  EXPECT_EQ(Points::of(shorts.data(), 3, 2, 2, 1), (Points{{0, 65535}, {2, 3}, {4, 5}}));
  EXPECT_EQ(Points::of(shorts.data(), 2, 3, 1, 2), (Points{{0, 2, 4}, {65535, 3, 5}}));
  const std::array<float, 2> floats{0.1F, -1};
  EXPECT_EQ(Points::of(floats.data(), 2, 1, 1, 1), (Points{{double{0.1F}}, {-1}}));
}

/// Reads the same points in several layouts. Each layout must give the same result as contiguous
/// rows.
void expect_same_from(PointsView view, const Points& points, std::int64_t field) {
  ASSERT_EQ(Points(view), points);
  for (const PointDistance distance : {PointDistance::euclidean, PointDistance::manhattan}) {
    const auto bars = [&](PointsView p) {
      const Barcode all = persistence(Rips(p, {.distance = distance}), {.field = field});
      const Barcode few = persistence(Rips(p, {.threshold = 0.5, .distance = distance}));
      const Barcode tree = persistence(Rips(p, {.distance = distance}), {.max_dim = 0});
      return std::array{all, few, tree};
    };
    const auto expected = bars(points), found = bars(view);
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_EQ(first_difference(expected[k], found[k]), "");
  }
  if (points.rows() == 0) return;
  EXPECT_EQ(greedy_permutation(view).points, greedy_permutation(points).points);
  EXPECT_EQ(distance_to_measure(view, 1), distance_to_measure(points, 1));
  EXPECT_EQ(SparseDistances::within(view, 0.7).edges(),
            SparseDistances::within(points, 0.7).edges());
  if (points.cols() > 0) {
    EXPECT_EQ(voxel_image(view, 0.3).image.values, voxel_image(points, 0.3).image.values);
  }
}

TEST(PointsViews, AreTheSamePointsInAnyLayout) {
  for_each_seed(150, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random.points(random.integer(0, 9), random.integer(0, 4), ties);
    const Index n = points.rows(), d = points.cols();
    const Eigen::MatrixXd by_columns = as_matrix(points);
    expect_same_from(by_columns, points, field);
    // Views of every second row and of the columns 1 to d of a matrix. The matrix is stored in
    // row-major or in column-major order.
    PointMatrix wide = PointMatrix::Constant(2 * n + 1, d + 2, 77);
    Eigen::MatrixXd wide_by_columns = wide;
    for (Index i = 0; i < n; ++i) {
      wide.row(2 * i).segment(1, d) = as_matrix(points).row(i);
      wide_by_columns.row(2 * i).segment(1, d) = as_matrix(points).row(i);
    }
    expect_same_from(PointsView(wide.data() + 1, n, d, 2 * wide.cols(), 1), points, field);
    expect_same_from(PointsView(wide_by_columns.data() + wide_by_columns.rows(), n, d, 2,
                                wide_by_columns.rows()),
                     points, field);
    // The rows in reverse order.
    const PointMatrix reversed = as_matrix(points).colwise().reverse();
    expect_same_from(PointsView(reversed.data() + (n - 1) * d, n, d, -d, 1), points, field);
  });
}

// A matrix of other numbers was taken for a metric, of which each number is a point.
static_assert(Metric<PointMetric>);
static_assert(!Metric<Eigen::MatrixXf> && !Metric<Eigen::MatrixXi> && !Metric<Eigen::MatrixXd>);
static_assert(!std::constructible_from<Rips, const Eigen::MatrixXf&>);
static_assert(std::constructible_from<Rips, const Eigen::MatrixXd&>);

// A matrix with one point per column was taken for three points in many axes.
static_assert(detail::has_points_in_columns<Eigen::Matrix3Xd>());
static_assert(!detail::has_points_in_columns<Eigen::Transpose<const Eigen::Matrix3Xd>>());
static_assert(!detail::has_points_in_columns<Eigen::MatrixX3d>());
static_assert(!detail::has_points_in_columns<Eigen::MatrixXd>());
static_assert(!detail::has_points_in_columns<Eigen::RowVectorXd>());
static_assert(!detail::has_points_in_columns<Eigen::Matrix3d>());
static_assert(!detail::has_points_in_columns<Eigen::Block<Eigen::MatrixXd>>());

TEST(PointsViews, OfEigenTakeNoCopy) {
  Points points{{0, 1}, {2, 3}};
  EXPECT_EQ(as_matrix(points).data(), points.data());
  as_matrix(points)(1, 0) = 7;
  EXPECT_EQ(points(1, 0), 7);
  const PointMatrix matrix = as_matrix(points);
  EXPECT_EQ(PointsView(matrix).row(0), matrix.data());
  EXPECT_TRUE(PointsView(matrix).has_whole_rows());
  EXPECT_EQ(WholeRows(matrix).view().row(0), matrix.data());
  const Eigen::MatrixXd by_columns = matrix;
  EXPECT_FALSE(PointsView(by_columns).has_whole_rows());
  EXPECT_EQ(PointsView(matrix.block(0, 1, 2, 1))(1, 0), 3);
  EXPECT_EQ(to_points(matrix * 2), (Points{{0, 2}, {14, 6}}));
}

TEST(DelayEmbedding, HasTheValuesOfLaterTimes) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Points series = random.points(random.integer(1, 30), random.integer(1, 3), ties);
    const Index dimension = random.integer(1, 5), delay = random.integer(1, 4);
    const Index most = series.rows() - (dimension - 1) * delay;
    if (most <= 0) {
      expect_error(ErrorKind::bad_data, "expected more than",
                   [&] { static_cast<void>(delay_embedding(series, dimension, delay)); });
      return;
    }
    // The coordinates are stored column by column.
    std::vector<double> by_columns;
    for (Index k = 0; k < series.cols(); ++k)
      for (Index t = 0; t < series.rows(); ++t) by_columns.push_back(series(t, k));
    const PointsView columns(by_columns.data(), series.rows(), series.cols(), 1, series.rows());
    const Points points = delay_embedding(series, dimension, delay);
    EXPECT_EQ(points, delay_embedding(columns, dimension, delay));
    ASSERT_EQ(points.rows(), most);
    ASSERT_EQ(points.cols(), dimension * series.cols());
    for (Index i = 0; i < most; ++i) {
      std::vector<double> expected;
      for (Index d = 0; d < dimension; ++d)
        for (Index k = 0; k < series.cols(); ++k) expected.push_back(series(i + d * delay, k));
      EXPECT_TRUE(std::ranges::equal(points.row(i), expected));
    }
  });
}

TEST(DelayEmbedding, RefusesWhatMakesNoSense) {
  const Points series(9, 1);
  const auto embed = [&](Index dimension, Index delay) {
    return [&series, dimension, delay] {
      static_cast<void>(delay_embedding(series, dimension, delay));
    };
  };
  expect_error(ErrorKind::usage, "dimension", embed(0, 1));
  expect_error(ErrorKind::usage, "delay", embed(2, 0));
  expect_error(ErrorKind::bad_data, "9 times", embed(2, 9));
  expect_error(ErrorKind::bad_data, "9 times", embed(INT64_MAX, INT64_MAX));
  expect_error(ErrorKind::bad_data, "0 times",
               [] { static_cast<void>(delay_embedding(Points(0, 1), 1)); });
  EXPECT_EQ(delay_embedding(series, 2, 8).rows(), 1);
}

}  // namespace
}  // namespace ph::test
