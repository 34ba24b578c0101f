// SPDX-License-Identifier: MIT
#include "ph/significance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "support/expect_error.hpp"

namespace ph {
namespace {

using test::expect_error;

RunContext& with_threads(RunContext& context, int threads) {
  context.threads = threads;
  return context;
}

// ---- random numbers

TEST(Randoms, BelowIsUniform) {
  Random random(1);
  for (const std::uint64_t count : {1, 2, 7, 10}) {
    std::map<std::uint64_t, int> seen;
    for (int i = 0; i < 20000; ++i) ++seen[random.below(count)];
    ASSERT_EQ(seen.size(), count);
    const double expected = 20000.0 / static_cast<double>(count);
    for (const auto& [number, times] : seen) EXPECT_NEAR(times, expected, 5 * std::sqrt(expected));
  }
}

TEST(Randoms, NormalHasItsMoments) {
  Random random(2);
  constexpr int n = 200000;
  double mean = 0, square = 0, fourth = 0;
  int below_one = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
    below_one += x < 1;
  }
  EXPECT_NEAR(mean, 0, 0.01);
  EXPECT_NEAR(square, 1, 0.02);
  EXPECT_NEAR(fourth, 3, 0.15);
  EXPECT_NEAR(static_cast<double>(below_one) / n, 0.841345, 0.004);
}

TEST(Randoms, EachSubsetIsDrawnAsOften) {
  Random random(3);
  std::map<std::set<int>, int> seen;
  for (int i = 0; i < 10000; ++i) {
    std::vector<int> numbers{0, 1, 2, 3, 4};
    draw(numbers, 2, random);
    ASSERT_EQ(std::set<int>(numbers.begin(), numbers.end()).size(), 5U);
    ++seen[{numbers[0], numbers[1]}];
  }
  ASSERT_EQ(seen.size(), 10U);
  for (const auto& [subset, times] : seen) EXPECT_NEAR(times, 1000, 160);
}

TEST(Randoms, TasksHaveSequencesOfTheirOwn) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (std::uint64_t task = 0; task < 30; ++task) seen.insert(Random(seed, task).bits());
  EXPECT_EQ(seen.size(), 900U);
  EXPECT_EQ(Random(4, 5).bits(), Random(4, 5).bits());
}

// ---- a p-value for each bar

double p_by_definition(const std::vector<Bar>& bars, const Bar& bar, double a) {
  double mean = 0;
  for (const Bar& other : bars)
    mean += a * std::log(std::log(other.death / other.birth)) / static_cast<double>(bars.size());
  const double b = -0.5772156649015329 - mean;
  return std::exp(-std::exp(a * std::log(std::log(bar.death / bar.birth)) + b));
}

TEST(UniversalPValues, AreThoseOfTheDefinition) {
  const std::vector<Bar> bars{{1, 1, 2}, {1, 0.5, 3}, {1, 2, 2.1}, {1, 1.5, 1.75}};
  for (const auto& [filtration, a] :
       {std::pair(DistanceFiltration::rips, 1.0), {DistanceFiltration::cech, 0.5}}) {
    const BarPValues found = universal_p_values(bars, filtration);
    EXPECT_EQ(found.tested, 4U);
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_NEAR(found.p[i], p_by_definition(bars, bars[i], a), 1e-14);
      EXPECT_EQ(found.corrected[i], std::min(1.0, 4 * found.p[i]));
    }
  }
}

TEST(UniversalPValues, DoNotDependOnTheUnit) {
  const std::vector<Bar> radii{{1, 1, 2}, {1, 0.5, 3}, {1, 2, 2.1}};
  std::vector<Bar> diameters, squares;
  for (const Bar& bar : radii) {
    diameters.push_back({1, 2 * bar.birth, 2 * bar.death});
    squares.push_back({1, bar.birth * bar.birth, bar.death * bar.death});
  }
  const auto p = universal_p_values(radii, DistanceFiltration::cech).p;
  for (const auto* other : {&diameters, &squares}) {
    const auto same = universal_p_values(*other, DistanceFiltration::cech).p;
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(same[i], p[i], 1e-13);
  }
}

TEST(UniversalPValues, OfBarsWithoutARatio) {
  const std::vector<Bar> bars{{1, 1, 2}, {1, 3, kInfinity}, {1, 2, 2}, {1, 1, 4}};
  const BarPValues found = universal_p_values(bars, DistanceFiltration::rips);
  EXPECT_EQ(found.tested, 2U);
  EXPECT_TRUE(std::isnan(found.p[1]) && std::isnan(found.corrected[1]));
  EXPECT_EQ(found.p[2], 1);
  const std::vector<Bar> alone{bars[0], bars[3]};
  EXPECT_EQ(found.p[3], universal_p_values(alone, DistanceFiltration::rips).p[1]);
  EXPECT_TRUE(universal_p_values({}, DistanceFiltration::rips).p.empty());
  // A ratio of 10^310 is no double; its logarithm is.
  const std::vector<Bar> vast{{1, 1e-300, 1e10}, {1, 1, 2}};
  const double outer[] = {std::log(310 * std::log(10.0)), std::log(std::log(2.0))};
  const double p = std::exp(-std::exp(outer[0] - (outer[0] + outer[1]) / 2 - std::numbers::egamma));
  EXPECT_NEAR(universal_p_values(vast, DistanceFiltration::rips).p[0], p, 1e-12);
  expect_error(ErrorKind::bad_data, "born at 0", [] {
    universal_p_values(std::vector<Bar>{{1, 0, 2}}, DistanceFiltration::rips);
  });
  expect_error(ErrorKind::bad_data, "birth <= death", [] {
    universal_p_values(std::vector<Bar>{{1, 3, 2}}, DistanceFiltration::rips);
  });
  expect_error(ErrorKind::bad_data, "birth <= death", [] {
    universal_p_values(std::vector<Bar>{{1, std::nan(""), 2}}, DistanceFiltration::rips);
  });
}

Points random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<> number(0, 1);
  Points points(count, dimension);
  for (Index i = 0; i < count; ++i)
    for (Index k = 0; k < dimension; ++k) points(i, k) = number(random);
  return points;
}

TEST(UniversalPValues, AreUniformForNoise) {
  std::mt19937 random(5);
  for (const Index dimension : {2, 3}) {
    std::vector<double> all;
    for (int round = 0; round < 4; ++round) {
      const Barcode barcode =
          persistence(Rips(random_points(random, 400, dimension)), {.max_dim = 1});
      const auto bars = barcode.bars(1);
      const BarPValues found = universal_p_values(bars, DistanceFiltration::rips);
      EXPECT_GT(std::ranges::min(found.corrected), 0.01);
      all.insert(all.end(), found.p.begin(), found.p.end());
    }
    std::ranges::sort(all);
    double largest = 0;  // Kolmogorov and Smirnov; few hundred bars, not independent
    for (std::size_t i = 0; i < all.size(); ++i)
      largest = std::max(
          largest, std::abs(all[i] - static_cast<double>(i) / static_cast<double>(all.size())));
    EXPECT_LT(largest, 0.08) << all.size() << " bars";
  }
}

TEST(UniversalPValues, FindTheLoopOfANoisyCircle) {
  std::mt19937 random(6);
  std::normal_distribution<> noise(0, 0.1);
  Points points(200, 2);
  for (Index i = 0; i < 200; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 200;
    points(i, 0) = std::cos(angle) + noise(random);
    points(i, 1) = std::sin(angle) + noise(random);
  }
  const Barcode barcode = persistence(Rips(points), {.max_dim = 1});
  const auto bars = barcode.bars(1);
  const auto corrected = universal_p_values(bars, DistanceFiltration::rips).corrected;
  const auto longest = std::ranges::max_element(bars, {}, &Bar::persistence) - bars.begin();
  for (std::size_t i = 0; i < corrected.size(); ++i)
    EXPECT_EQ(corrected[i] < 0.05, static_cast<std::ptrdiff_t>(i) == longest) << corrected[i];
}

// ---- a confidence radius

double distance(const Points& points, Index i, Index j) {
  double square = 0;
  for (Index k = 0; k < points.cols(); ++k)
    square += (points(i, k) - points(j, k)) * (points(i, k) - points(j, k));
  return std::sqrt(square);
}

/// The Hausdorff distances of all subsets of a size, ascending.
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
        // What the quantile is within the error of 20 000 draws.
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
  // Of n / ln n points each, which are 80.
  EXPECT_EQ(confidence_radius(points, {.size = 80, .seed = 1}), found);
  // Copies change nothing that is seen.
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
  RunContext context;
  std::stop_source source;
  context.stop = source.get_token();
  source.request_stop();
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
  expect_error(ErrorKind::usage, "200 numbers", [&] { multiplier_bootstrap(functions, 7); });
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

// Powers of distances that are large or small overflow, or vanish.
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
  // The least p-value that so many shuffles can give, for groups far apart.
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += 100 * static_cast<double>(groups[i]);
  EXPECT_EQ(permutation_test(matrix_of(places), groups, {.shuffles = 99}).p, 0.01);
}

TEST(PermutationTests, Errors) {
  const DistanceMatrix distances = matrix_of({0, 1, 2, 3});
  const auto of = [&](std::vector<std::int64_t> groups, PermutationOptions options = {}) {
    return [&, groups, options] { permutation_test(distances, groups, options); };
  };
  expect_error(ErrorKind::usage, "3 groups for 4 diagrams", of({0, 0, 1}));
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
