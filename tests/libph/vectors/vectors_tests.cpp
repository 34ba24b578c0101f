// SPDX-License-Identifier: MIT
// Statistics, entropy, lengths, persistence images.
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

std::vector<double> statistics_of(const Bars& bars) {
  std::vector<double> out(kStatistics, -1);
  statistics(bars, out);
  return out;
}

/// The nine statistics, each computed by its definition.
std::vector<double> nine_numbers(std::vector<long double> x) {
  const auto n = static_cast<long double>(x.size());
  long double mean = 0, square = 0;
  for (const long double v : x) mean += v / n;
  for (const long double v : x) square += (v - mean) * (v - mean) / n;
  std::ranges::sort(x);
  const auto percentile = [&](int percent) {
    // Interpolates linearly between the points (100 i / (n - 1), x_i).
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const long double from = 100 * static_cast<long double>(i) / (n - 1),
                        to = 100 * static_cast<long double>(i + 1) / (n - 1);
      if (percent <= to) return x[i] + (x[i + 1] - x[i]) * (percent - from) / (to - from);
    }
    return x.back();
  };
  std::vector<double> numbers;
  for (const long double v :
       {mean, std::sqrt(square), percentile(50), percentile(75) - percentile(25),
        x.back() - x.front(), percentile(10), percentile(25), percentile(75), percentile(90)})
    numbers.push_back(static_cast<double>(v));
  return numbers;
}

TEST(Statistics, AreTheirDefinitions) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const int steps = round % 3 == 0 ? 0 : round % 3 == 1 ? 3 : 20;
    const Bars given = random_bars(random, random() % 30, steps);
    Bars bars;
    for (const Bar& bar : given)
      if (bar.birth < bar.death) bars.push_back(bar);
    std::vector<double> expected;
    for (int k = 0; k < 4 && !bars.empty(); ++k) {
      std::vector<long double> x;
      for (const Bar& bar : bars) {
        const long double b = bar.birth, d = bar.death;
        x.push_back(k == 0 ? b : k == 1 ? d : k == 2 ? (b + d) / 2 : d - b);
      }
      const std::vector<double> numbers = nine_numbers(x);
      expected.insert(expected.end(), numbers.begin(), numbers.end());
    }
    expected.resize(36);
    expected.push_back(static_cast<double>(bars.size()));
    expected.push_back(test::entropy_of(bars, [](const Bar&) { return true; }));
    const std::vector<double> found = statistics_of(given);
    for (std::size_t i = 0; i < kStatistics; ++i)
      ASSERT_NEAR(found[i], expected[i], 1e-14 * (1 + std::abs(expected[i])))
          << round << ": " << statistics_names()[i];
  }
}

TEST(Statistics, OfKnownBars) {
  const std::vector<double> four =
      statistics_of({{0, 0, 4}, {0, 1, 2}, {0, 3, 5}, {0, 9, 9}, {0, 0, 1}});
  // The births are 0, 0, 1 and 3. The expected values were computed by NumPy.
  EXPECT_EQ(four[0], 1);
  EXPECT_DOUBLE_EQ(four[1], std::sqrt(1.5));
  EXPECT_EQ(four[2], 0.5);
  EXPECT_EQ(four[3], 1.5);
  EXPECT_EQ(four[4], 3);
  EXPECT_EQ(four[5], 0);
  EXPECT_EQ(four[6], 0);
  EXPECT_EQ(four[7], 1.5);
  EXPECT_DOUBLE_EQ(four[8], 2.4);
  EXPECT_EQ(four[36], 4);
  const std::vector<double> one = statistics_of({{0, 1, 3}});
  std::vector<double> expected(kStatistics);
  for (std::size_t k = 0; k < 4; ++k)
    for (const std::size_t i : {0U, 2U, 5U, 6U, 7U, 8U})
      expected[9 * k + i] = std::vector<double>{1, 3, 2, 2}[k];
  expected[36] = 1;
  EXPECT_EQ(one, expected);
  EXPECT_EQ(statistics_of({}), std::vector<double>(kStatistics));
  EXPECT_EQ(statistics_of({{0, 7, 7}}), std::vector<double>(kStatistics));
  const std::vector<double> far_apart = statistics_of({{0, -1e16, 0}, {0, 1, 2}, {0, 1e16, 2e16}});
  EXPECT_EQ(far_apart[0], 1.0 / 3);  // small numbers are not lost by rounding
  const auto& names = statistics_names();
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), kStatistics);
  EXPECT_EQ(names[1], "birth_sd");
  EXPECT_EQ(names[16], "death_p75");
  EXPECT_EQ(names[26], "midpoint_p90");
  EXPECT_EQ(names[27], "length_mean");
  EXPECT_EQ(names[37], "entropy");
}

TEST(Statistics, UnitsAreTheirs) {
  std::mt19937 random(2);
  const Bars bars = random_bars(random, 50, 0);
  const std::vector<double> found = statistics_of(bars);
  for (const int exponent : {300, -900}) {
    Bars scaled = bars;
    for (Bar& bar : scaled) {
      bar.birth = std::ldexp(bar.birth, exponent);
      bar.death = std::ldexp(bar.death, exponent);
    }
    const std::vector<double> other = statistics_of(scaled);
    for (std::size_t i = 0; i < 36; ++i) ASSERT_EQ(other[i], std::ldexp(found[i], exponent));
    EXPECT_EQ(other[37], found[37]);
  }
}

TEST(Entropies, AreTheirDefinition) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const Bars bars = random_bars(random, random() % 40, round % 2 == 0 ? 0 : 6);
    const double expected = test::entropy_of(bars, [](const Bar&) { return true; });
    const auto count = static_cast<double>(
        std::ranges::count_if(bars, [](const Bar& bar) { return bar.birth < bar.death; }));
    ASSERT_NEAR(entropy(bars), expected, 1e-13) << round;
    if (count > 1) {
      ASSERT_NEAR(entropy(bars, true), expected / std::log(count), 1e-13) << round;
    }
  }
  EXPECT_DOUBLE_EQ(entropy(Bars(8, {0, 1, 2})), std::log(8));
  EXPECT_DOUBLE_EQ(entropy(Bars(8, {0, 1, 2}), true), 1);
  EXPECT_EQ(entropy({}), 0);
  EXPECT_EQ(entropy(Bars{{0, 1, 2}}), 0);
  EXPECT_EQ(entropy(Bars{{0, 1, 2}, {0, 1, 1}}, true), 0);
  // As a double, the share of the short bar in the total length is 0.
  EXPECT_EQ(entropy(Bars{{0, 0, 1e100}, {0, 0, 1e-300}}), 0);
}

TEST(Lengths, AreTheLargest) {
  const Bars bars = {{0, 0, 1}, {0, 5, 9}, {0, 2, 2}, {0, 1, 3}};
  std::vector<double> two(2), five(5, -1), none;
  longest_lengths(bars, two);
  longest_lengths(bars, five);
  longest_lengths(bars, none);
  EXPECT_EQ(two, (std::vector<double>{4, 2}));
  EXPECT_EQ(five, (std::vector<double>{4, 2, 1, 0, 0}));
}

/// The sum of the densities of all bars at a point.
double density(const Bars& bars, double sigma, double power, double x, double y) {
  double sum = 0;
  for (const Bar& bar : bars) {
    const double length = bar.death - bar.birth, u = (x - bar.birth) / sigma,
                 v = (y - length) / sigma;
    if (length > 0)
      sum += std::pow(length, power) * std::exp(-(u * u + v * v) / 2) /
             (2 * std::numbers::pi * sigma * sigma);
  }
  return sum;
}

TEST(Images, AreIntegralsOverPixels) {
  std::mt19937 random(4);
  for (int round = 0; round < 12; ++round) {
    const Bars bars = random_bars(random, random() % 6, round % 3 == 0 ? 2 : 0);
    const ImageFrame frame{{-0.5, 1.5, 1 + random() % 4}, {-0.25, 1, 1 + random() % 4}};
    const double sigma = std::vector<double>{0.1, 0.3, 2}[static_cast<std::size_t>(round % 3)];
    const double power = std::vector<double>{1, 0, 2.5}[random() % 3];
    std::vector<double> out(frame.births.pixels * frame.lengths.pixels, -1);
    persistence_image(bars, frame, sigma, power, out);
    const double width = 2.0 / static_cast<double>(frame.births.pixels),
                 height = 1.25 / static_cast<double>(frame.lengths.pixels);
    for (std::size_t row = 0; row < frame.lengths.pixels; ++row)
      for (std::size_t column = 0; column < frame.births.pixels; ++column) {
        const double x = -0.5 + width * static_cast<double>(column),
                     y = -0.25 + height * static_cast<double>(row);
        const double expected = test::integral(
            x, x + width,
            [&](double u) {
              return test::integral(
                  y, y + height, [&](double v) { return density(bars, sigma, power, u, v); }, 60);
            },
            60);
        ASSERT_NEAR(out[row * frame.births.pixels + column], expected, 1e-7)
            << round << ": pixel " << row << ", " << column;
      }
  }
}

TEST(Images, HaveAllOfABarThatIsInside) {
  const ImageFrame frame{{0, 1, 100}, {0, 2, 50}};
  std::vector<double> out(5000);
  persistence_image(Bars{{0, 0.5, 1.5}}, frame, 0.05, 3, out);
  double sum = 0;
  for (const double x : out) sum += x;
  EXPECT_NEAR(sum, 1, 1e-14);
  // A distribution narrower than a pixel lies in a single pixel, here the pixel with birth 0.005
  // and length 1.9.
  persistence_image(Bars{{0, 0.005, 1.905}}, frame, 1e-9, 0, out);
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_EQ(out[i], i == 47 * 100 ? 1 : 0) << i;
  // A bar on the border of the frame has half of its mass inside. A bar beyond the border has no
  // mass inside.
  persistence_image(Bars{{0, 0, 1.02}}, frame, 1e-5, 0, out);
  EXPECT_NEAR(out[25 * 100], 0.5, 1e-15);
  persistence_image(Bars{{0, 1, 2.02}}, frame, 1e-5, 0, out);
  EXPECT_NEAR(out[25 * 100 + 99], 0.5, 1e-15);
  persistence_image(Bars{{0, 3, 4}, {0, -3, -2}, {0, 0.5, 9}}, frame, 0.01, 1, out);
  EXPECT_EQ(out, std::vector<double>(5000));
  persistence_image({}, frame, 0.01, 1, out);
  EXPECT_EQ(out, std::vector<double>(5000));
  // The Gaussian is so wide that the mass in each pixel is 0.
  persistence_image(Bars{{0, 0.5, 1.5}}, frame, 1e300, 1, out);
  for (const double x : out) ASSERT_NEAR(x, 0, 1e-300);
}

TEST(Images, WindowsLeaveOutWhatIsNotSeen) {
  std::mt19937 random(5);
  const Bars bars = random_bars(random, 50, 0);
  const PixelRange births{-1, 1, 64}, lengths{0, 2, 32};
  std::vector<double> out(64 * 32);
  persistence_image(bars, {births, lengths}, 0.03, 1, out);
  const auto share = [](double lo, double hi, double centre) {
    const double width = 0.03 * std::numbers::sqrt2;
    return (std::erf((hi - centre) / width) - std::erf((lo - centre) / width)) / 2;
  };
  for (std::size_t row = 0; row < 32; ++row)
    for (std::size_t column = 0; column < 64; ++column) {
      double expected = 0;
      for (const Bar& bar : bars)
        expected += bar.persistence() *
                    share(-1 + static_cast<double>(column) / 32,
                          -1 + static_cast<double>(column + 1) / 32, bar.birth) *
                    share(static_cast<double>(row) / 16, static_cast<double>(row + 1) / 16,
                          bar.persistence());
      ASSERT_NEAR(out[row * 64 + column], expected, 2e-15 * 50) << row << ", " << column;
    }
}

TEST(Images, RefuseWhatMakesNoSenseAndStop) {
  const Bars one = {{0, 1, 5}};
  std::vector<double> out(4);
  const ImageFrame frame{{0, 1, 2}, {0, 1, 2}};
  const auto of = [&](ImageFrame f, double sigma, double power) {
    return [&, f, sigma, power] { persistence_image(one, f, sigma, power, out); };
  };
  const double nan = std::nan("");
  for (const double sigma : {0.0, -1.0, nan, kInfinity})
    expect_error(ErrorKind::usage, "sigma: found", of(frame, sigma, 1));
  for (const double power : {-0.5, nan, kInfinity})
    expect_error(ErrorKind::usage, "power: found", of(frame, 1, power));
  expect_error(ErrorKind::usage, "births: found 0 pixels", of({{0, 1, 0}, {0, 1, 2}}, 1, 1));
  expect_error(ErrorKind::usage, "lengths: found a range", of({{0, 1, 2}, {1, 1, 2}}, 1, 1));
  expect_error(ErrorKind::usage, "births: found a range", of({{nan, 1, 2}, {0, 1, 2}}, 1, 1));
  expect_error(ErrorKind::usage, "expected 6", of({{0, 1, 2}, {0, 1, 3}}, 1, 1));
  expect_error(ErrorKind::bad_data, "expected a finite weight", of(frame, 1, 1000));
  expect_error(ErrorKind::bad_data, "expected finite bars", [&] {
    persistence_image(Bars{{0, 1, kInfinity}}, frame, 1, 1, out);
  });
  expect_error(ErrorKind::bad_data, "expected finite bars", [&] {
    entropy(Bars{{0, 1, kInfinity}});
  });
  expect_error(ErrorKind::bad_data, "expected finite bars", [&] {
    longest_lengths(Bars{{0, 1, kInfinity}}, out);
  });
  expect_error(ErrorKind::usage, "expected 38", [&] { statistics(one, out); });
  test::StoppedContext context;
  expect_error(ErrorKind::cancelled, "stopped",
               [&] { persistence_image(one, frame, 1, 1, out, context); });
}

}  // namespace
}  // namespace ph
