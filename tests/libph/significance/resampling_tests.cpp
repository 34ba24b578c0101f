// SPDX-License-Identifier: MIT
#include "ph/significance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "ph/error.hpp"
#include "tests/libph/significance/random_points.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using test::expect_error;
using test::random_points;

RunContext& with_threads(RunContext& context, int threads) {
  context.threads = threads;
  return context;
}

// ---- a confidence radius

double distance(const Points& points, Index i, Index j) {
  double square = 0;
  for (Index k = 0; k < points.cols(); ++k)
    square += (points(i, k) - points(j, k)) * (points(i, k) - points(j, k));
  return std::sqrt(square);
}

/// The Hausdorff distances between the points and all their subsets of a given size, ascending.
std::vector<double> of_all_subsets(const Points& points, std::size_t size) {
  std::vector<double> result;
  const auto n = static_cast<std::size_t>(points.rows());
  for (std::size_t set = 0; set < std::size_t{1} << n; ++set) {
    if (static_cast<std::size_t>(std::popcount(set)) != size) continue;
    double farthest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double nearest = kInfinity;
      for (std::size_t j = 0; j < n; ++j)
        if (set >> j & 1)
          nearest =
              std::min(nearest, distance(points, static_cast<Index>(i), static_cast<Index>(j)));
      farthest = std::max(farthest, nearest);
    }
    result.push_back(farthest);
  }
  std::ranges::sort(result);
  return result;
}

TEST(ConfidenceRadius, IsTheQuantileOverAllSubsets) {
  std::mt19937 random(7);
  for (const Index dimension : {1, 2, 5}) {
    const Points points = random_points(random, 9, dimension);
    for (const std::size_t size : {1, 3, 8}) {
      const auto all = of_all_subsets(points, size);
      for (const double alpha : {0.05, 0.3, 0.9}) {
        const double found =
            confidence_radius(points, {.alpha = alpha, .subsamples = 20000, .size = size});
        // The quantile must be right within the sampling error of 20 000 draws.
        const auto at = [&](double share) {
          const double place = share * static_cast<double>(all.size());
          return 2 * all[static_cast<std::size_t>(
                         std::clamp(place, 0.0, static_cast<double>(all.size() - 1)))];
        };
        EXPECT_GE(found, at(1 - alpha - 0.02) * (1 - 1e-12)) << size << " " << alpha;
        EXPECT_LE(found, at(1 - alpha + 0.02) * (1 + 1e-12)) << size << " " << alpha;
      }
    }
    EXPECT_EQ(confidence_radius(points, {.size = 9}), 0);
  }
}

TEST(ConfidenceRadius, SeedsAndThreads) {
  std::mt19937 random(8);
  const Points points = random_points(random, 500, 2);
  RunContext one, three;
  const double found = confidence_radius(points, {.seed = 1}, with_threads(one, 1));
  EXPECT_EQ(confidence_radius(points, {.seed = 1}, with_threads(three, 3)), found);
  EXPECT_NE(confidence_radius(points, {.seed = 2}), found);
  EXPECT_GT(found, 0);
  // By default, subsamples have n / ln n points, here 80.
  EXPECT_EQ(confidence_radius(points, {.size = 80, .seed = 1}), found);
  // For equal points, the radius is 0.
  EXPECT_EQ(confidence_radius(Points{{1, 2}, {1, 2}, {1, 2}, {1, 2}}), 0);
  EXPECT_EQ(confidence_radius(Points(3, 0)), 0);
  EXPECT_EQ(confidence_radius(Points{{5}}), 0);
}

TEST(ConfidenceRadius, Errors) {
  const Points points{{0}, {1}};
  expect_error(ErrorKind::usage, "alpha: found 0",
               [&] { confidence_radius(points, {.alpha = 0}); });
  expect_error(ErrorKind::usage, "alpha: found 1",
               [&] { confidence_radius(points, {.alpha = 1}); });
  expect_error(ErrorKind::usage, "size: found 3", [&] { confidence_radius(points, {.size = 3}); });
  expect_error(ErrorKind::usage, "subsamples",
               [&] { confidence_radius(points, {.subsamples = 0}); });
  expect_error(ErrorKind::usage, "no points", [&] { confidence_radius(Points()); });
  EXPECT_THROW(confidence_radius(Points{{0}, {std::nan("")}}), Error);
  test::StoppedContext context;
  std::mt19937 random(9);
  expect_error(ErrorKind::cancelled, "",
               [&] { confidence_radius(random_points(random, 2000, 2), {}, context); });
}

// ---- a confidence band

TEST(MultiplierBootstrap, OfOneNumberIsTheOneOfStudent) {
  std::mt19937 random(10);
  std::normal_distribution<> number(3, 2);
  std::vector<double> samples(60);
  for (double& x : samples) x = number(random);
  double mean = 0, variance = 0;
  for (const double x : samples) mean += x / 60;
  for (const double x : samples) variance += (x - mean) * (x - mean) / 60;
  const ConfidenceBand band = multiplier_bootstrap(samples, 60, {.repetitions = 20000});
  EXPECT_NEAR(band.mean.at(0), mean, 1e-12);
  EXPECT_NEAR(band.half_width, 1.96 * std::sqrt(variance / 60),
              0.02 * std::sqrt(variance / 60) * 2);
  const ConfidenceBand wide =
      multiplier_bootstrap(samples, 60, {.alpha = 0.01, .repetitions = 20000});
  EXPECT_NEAR(wide.half_width, 2.576 * std::sqrt(variance / 60), 0.1 * std::sqrt(variance / 60));
}

TEST(MultiplierBootstrap, CoversTheTrueMean) {
  std::mt19937 random(11);
  std::uniform_real_distribution<> number(0, 1);
  int covered = 0;
  constexpr int rounds = 400, samples = 80, length = 6;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> functions;
    for (int i = 0; i < samples; ++i)
      for (int j = 0; j < length; ++j) functions.push_back(number(random) * (1 + j));
    const ConfidenceBand band =
        multiplier_bootstrap(functions, samples, {.alpha = 0.1, .repetitions = 300});
    bool is_inside = true;
    for (int j = 0; j < length; ++j)
      is_inside &=
          std::abs(band.mean[static_cast<std::size_t>(j)] - 0.5 * (1 + j)) <= band.half_width;
    covered += is_inside;
  }
  EXPECT_NEAR(covered / static_cast<double>(rounds), 0.9, 0.06);
}

TEST(MultiplierBootstrap, SeedsThreadsAndErrors) {
  std::vector<double> functions(200);
  std::mt19937 random(12);
  for (double& x : functions) x = std::uniform_real_distribution<>(0, 1)(random);
  RunContext one, three;
  const auto found = multiplier_bootstrap(functions, 10, {}, with_threads(one, 1));
  EXPECT_EQ(multiplier_bootstrap(functions, 10, {}, with_threads(three, 3)).half_width,
            found.half_width);
  EXPECT_NE(multiplier_bootstrap(functions, 10, {.seed = 1}).half_width, found.half_width);
  EXPECT_EQ(multiplier_bootstrap(std::vector<double>(6, 2.5), 3).half_width, 0);
  EXPECT_TRUE(multiplier_bootstrap({}, 3).mean.empty());
  expect_error(ErrorKind::usage, "found 1 samples", [&] { multiplier_bootstrap(functions, 1); });
  expect_error(ErrorKind::usage, "found 200 numbers for 7 samples, expected a multiple of 7",
               [&] { multiplier_bootstrap(functions, 7); });
  expect_error(ErrorKind::usage, "repetitions",
               [&] { multiplier_bootstrap(functions, 10, {.repetitions = 0}); });
  expect_error(ErrorKind::usage, "alpha",
               [&] { multiplier_bootstrap(functions, 10, {.alpha = std::nan("")}); });
  functions[3] = kInfinity;
  expect_error(ErrorKind::bad_data, "found inf", [&] { multiplier_bootstrap(functions, 10); });
}

// ---- a test whether groups differ

DistanceMatrix matrix_of(const std::vector<double>& places) {
  std::vector<double> lower;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) lower.push_back(std::abs(places[i] - places[j]));
  return {static_cast<Index>(places.size()), std::move(lower)};
}

double loss_by_definition(const std::vector<double>& places,
                          const std::vector<std::int64_t>& groups, double power) {
  double loss = 0;
  for (const std::int64_t group : std::set<std::int64_t>(groups.begin(), groups.end())) {
    const auto size = static_cast<double>(std::ranges::count(groups, group));
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < places.size(); ++j)
        if (groups[i] == group && groups[j] == group)
          loss += std::pow(std::abs(places[i] - places[j]), power) / (2 * size * (size - 1));
  }
  return loss;
}

TEST(PermutationTests, AreNearTheExactTest) {
  std::mt19937 random(13);
  for (int round = 0; round < 6; ++round) {
    std::vector<double> places(7);
    for (double& x : places) x = std::floor(std::uniform_real_distribution<>(0, 20)(random));
    std::vector<std::int64_t> groups{5, 5, 5, -1, -1, -1, -1};
    if (round % 2 == 1) groups = {1, 2, 3, 1, 2, 3, 3};
    for (const double power : {1.0, 2.0}) {
      const double observed = loss_by_definition(places, groups, power);
      std::vector<std::int64_t> order = groups;
      std::ranges::sort(order);
      int all = 0, as_low = 0;
      do {
        ++all;
        as_low += loss_by_definition(places, order, power) <= observed * (1 + 1e-9);
      } while (std::ranges::next_permutation(order).found);
      const PermutationTest found =
          permutation_test(matrix_of(places), groups, {.shuffles = 20000, .power = power});
      EXPECT_NEAR(found.p, as_low / static_cast<double>(all), 0.015);
      EXPECT_NEAR(found.loss, observed, 1e-12 * observed);
    }
  }
}

// Powers of very large distances would overflow, and powers of very small distances would
// underflow.
TEST(PermutationTests, UnitsDoNotMatter) {
  const std::vector<double> places{20, 21.5, 20.25, 40, 41, 40.3};
  const std::vector<std::int64_t> groups{0, 0, 0, 1, 1, 1};
  const auto p_in = [&](double unit) {
    std::vector<double> scaled = places;
    for (double& x : scaled) x *= unit;
    return permutation_test(matrix_of(scaled), groups, {.power = 2}).p;
  };
  EXPECT_LT(p_in(1), 0.2);
  EXPECT_EQ(p_in(1e160), p_in(1));
  EXPECT_EQ(p_in(1e-200), p_in(1));
}

TEST(PermutationTests, SeedsAndThreads) {
  std::vector<double> places;
  std::vector<std::int64_t> groups;
  std::mt19937 random(14);
  for (int i = 0; i < 40; ++i) {
    groups.push_back(i % 2);
    places.push_back(std::normal_distribution<>(0.5 * (i % 2), 1)(random));
  }
  RunContext one, three;
  const double p = permutation_test(matrix_of(places), groups, {}, with_threads(one, 1)).p;
  EXPECT_EQ(permutation_test(matrix_of(places), groups, {}, with_threads(three, 3)).p, p);
  EXPECT_NE(permutation_test(matrix_of(places), groups, {.seed = 9}).p, p);
  // If the groups are far apart, the p-value is the smallest that is possible with this number of
  // shuffles.
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += 100 * static_cast<double>(groups[i]);
  EXPECT_EQ(permutation_test(matrix_of(places), groups, {.shuffles = 99}).p, 0.01);
}

TEST(PermutationTests, Errors) {
  const DistanceMatrix distances = matrix_of({0, 1, 2, 3});
  const auto of = [&](std::vector<std::int64_t> groups, PermutationOptions options = {}) {
    return [&, groups, options] { permutation_test(distances, groups, options); };
  };
  expect_error(ErrorKind::usage, "found the groups of 3 diagrams, expected those of 4",
               of({0, 0, 1}));
  expect_error(ErrorKind::usage, "one diagram in group 7", of({0, 0, 0, 7}));
  expect_error(ErrorKind::usage, "found 1 groups", of({0, 0, 0, 0}));
  expect_error(ErrorKind::usage, "shuffles", of({0, 0, 1, 1}, {.shuffles = 0}));
  expect_error(ErrorKind::usage, "power", of({0, 0, 1, 1}, {.power = 0}));
  const DistanceMatrix infinite(4, {1, 2, 3, kInfinity, 1, 1});
  expect_error(ErrorKind::bad_data, "diagrams 0 and 3: found an infinite distance", [&] {
    permutation_test(infinite, std::vector<std::int64_t>{0, 0, 1, 1});
  });
}

}  // namespace
}  // namespace ph
