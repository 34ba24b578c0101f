// SPDX-License-Identifier: MIT
// Alpha complexes of periodic spaces: compares them with the definition and with engines that work
// for any complex, and checks properties that hold for any points.
#include <gtest/gtest.h>

#include <numeric>

#include "libph/src/alpha/periodic/quotient.hpp"
#include "ph/detail/facade/alpha_engines.hpp"
#include "tests/libph/alpha/alpha_support.hpp"
#include "tests/libph/alpha/expect_bars.hpp"
#include "tests/libph/alpha/periodic_oracle.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

struct PeriodicCloud {
  std::string name;
  Points points;
  std::vector<double> period, weights;

  AlphaOptions options() const {
    return {.weights = weights, .period = period, .unit = AlphaOptions::Unit::squared};
  }
  int closed() const {
    return static_cast<int>(std::ranges::count_if(period, [](double l) { return l > 0; }));
  }
};

/// A few points inside and outside a box with some periodic axes: anywhere; on a grid, with copies
/// and points on the border; in layers; on a grid whose coordinates are not exact as doubles.
PeriodicCloud any_periodic_cloud(Generator& random, Index dim, Index most, bool weighted) {
  PeriodicCloud cloud{"", Points(random.integer(1, static_cast<int>(most)), dim), {}, {}};
  const int kind = random.integer(0, 3);
  static constexpr const char* names[]{"anywhere", "grid", "layers", "decimals"};
  cloud.name = names[kind];
  for (Index k = 0; k < dim; ++k) {
    const double length = kind == 1   ? random.integer(1, 3)
                          : kind == 3 ? 0.1 * random.integer(3, 9)
                                      : 0.5 + random.real();
    cloud.period.push_back(random.integer(0, 3) == 0 ? 0 : length);
  }
  const auto one = static_cast<std::size_t>(random.integer(0, static_cast<int>(dim) - 1));
  if (cloud.period[one] == 0) cloud.period[one] = 1;
  for (Index i = 0; i < cloud.points.rows(); ++i)
    for (Index k = 0; k < dim; ++k) {
      double& x = cloud.points(i, k);
      x = 2 * random.real() - 0.5;
      if (kind == 1) x = random.integer(-2, 4);
      if (kind == 2 && k == dim - 1) x = random.integer(0, 1);
      if (kind == 3) x = 0.1 * random.integer(-9, 9);
      if (cloud.period[static_cast<std::size_t>(k)] == 0) x = kind == 1 ? std::fmod(x, 2) : x / 2;
    }
  for (Index i = 0; weighted && i < cloud.points.rows(); ++i)
    cloud.weights.push_back(random.coin() ? 0.125 * random.integer(-1, 1) : random.real() / 8);
  cloud.name += " of " + std::to_string(cloud.points.rows()) + " in R^" + std::to_string(dim);
  for (const double length : cloud.period) cloud.name += " " + std::to_string(length);
  return cloud;
}

/// Checks that the numbers of classes that never die are the Betti numbers of the periodic space.
void expect_betti_numbers(const Barcode& bars, int closed, std::size_t components = 1) {
  static constexpr std::size_t binomials[4][4]{
      {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  for (int dim = 0; dim <= 3; ++dim)
    EXPECT_EQ(std::ranges::count_if(bars.bars(dim), &Bar::is_infinite),
              components * binomials[closed][dim])
        << "H" << dim;
}

void check_definition(const PeriodicCloud& cloud) {
  const Alpha alpha(cloud.points, cloud.options());
  // For the oracle, every subset of the points on an empty sphere is a cell. Copies of a point are
  // on the same sphere, so cells of the oracle may have more than three dimensions. Clouds with
  // such cells are skipped.
  if (static_cast<int>(alpha.copies().size()) + alpha.top_dim() > 3) return;
  const PeriodicOracle oracle(cloud.points, cloud.period, cloud.weights);
  double size = 1;
  for (const double length : cloud.period) size = std::max(size, length);
  const double absolute = 1e-13 * 16 * size * size;
  for (const int p : {2, 3}) {
    const Barcode bars = persistence(alpha, {.max_dim = 3, .field = p});
    ASSERT_NO_FATAL_FAILURE(expect_bars(bars, oracle.bars(p), absolute));
    expect_betti_numbers(bars, cloud.closed());
  }
  // Each cell must be in the oracle's complex, and no cell may be missing. On a grid of decimals,
  // rounding may move points off a sphere, so the cells may differ. Such clouds are skipped.
  if (cloud.name[0] == 'd') return;
  std::vector<std::pair<std::vector<Index>, double>> left;
  for (const auto& [simplex, value] : oracle.values()) {
    std::vector<Index> numbers;
    for (const Image& image : simplex) numbers.push_back(static_cast<Index>(image.point));
    left.emplace_back(std::move(numbers), static_cast<double>(value));
  }
  double most = -kInfinity;
  for (const auto& [numbers, value] : left) most = std::max(most, value);
  for (int dim = 0; dim <= alpha.top_dim(); ++dim)
    alpha.for_each_cell(dim, [&](const Alpha::Cell& cell) {
      if (alpha.value(cell) > most + absolute) return;  // beyond the range of the oracle
      std::vector<Index> numbers;
      alpha.append_input_cell(dim, cell, numbers);
      const auto at = std::ranges::find_if(left, [&](const auto& other) {
        return other.first == numbers && std::abs(other.second - alpha.value(cell)) <= absolute;
      });
      ASSERT_NE(at, left.end()) << "no such cell, of value " << alpha.value(cell);
      left.erase(at);
    });
}

TEST(PeriodicDefinition, OnACircle) {
  for_each_seed(60, [](Generator& random, bool weighted, std::int64_t) {
    const PeriodicCloud cloud = any_periodic_cloud(random, 1, 8, weighted);
    SCOPED_TRACE(cloud.name);
    check_definition(cloud);
  });
}

TEST(PeriodicDefinition, InThePlane) {
  for_each_seed(120, [](Generator& random, bool weighted, std::int64_t) {
    const PeriodicCloud cloud = any_periodic_cloud(random, 2, 5, weighted);
    SCOPED_TRACE(cloud.name);
    check_definition(cloud);
  });
}

TEST(PeriodicDefinition, InSpace) {
  for_each_seed(40, [](Generator& random, bool weighted, std::int64_t) {
    const PeriodicCloud cloud = any_periodic_cloud(random, 3, 3, weighted);
    SCOPED_TRACE(cloud.name);
    check_definition(cloud);
  });
}

TEST(Periodic, EveryEngineFindsTheBarsOfTheOracle) {
  for_each_seed(120, [](Generator& random, bool weighted, std::int64_t field) {
    const PeriodicCloud cloud = any_periodic_cloud(random, random.integer(1, 3), 40, weighted);
    SCOPED_TRACE(cloud.name);
    const Alpha alpha(cloud.points, cloud.options());
    ASSERT_NO_FATAL_FAILURE(check_contract(alpha.listed(), alpha.top_dim(), field));
    const Barcode oracle =
        persistence(alpha, {.max_dim = 3, .field = field, .engine = Engine::standard});
    for (const auto& engine : detail::engines<Alpha>()) {
      if (!engine.can_run(alpha, {.max_dim = alpha.top_dim()})) continue;
      SCOPED_TRACE(engine.id.name());
      EXPECT_EQ(
          first_difference(persistence(alpha, {.max_dim = 3, .field = field, .engine = engine.id}),
                           oracle),
          "");
    }
    for (int dim = 0; dim <= 3; ++dim) {  // compares fewer dimensions
      const Barcode part = persistence(
          alpha, {.max_dim = dim, .min_dim = dim, .field = field, .engine = Engine::gradient});
      EXPECT_TRUE(std::ranges::equal(part, oracle.bars(dim))) << "H" << dim;
    }
    expect_betti_numbers(oracle, cloud.closed());
  });
}

// The images of the point form a lattice. The edge lengths and the radii of the triangles and
// tetrahedra were computed by hand.
TEST(Periodic, OnePointIsALattice) {
  const Barcode circle = persistence(Alpha(Points{{7.5}}, {.period = {2}}));
  ASSERT_EQ(circle.size(), 2U);
  EXPECT_EQ(circle[0], (Bar{0, 0, kInfinity}));
  EXPECT_EQ(circle[1], (Bar{1, 1, kInfinity}));
  const Alpha plane(Points{{0, 0}}, {.period = {2, 2}});
  EXPECT_EQ(plane.simplex_counts(), (std::vector<std::size_t>{1, 3, 2}));
  const Barcode torus = persistence(plane);
  ASSERT_EQ(torus.size(), 4U);
  EXPECT_EQ(torus[1], (Bar{1, 1, kInfinity}));
  EXPECT_EQ(torus[2], (Bar{1, 1, kInfinity}));
  EXPECT_EQ(torus[3], (Bar{2, std::sqrt(2.0), kInfinity}));
  EXPECT_TRUE(std::ranges::equal(torus.birth_cell(1).numbers, std::vector<Index>{0, 0}));
  EXPECT_TRUE(std::ranges::equal(torus.birth_cell(3).numbers, std::vector<Index>{0, 0, 0}));
  const Barcode space = persistence(Alpha(Points{{0.3, -5, 1e6}}, {.period = {2, 2, 2}}));
  ASSERT_EQ(space.size(), 8U);
  for (const Bar& bar : space.bars(1)) EXPECT_EQ(bar, (Bar{1, 1, kInfinity}));
  for (const Bar& bar : space.bars(2)) EXPECT_EQ(bar, (Bar{2, std::sqrt(2.0), kInfinity}));
  for (const Bar& bar : space.bars(3)) EXPECT_EQ(bar, (Bar{3, std::sqrt(3.0), kInfinity}));
}

TEST(Periodic, OneToTenPoints) {
  for (Index n = 1; n <= 10; ++n)
    for (const Index dim : {1, 2, 3}) {
      const std::vector<double> period(static_cast<std::size_t>(dim), 1);
      const Alpha alpha(uniform_points(n, dim, static_cast<std::uint64_t>(n)), {.period = period});
      const auto counts = alpha.simplex_counts();
      long euler = 0;
      for (std::size_t k = 0; k < counts.size(); ++k)
        euler += (k % 2 == 0 ? 1 : -1) * static_cast<long>(counts[k]);
      EXPECT_EQ(euler, 0);
      expect_betti_numbers(persistence(alpha, {.max_dim = 3}), static_cast<int>(dim));
    }
}

// If the box is doubled along one axis, it contains each point and each cell twice.
TEST(Periodic, TwiceTheLengthIsTwiceTheSame) {
  for_each_seed(40, [](Generator& random, bool ties, std::int64_t) {
    const Index dim = random.integer(1, 3);
    const PeriodicCloud once = [&] {
      PeriodicCloud cloud = any_periodic_cloud(random, dim, 12, false);
      while ((cloud.name[0] == 'g') != ties) cloud = any_periodic_cloud(random, dim, 12, false);
      // Rounds the coordinates to numbers that can be added without rounding errors.
      for (double& x : cloud.points.coordinates())
        x = std::ldexp(std::round(std::ldexp(x, 20)), -20);
      for (double& x : cloud.period) x = std::ldexp(std::round(std::ldexp(x, 20)), -20);
      return cloud;
    }();
    SCOPED_TRACE(once.name);
    std::size_t axis = 0;
    while (once.period[axis] == 0) ++axis;
    PeriodicCloud twice = once;
    const Index n = once.points.rows();
    twice.points = Points(2 * n, dim);
    for (Index i = 0; i < 2 * n; ++i)
      for (Index k = 0; k < dim; ++k) twice.points(i, k) = once.points(i % n, k);
    for (Index i = n; i < 2 * n; ++i)
      twice.points(i, static_cast<Index>(axis)) += once.period[axis];
    twice.period[axis] *= 2;
    const Alpha small(once.points, once.options()), large(twice.points, twice.options());
    auto counts = small.simplex_counts();
    for (std::size_t& count : counts) count *= 2;
    EXPECT_EQ(large.simplex_counts(), counts);
    for (int d = 0; d <= small.top_dim(); ++d) {
      std::vector<double> a, b;
      small.for_each_cell(d, [&](const auto& c) { a.insert(a.end(), 2, small.value(c)); });
      large.for_each_cell(d, [&](const auto& c) { b.push_back(large.value(c)); });
      std::ranges::sort(a);
      std::ranges::sort(b);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13 * (1 + a[i]));
    }
  });
}

// The numbers are chosen such that translations are exact. Rounding may still change the values,
// because they are computed from the vertices in another order.
TEST(Periodic, TranslationChangesNothing) {
  for_each_seed(60, [](Generator& random, bool ties, std::int64_t) {
    const Index dim = random.integer(1, 3), n = random.integer(1, 60);
    Points points(n, dim), moved(n, dim);
    AlphaOptions options;
    for (Index k = 0; k < dim; ++k) options.period.push_back(ties ? random.integer(2, 5) : 4096);
    std::vector<double> by;
    for (Index k = 0; k < dim; ++k) by.push_back(random.integer(-20'000, 20'000));
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < dim; ++k) {
        points(i, k) = random.integer(0, ties ? 5 : 4095);
        moved(i, k) = points(i, k) + by[static_cast<std::size_t>(k)];
      }
    const Barcode bars = persistence(Alpha(points, options), {.max_dim = 3});
    const Barcode of_moved = persistence(Alpha(moved, options), {.max_dim = 3});
    ASSERT_EQ(of_moved.size(), bars.size());
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_EQ(of_moved[i].dim, bars[i].dim);
      EXPECT_NEAR(of_moved[i].birth, bars[i].birth, 1e-13 * (1 + bars[i].birth));
      EXPECT_EQ(of_moved[i].is_infinite(), bars[i].is_infinite());
      if (!bars[i].is_infinite()) {
        EXPECT_NEAR(of_moved[i].death, bars[i].death, 1e-13 * (1 + bars[i].death));
      }
    }
  });
}

// Tests nearly flat layers, and points that are far apart. Near the ends of an axis that is not
// periodic, spheres are huge.
TEST(Periodic, CylindersAndSlabs) {
  for_each_seed(16, [](Generator& random, bool is_flat, std::int64_t field) {
    Points points = random.points(200, 3, false);
    for (Index i = 0; is_flat && i < 200; ++i)
      points(i, 2) = i % 2 == 0 ? 1e-9 * random.real() : 1 - 1e-7 * random.real();
    std::vector<double> period{1, 1, 0};
    if (random.coin()) period[1] = 0;
    const Alpha alpha(points, {.period = period});
    ASSERT_NO_FATAL_FAILURE(check_contract(alpha.listed(), 3, field));
    const Barcode bars = persistence(alpha, {.max_dim = 3, .field = field});
    EXPECT_EQ(
        first_difference(
            bars, persistence(alpha, {.max_dim = 3, .field = field, .engine = Engine::twist})),
        "");
    expect_betti_numbers(bars, period[1] == 0 ? 1 : 2);
  });
  const Barcode far = persistence(Alpha(Points{{0, 0}, {0.25, 50}}, {.period = {1, 0}}));
  ASSERT_EQ(far.size(), 5U);  // the cells: two circles, two edges between them, two triangles
  EXPECT_EQ(far[1], (Bar{0, 0, kInfinity}));
  EXPECT_NEAR(far[0].death, std::hypot(0.25, 50) / 2, 1e-13);
  EXPECT_EQ(std::ranges::count(far, Bar{1, 0.5, kInfinity}), 1);
}

TEST(Periodic, CopiesModuloTheLengths) {
  const Alpha alpha(Points{{0, 0.25}, {1, 0.25}, {-3, 4.25}, {0.5, 0.5}}, {.period = {1, 1}});
  EXPECT_EQ(alpha.copies(), (std::vector<Index>{1, 2}));
  const Barcode all = persistence(alpha, {.min_persistence = -1});
  EXPECT_EQ(std::ranges::count(all, Bar{0, 0, 0}), 2);
  EXPECT_EQ(first_difference(persistence(alpha),
                             persistence(Alpha(Points{{0, 0.25}, {0.5, 0.5}}, {.period = {1, 1}}))),
            "");
}

TEST(Periodic, OrderOfPointsIsIrrelevant) {
  for_each_seed(40, [](Generator& random, bool weighted, std::int64_t) {
    const PeriodicCloud cloud = any_periodic_cloud(random, random.integer(1, 3), 40, weighted);
    SCOPED_TRACE(cloud.name);
    PeriodicCloud other = cloud;
    std::ranges::reverse(other.weights);
    for (Index i = 0; i < cloud.points.rows(); ++i)
      for (Index k = 0; k < cloud.points.cols(); ++k)
        other.points(i, k) = cloud.points(cloud.points.rows() - 1 - i, k);
    EXPECT_EQ(first_difference(persistence(Alpha(other.points, other.options())),
                               persistence(Alpha(cloud.points, cloud.options()))),
              "");
  });
}

TEST(Periodic, Threshold) {
  for_each_seed(60, [](Generator& random, bool weighted, std::int64_t) {
    const PeriodicCloud cloud = any_periodic_cloud(random, random.integer(1, 3), 25, weighted);
    AlphaOptions options = cloud.options();
    const Barcode all = persistence(Alpha(cloud.points, options), {.max_dim = 3});
    options.threshold =
        all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))].birth;
    const Alpha alpha(cloud.points, options);
    EXPECT_EQ(first_difference(persistence(alpha, {.max_dim = 3}),
                               persistence(alpha, {.max_dim = 3, .engine = Engine::standard})),
              "");
    int top = -1;
    for (int dim = 0; dim <= 3; ++dim) alpha.for_each_cell(dim, [&](const auto&) { top = dim; });
    EXPECT_EQ(alpha.top_dim(), top);
  });
}

TEST(Periodic, ThreadsChangeNothing) {
  const Points points = uniform_points(20'000, 3, 8);
  std::optional<Barcode> first;
  for (const int threads : {1, 2, 3, 8}) {
    ThreadsContext context(threads);
    const Barcode bars = persistence(Alpha(points, {.period = {1, 1, 1}}, context),
                                     {.max_dim = 3, .min_persistence = 1e-4}, context);
    if (!first) {
      first = bars;
      EXPECT_GT(bars.size(), 1000U);
      expect_betti_numbers(bars, 3);
      continue;
    }
    ASSERT_EQ(pairs_of(bars), pairs_of(*first));
  }
}

TEST(Periodic, UnitsArePowersOfTwoExactly) {
  const Points points = uniform_points(100, 3, 1);
  const Barcode bars = persistence(Alpha(points, {.period = {1, 0.75, 0}}));
  for (const int power : {-500, -3, 7, 500}) {
    const double unit = std::ldexp(1.0, power);
    Points scaled = points;
    for (double& x : scaled.coordinates()) x *= unit;
    const Barcode other = persistence(Alpha(scaled, {.period = {unit, 0.75 * unit, 0}}));
    ASSERT_EQ(other.size(), bars.size());
    for (std::size_t i = 0; i < bars.size(); ++i)
      ASSERT_EQ(other[i], (Bar{bars[i].dim, bars[i].birth * unit, bars[i].death * unit}));
  }
}

// If a margin is too small, points far from the faces of their box get no images beyond the faces.
// The code must notice that the space continues there.
TEST(Periodic, TooFewImagesAreNoticed) {
  const RunContext context;
  const Points points = uniform_points(30, 3, 12);
  const alpha::Sites sites = alpha::sites_of(points, {}, context);
  for (const double length : {3.0, 1.5}) {
    const alpha::Box box{{length, 0, 0}, 4};
    for (const double margin : {0.0, 4.0}) {
      alpha::Images images = alpha::images_within(
          sites, box, [&](const auto&) { return margin; }, context);
      alpha::Triangulation triangulation = alpha::triangulate(images.places, context);
      EXPECT_EQ(alpha::take_quotient(triangulation, images, box, context), margin > 0);
    }
  }
}

TEST(Periodic, NoLengthsArePlainSpace) {
  const Points points = uniform_points(50, 3, 3);
  const Alpha alpha(points, {.period = {0, 0, 0}});
  EXPECT_FALSE(alpha.is_periodic());
  EXPECT_EQ(first_difference(persistence(alpha), persistence(Alpha(points))), "");
  const Alpha none(Points(0, 2), {.period = {1, 1}});
  EXPECT_EQ(none.top_dim(), -1);
  EXPECT_TRUE(persistence(none).empty());
}

TEST(Periodic, Refusals) {
  expect_error(ErrorKind::usage, "found 2 lengths", [] {
    Alpha(Points(3, 3), {.period = {1, 1}});
  });
  for (const double wrong : {-1.0, kInfinity, std::nan("")})
    expect_error(ErrorKind::usage, "period of axis 1", [&] {
      Alpha(Points(3, 2), {.period = {1, wrong}});
    });
  expect_error(ErrorKind::usage, "found delaunay-cech values", [] {
    Alpha(Points(3, 2), {.period = {1, 1}, .value = AlphaOptions::Value::delaunay_cech});
  });
  expect_error(ErrorKind::bad_data, "rounded to 0", [] {
    Alpha(Points(3, 2), {.period = {1, 1e-30}});
  });
  expect_error(ErrorKind::bad_data, "point 1, coordinate 0", [] {
    Alpha(Points{{0, 0}, {kInfinity, 0}}, {.period = {1, 1}});
  });
  const Alpha alpha(Points{{0, 0, 0}}, {.period = {1, 1, 1}});
  expect_error(ErrorKind::usage, "periodic", [&] { alpha_shape(alpha, 1); });
  expect_error(ErrorKind::usage, "periodic", [&] { wrap(alpha, 1); });
}

TEST(Periodic, StopsAndKeepsToItsMemory) {
  const Points points = uniform_points(20'000, 3, 10);
  const AlphaOptions options{.period = {1, 1, 1}};
  StoppableContext context;
  std::vector<std::string> stages;
  context.on_progress = [&](const Progress& p) { stages.emplace_back(p.stage); };
  const Alpha alpha(points, options, context);
  EXPECT_FALSE(stages.empty());
  context.request_stop();
  expect_error(ErrorKind::cancelled, "", [&] { Alpha(points, options, context); });
  expect_error(ErrorKind::cancelled, "", [&] { persistence(alpha, {}, context); });
  LimitedContext small(10 << 20);
  expect_error(ErrorKind::resource, "memory limit", [&] { Alpha(points, options, small); });
  EXPECT_EQ(small.memory.used(), 0U);
}

}  // namespace
}  // namespace ph::test
