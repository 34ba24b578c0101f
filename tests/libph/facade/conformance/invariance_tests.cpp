// SPDX-License-Identifier: MIT
// Tests changes of the input that must leave the barcode as it is, or change it in a known way.
#include <chrono>

#include "ph/eigen.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/points.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;
constexpr Options kUpToTwo{.max_dim = 2, .field = 3};

std::vector<Bar> rips_bars(const Points& points, const RipsOptions& options = {}) {
  return bars_of(persistence(Rips(points, options), kUpToTwo));
}

Points permuted(Generator& random, const Points& points) {
  std::vector<Index> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  Points result(points.rows(), points.cols());
  for (Index i = 0; i < points.rows(); ++i)
    copy_point(points, order[static_cast<std::size_t>(i)], result, i);
  return result;
}

template <class Act>
void for_each_cloud(Act&& act) {
  for_each_seed(150, [&](Generator& random) {
    const Points points = random.points(random.integer(0, 14), random.integer(1, 3), random.coin());
    act(random, points);
  });
}

TEST(Invariance, TheOrderOfThePointsDoesNotMatter) {
  for_each_cloud([](Generator& random, const Points& points) {
    EXPECT_EQ(rips_bars(permuted(random, points)), rips_bars(points));
  });
}

TEST(Invariance, PowersOfTwoScaleExactly) {
  for_each_cloud([](Generator& random, const Points& points) {
    const double factor = std::ldexp(1.0, random.integer(-100, 100));
    std::vector<Bar> expected = rips_bars(points);
    for (Bar& bar : expected) bar = {bar.dim, bar.birth * factor, bar.death * factor};
    EXPECT_EQ(rips_bars(scaled(points, factor)), expected);
  });
}

// If a threshold is set, a bar that would die after the threshold never dies, and a bar that would
// be born after the threshold does not exist.
TEST(Invariance, AThresholdCutsTheBarcode) {
  for_each_cloud([](Generator& random, const Points& points) {
    const std::vector<Bar> full = rips_bars(points);
    double t = random.real() * 2;
    if (!full.empty() && random.coin())
      t = full[static_cast<std::size_t>(random.integer(0, static_cast<int>(full.size()) - 1))]
              .death;
    std::vector<Bar> expected;
    for (const Bar& bar : full)
      if (bar.birth <= t)
        expected.push_back({bar.dim, bar.birth, bar.death <= t ? bar.death : kInf});
    std::sort(expected.begin(), expected.end(), [](const Bar& a, const Bar& b) {
      return std::tie(a.dim, a.birth, a.death) < std::tie(b.dim, b.birth, b.death);
    });
    EXPECT_EQ(rips_bars(points, {.threshold = t}), expected) << t;
  });
}

TEST(Invariance, DuplicatesOnlyAddZeroLengthBars) {
  for_each_cloud([](Generator& random, const Points& points) {
    if (points.rows() == 0) return;
    Points more(points.rows() + 5, points.cols());
    std::ranges::copy(points.coordinates(), more.data());
    for (Index i = points.rows(); i < more.rows(); ++i)
      copy_point(points, random.integer(0, static_cast<int>(points.rows()) - 1), more, i);
    EXPECT_EQ(rips_bars(permuted(random, more)), rips_bars(points));
  });
}

TEST(Invariance, AnImageMayBeTransposed) {
  for_each_seed(150, [&](Generator& random) {
    const Image image = random.image({3, 5}, random.coin());
    std::vector<double> values(15);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 5; ++j) values[j * 3 + i] = image.values[i * 5 + j];
    const Image turned{{5, 3}, values};
    CubicalOptions options = random.cubical_options(2), swapped = options;
    swapped.periodic = {options.periodic[1], options.periodic[0]};
    EXPECT_EQ(bars_of(persistence(Cubical(image, options), kUpToTwo)),
              bars_of(persistence(Cubical(turned, swapped), kUpToTwo)));
  });
}

TEST(Invariance, TheOrderOfTheSimplicesDoesNotMatter) {
  for_each_seed(150, [&](Generator& random) {
    const SimplexList list = random.simplices(7, 3, 8, random.coin());
    SimplexList backwards;
    for (std::size_t i = list.size(); i-- > 0;) backwards.add(list.simplex(i), list.values[i]);
    EXPECT_EQ(bars_of(persistence(ExplicitComplex::from_simplices(list), {.field = 5})),
              bars_of(persistence(ExplicitComplex::from_simplices(backwards), {.field = 5})));
  });
}

// A Rips complex has the same bars as the list of its simplices.
TEST(Invariance, ARipsComplexIsTheListOfItsSimplices) {
  for_each_cloud([](Generator&, const Points& points) {
    const Rips rips(points);
    SimplexList list;
    with_all_edges(rips, 2, [&](const auto& f) {
      std::vector<Index> numbers;
      for (int dim = 0; dim <= std::min(3, f.top_dim()); ++dim) {
        f.for_each_cell(dim, [&](const auto& c) {
          numbers.clear();
          f.append_input_cell(dim, c, numbers);
          list.add(numbers, f.value(c));
        });
      }
    });
    EXPECT_EQ(bars_of(persistence(ExplicitComplex::from_simplices(list), kUpToTwo)),
              bars_of(persistence(rips, kUpToTwo)));
  });
}

// ---- degenerate clouds

TEST(DegenerateClouds, AllPointsEqual) {
  EXPECT_EQ(rips_bars(to_points(PointMatrix::Constant(60, 3, 1.5))),
            (std::vector<Bar>{{0, 0, kInf}}));
}

TEST(DegenerateClouds, CollinearPointsHaveNoLoops) {
  Points line(60, 3);
  for (Index i = 0; i < 60; ++i) {
    const auto t = static_cast<double>(i * i);
    line.set_row(i, {t, 2 * t, -3 * t});
  }
  const std::vector<Bar> bars = rips_bars(line);
  EXPECT_EQ(bars.size(), 60U);
  for (const Bar& bar : bars) EXPECT_EQ(bar.dim, 0);
}

TEST(DegenerateClouds, GridsOfSquares) {
  Points grid(64, 2);
  for (Index i = 0; i < 64; ++i)
    grid.set_row(i, {static_cast<double>(i / 8), static_cast<double>(i % 8)});
  std::vector<Bar> expected(63, Bar{0, 0, 1});
  expected.push_back({0, 0, kInf});
  expected.insert(expected.end(), 49, Bar{1, 1, std::sqrt(2.0)});
  EXPECT_EQ(bars_of(persistence(Rips(grid))), expected);
}

TEST(DegenerateClouds, SpreadsAtTheEndsOfTheRange) {
  const Points square{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  for (const double scale : {1e-300, 1e300, 1e-310}) {
    const Points points = scaled(square, scale);
    const std::vector<Bar> bars = rips_bars(points);
    ASSERT_EQ(bars.size(), 5U) << scale;
    EXPECT_EQ(bars[0], (Bar{0, 0, scale}));
    EXPECT_EQ(bars[4].birth, scale);
    EXPECT_NEAR(bars[4].death / scale, std::sqrt(2.0), 1e-12);
    EXPECT_EQ(rips_bars(points, {.threshold = 2 * scale}), bars) << "near pairs find them too";
  }
  // A tiny square and two points far away.
  const Points both{{0, 0}, {0, 1e-300}, {1e-300, 1e-300}, {1e-300, 0}, {1e300, 0}, {1e300, 1e299}};
  const std::vector<Bar> bars = rips_bars(both);
  ASSERT_EQ(bars.size(), 7U);
  EXPECT_EQ(bars[4], (Bar{0, 0, 1e300}));
  EXPECT_EQ(bars[6].dim, 1);
  EXPECT_EQ(bars[6].birth, 1e-300);
}

// A million copies of one point have 5 * 10^11 edges. Under a memory limit, the call must return or
// fail within seconds.
TEST(DegenerateClouds, AMillionDuplicatesStayWithinTheBudget) {
  const Points same = to_points(PointMatrix::Constant(1000000, 3, 2.0));
  RunContext context;
  context.memory.set_limit(64 << 20);
  const auto start = std::chrono::steady_clock::now();
  fails_with(ErrorKind::resource, [&] {
    EXPECT_EQ(bars_of(persistence(Rips(same, {.threshold = 1}, context), {.max_dim = 0}, context)),
              (std::vector<Bar>{{0, 0, kInf}}));
  });
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_LE(context.memory.peak(), context.memory.limit());
}

// Pairs of equal points that are far from all others.
TEST(DegenerateClouds, ManyPairsOfDuplicatesTakeNearLinearTime) {
  Points pairs(200000, 2);
  for (Index i = 0; i < pairs.rows(); ++i) pairs.set_row(i, {static_cast<double>(i / 2), 0.0});
  for (const double threshold : {0.0, 0.5}) {
    const Barcode barcode = persistence(Rips(pairs, {.threshold = threshold}), {.max_dim = 1});
    EXPECT_EQ(barcode.size(), 100000U);
  }
}

}  // namespace
}  // namespace ph::test
