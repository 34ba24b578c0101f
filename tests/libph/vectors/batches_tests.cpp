// SPDX-License-Identifier: MIT
// Centres and other values that are fitted to many diagrams, and kernels of two diagrams.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "ph/error.hpp"
#include "ph/vectorise.hpp"
#include "tests/libph/vectors/bars_by_definition.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

using test::Bars;
using test::expect_error;
using test::random_bars;
using Spans = std::vector<std::span<const Bar>>;
using Place = std::array<double, 2>;

// ---- ATOL

TEST(Atol, CentresAreTheMeansOfTheirBars) {
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    const int steps = round % 2 == 0 ? 0 : 8;
    std::vector<Bars> diagrams;
    for (int i = 0; i < 5; ++i) diagrams.push_back(random_bars(random, 20 + random() % 60, steps));
    const Spans spans(diagrams.begin(), diagrams.end());
    const std::size_t count = 1 + random() % 9;
    const Atol fitted = fit_atol(spans, {.centres = count, .seed = random()});
    ASSERT_EQ(fitted.centres.size(), count);
    ASSERT_TRUE(std::ranges::is_sorted(fitted.centres));
    std::vector<Place> sums(count);
    std::vector<double> counts(count);
    double distances = 0;
    for (const Bars& bars : diagrams)
      for (const Bar& bar : bars) {
        if (bar.birth == bar.death) continue;
        const auto distance = [&](const Place& c) {
          return std::hypot(c[0] - bar.birth, c[1] - bar.death);
        };
        const auto nearest = static_cast<std::size_t>(
            std::ranges::min_element(fitted.centres, {}, distance) - fitted.centres.begin());
        sums[nearest][0] += bar.birth;
        sums[nearest][1] += bar.death;
        ++counts[nearest];
        distances += distance(fitted.centres[nearest]);
      }
    double bars = 0;
    for (std::size_t k = 0; k < count; ++k) {
      bars += counts[k];
      if (steps > 0) continue;  // with ties, a bar may be equally far from two centres
      ASSERT_NEAR(fitted.centres[k][0], sums[k][0] / counts[k], 1e-12) << round;
      ASSERT_NEAR(fitted.centres[k][1], sums[k][1] / counts[k], 1e-12) << round;
    }
    for (std::size_t k = 0; k < count; ++k) {
      double least = kInfinity;
      for (std::size_t j = 0; j < count; ++j)
        if (j != k)
          least = std::min(least, std::hypot(fitted.centres[j][0] - fitted.centres[k][0],
                                             fitted.centres[j][1] - fitted.centres[k][1]) /
                                      2);
      ASSERT_NEAR(fitted.widths[k], count == 1 ? distances / bars : least, 1e-12) << round;
    }
  }
}

TEST(Atol, FindsGroupsThatAreFarApart) {
  std::mt19937 random(2);
  std::uniform_real_distribution<> noise(-0.01, 0.01);
  const Place middles[] = {{0, 1}, {0, 5}, {3, 4}, {6, 9}};
  Bars bars;
  for (int i = 0; i < 200; ++i) {
    const Place& middle = middles[i % 4];
    bars.push_back({0, middle[0] + noise(random), middle[1] + noise(random)});
  }
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Atol fitted = fit_atol(Spans{bars}, {.centres = 4, .seed = seed});
    for (std::size_t k = 0; k < 4; ++k)
      for (const std::size_t axis : {0U, 1U})
        EXPECT_NEAR(fitted.centres[k][axis], middles[k][axis], 0.01) << seed;
  }
}

TEST(Atol, DependsOnNothingButTheBars) {
  std::mt19937 random(3);
  Bars bars = random_bars(random, 20'000, 0);
  const AtolOptions options{.centres = 7, .seed = 5};
  test::ThreadsContext context(1);
  const Atol expected = fit_atol(Spans{bars}, options, context);
  EXPECT_NE(fit_atol(Spans{bars}, {.centres = 7, .seed = 6}, context), expected);
  context.threads = 4;
  EXPECT_EQ(fit_atol(Spans{bars}, options, context), expected);
  std::ranges::shuffle(bars, random);
  const std::span<const Bar> all(bars);
  EXPECT_EQ(fit_atol(Spans{all.first(5000), all.subspan(5000, 1), {}, all.subspan(5001)}, options),
            expected);
  for (const int exponent : {200, -1000}) {  // the result does not depend on the unit
    Bars scaled = bars;
    for (Bar& bar : scaled) {
      bar.birth = std::ldexp(bar.birth, exponent);
      bar.death = std::ldexp(bar.death, exponent);
    }
    const Atol other = fit_atol(Spans{scaled}, options);
    for (std::size_t k = 0; k < 7; ++k) {
      ASSERT_NEAR(other.centres[k][0], std::ldexp(expected.centres[k][0], exponent),
                  std::ldexp(1e-12, exponent));
      ASSERT_NEAR(other.widths[k], std::ldexp(expected.widths[k], exponent),
                  std::ldexp(1e-12, exponent));
    }
  }
}

TEST(Atol, VectorsAreSumsOverBars) {
  std::mt19937 random(4);
  Atol fitted{{{0, 1}, {0.5, 0.75}}, {0.5, 2}};
  const Bars bars = random_bars(random, 30, 4);
  for (const auto contrast : {Atol::Contrast::laplace, Atol::Contrast::gauss}) {
    fitted.contrast = contrast;
    std::vector<double> found(2);
    atol_vector(bars, fitted, found);
    for (std::size_t k = 0; k < 2; ++k) {
      double expected = 0;
      for (const Bar& bar : bars) {
        if (bar.birth == bar.death) continue;
        const double x = bar.birth - fitted.centres[k][0], y = bar.death - fitted.centres[k][1],
                     width = fitted.widths[k];
        expected += contrast == Atol::Contrast::gauss ? std::exp(-(x * x + y * y) / (width * width))
                                                      : std::exp(-std::sqrt(x * x + y * y) / width);
      }
      EXPECT_NEAR(found[k], expected, 1e-13 * expected);
    }
  }
  std::vector<double> none(2, 5);
  atol_vector({}, fitted, none);
  EXPECT_EQ(none, std::vector<double>(2));
}

TEST(Atol, OfFewBars) {
  const Bars copies(5, {0, 1, 3}), two = {{0, 0, 1}, {0, 1, 3}, {0, 0, 1}, {0, 9, 9}};
  EXPECT_EQ(fit_atol(Spans{copies}, {.centres = 1}), (Atol{{{1, 3}}, {1}}));
  EXPECT_EQ(fit_atol(Spans{two}, {.centres = 2}),
            (Atol{{{0, 1}, {1, 3}}, {std::sqrt(5) / 2, std::sqrt(5) / 2}}));
  expect_error(ErrorKind::bad_data, "distinct bars: found 2, expected at least 3",
               [&] { fit_atol(Spans{two}, {.centres = 3}); });
  expect_error(ErrorKind::bad_data, "distinct bars: found 0",
               [&] { fit_atol({}, {.centres = 1}); });
  // The squared distance between the first two bars is 0 as a double.
  const Bars close = {{0, 0, 1}, {0, 5e-324, 1}, {0, 0, 1 + 0x1p-52}};
  EXPECT_EQ(fit_atol(Spans{close}, {.centres = 2, .most_rounds = 0}).centres.size(), 2U);
}

// The mean of equal numbers is exactly this number, however the sums are rounded.
TEST(Atol, OfEqualBars) {
  const Bars three(3, {1, 0.1, 0.3});
  const std::span<const Bar> diagrams[]{three};
  const Atol fitted = fit_atol(diagrams, {.centres = 1});
  EXPECT_EQ(fitted.centres, (std::vector<std::array<double, 2>>{{0.1, 0.3}}));
  EXPECT_EQ(fitted.widths, std::vector<double>{1});
  double vector = 0;
  atol_vector(three, fitted, {&vector, 1});
  EXPECT_EQ(vector, 3);
  // Half the distance between two of these bars underflows.
  const Bars small{{1, 0, 1e-20}, {1, 1e-310, 1e-20}, {1, -1e-20, 1e-20}};
  const std::span<const Bar> of_small[]{small};
  std::vector<double> out(3);
  EXPECT_NO_THROW(atol_vector(small, fit_atol(of_small, {.centres = 3}), out));
}

TEST(Atol, RefusesWhatMakesNoSenseAndStops) {
  std::mt19937 random(5);
  const Bars bars = random_bars(random, 5000, 0);
  std::vector<double> out(2);
  expect_error(ErrorKind::usage, "found 0 centres", [&] { fit_atol(Spans{bars}, {.centres = 0}); });
  expect_error(ErrorKind::usage, "-1 rounds", [&] { fit_atol(Spans{bars}, {.most_rounds = -1}); });
  expect_error(ErrorKind::bad_data, "expected finite bars", [&] {
    fit_atol(Spans{Bars{{0, 0, kInfinity}}});
  });
  for (const Atol& wrong : {Atol{}, Atol{{{0, 1}, {0, 2}}, {1}}})
    expect_error(ErrorKind::usage, "one width for each", [&] { atol_vector(bars, wrong, out); });
  for (const Atol& wrong :
       {Atol{{{0, 1}, {0, 2}}, {1, 0}}, Atol{{{0, 1}, {0, std::nan("")}}, {1, 1}}})
    expect_error(ErrorKind::usage, "finite widths above 0", [&] { atol_vector(bars, wrong, out); });
  expect_error(ErrorKind::usage, "expected 1", [&] { atol_vector(bars, {{{0, 1}}, {1}}, out); });
  test::StoppedContext context;
  expect_error(ErrorKind::cancelled, "stopped", [&] { fit_atol(Spans{bars}, {}, context); });
  test::LimitedContext small(1000);
  expect_error(ErrorKind::resource, "memory limit", [&] { fit_atol(Spans{bars}, {}, small); });
}

// ---- kernels

double scale_space(const Bars& a, const Bars& b, double sigma) {
  long double sum = 0;
  for (const Bar& p : a)
    for (const Bar& q : b) {
      const auto square = [](long double x, long double y) { return x * x + y * y; };
      sum += std::exp(-square(p.birth - q.birth, p.death - q.death) / (8 * sigma)) -
             std::exp(-square(p.birth - q.death, p.death - q.birth) / (8 * sigma));
    }
  return static_cast<double>(sum / (8 * std::numbers::pi_v<long double> * sigma));
}

double weighted_gaussian(const Bars& a, const Bars& b, const WeightedGaussian& options) {
  double sum = 0;
  const auto weight = [&](const Bar& bar) {
    if (bar.death == bar.birth) return 0.0;
    return std::atan(options.slope * std::pow(bar.death - bar.birth, options.power));
  };
  for (const Bar& p : a)
    for (const Bar& q : b)
      sum += weight(p) * weight(q) *
             std::exp(-(std::pow(p.birth - q.birth, 2) + std::pow(p.death - q.death, 2)) /
                      (2 * options.sigma * options.sigma));
  return sum;
}

TEST(Kernels, AreTheirDefinitions) {
  std::mt19937 random(6);
  for (int round = 0; round < 100; ++round) {
    const int steps = round % 2 == 0 ? 0 : 10;
    const Bars a = random_bars(random, random() % 40, steps);
    const Bars b = round % 5 == 0 ? a : random_bars(random, random() % 40, steps);
    for (const double sigma : {0.001, 0.1, 30.0}) {
      const double expected = scale_space(a, b, sigma);
      ASSERT_NEAR(scale_space_kernel(a, b, sigma), expected, 1e-13 * (1 + expected)) << round;
      const WeightedGaussian options{sigma, round % 3 == 0 ? 1.0 : 0.2, round % 4 * 0.5};
      const double weighted = weighted_gaussian(a, b, options);
      ASSERT_NEAR(weighted_gaussian_kernel(a, b, options), weighted, 1e-12 * (1 + weighted))
          << round;
    }
  }
  EXPECT_EQ(scale_space_kernel({}, Bars{{0, 0, 1}}, 1), 0);
}

// For short bars, the two terms are nearly equal.
TEST(Kernels, OfShortBars) {
  const Bars a = {{0, 0, 1e-9}}, b = {{0, 1, 1 + 0x1p-30}};
  const double expected = std::exp(-0.25) * 2 * 1e-9 * 0x1p-30 / 8 / (8 * std::numbers::pi);
  EXPECT_NEAR(scale_space_kernel(a, b, 1), expected, 1e-8 * expected);
}

TEST(Kernels, GramMatricesAreThoseOfAllPairs) {
  std::mt19937 random(7);
  std::vector<Bars> diagrams;
  for (std::size_t i = 0; i < 6; ++i) diagrams.push_back(random_bars(random, 7 * i, 0));
  const Spans spans(diagrams.begin(), diagrams.end());
  const DiagramKernel kernel = [](std::span<const Bar> a, std::span<const Bar> b,
                                  const RunContext& context) {
    EXPECT_EQ(context.threads, 1);
    return scale_space_kernel(a, b, 0.1, context);
  };
  for (const int threads : {1, 3}) {
    test::ThreadsContext context(threads);
    const std::vector<double> gram = gram_matrix(spans, kernel, context);
    ASSERT_EQ(gram.size(), 36U);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        ASSERT_EQ(gram[6 * i + j], gram[6 * j + i]);
        ASSERT_NEAR(gram[6 * i + j], scale_space(diagrams[i], diagrams[j], 0.1), 1e-13);
      }
  }
  EXPECT_TRUE(gram_matrix({}, kernel).empty());
}

TEST(Kernels, RefuseWhatMakesNoSenseAndStop) {
  const Bars one = {{0, 1, 5}}, endless = {{0, 1, kInfinity}};
  for (const double wrong : {0.0, -1.0, std::nan(""), kInfinity}) {
    expect_error(ErrorKind::usage, "scale_space_kernel: sigma: found",
                 [&] { scale_space_kernel(one, one, wrong); });
    expect_error(ErrorKind::usage, "sigma: found",
                 [&] { weighted_gaussian_kernel(one, one, {.sigma = wrong}); });
    expect_error(ErrorKind::usage, "slope: found",
                 [&] { weighted_gaussian_kernel(one, one, {.slope = wrong}); });
  }
  expect_error(ErrorKind::usage, "power: found",
               [&] { weighted_gaussian_kernel(one, one, {.power = -1}); });
  expect_error(ErrorKind::bad_data, "expected finite bars",
               [&] { scale_space_kernel(one, endless, 1); });
  expect_error(ErrorKind::bad_data, "expected finite bars",
               [&] { weighted_gaussian_kernel(endless, one); });
  test::StoppedContext context;
  expect_error(ErrorKind::cancelled, "stopped", [&] { scale_space_kernel(one, one, 1, context); });
}

}  // namespace
}  // namespace ph
