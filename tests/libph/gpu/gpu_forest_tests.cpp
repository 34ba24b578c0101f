// SPDX-License-Identifier: MIT
// The GPU finds the same forest as the CPU, edge for edge and bit for bit.
#include <cmath>
#include <cstring>

#include "ph/custom.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

std::vector<FlagEdge> edges_of(const Points& points, const RipsOptions& options) {
  const Rips rips(points, options);
  const RipsGraph& forest = rips.graph(RipsForm::forest);
  EXPECT_TRUE(forest.is_forest());
  const std::span<const FlagEdge> edges = forest.edges();
  return {edges.begin(), edges.end()};
}

void expect_same(const Points& points, RipsOptions options = {}) {
  options.device = Device::cpu;
  const auto expected = edges_of(points, options);
  options.device = Device::gpu;
  const auto found = edges_of(points, options);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_EQ(std::memcmp(&found[i], &expected[i], sizeof(FlagEdge)), 0)
        << "edge " << i << ": (" << found[i].value << ", " << found[i].u << ", " << found[i].v
        << "), expected (" << expected[i].value << ", " << expected[i].u << ", " << expected[i].v
        << ")";
}

class GpuForest : public ::testing::Test {
 protected:
  void SetUp() override {
    RipsOptions options;
    options.device = Device::gpu;
    try {
      Rips(Points{{0.0}}, options).graph(RipsForm::forest);
    } catch (const Error& error) {
      GTEST_SKIP() << "NOT TESTED: " << error.what();
    }
  }
};

enum class Kind { cloud, grid, clusters, line, two_lines, outlier, growing, tiny, last = tiny };

Points points_of(Generator& random, Kind kind, Index n, Index d) {
  Points points(n, d);
  const Points centres = random.points(5, d, false);
  for (Index i = 0; i < n; ++i) {
    const double width = std::ldexp(1, -random.integer(0, 60));
    const int centre = random.integer(0, 4), small = -460 - random.integer(0, 500);
    for (Index k = 0; k < d; ++k) {
      double& x = points(i, k);
      x = random.real();
      if (kind == Kind::grid) x = std::round(6 * x - 3);
      if (kind == Kind::clusters) x = centres(centre, k) + width * x;
      if (kind == Kind::line && k > 0) x = points(i, 0);
      if (kind == Kind::two_lines && k > 0) x = double(i % 2);
      if (kind == Kind::outlier && i > 0) x *= 1e-12;
      if (kind == Kind::growing) x = k > 0 ? 0 : std::ldexp(1, static_cast<int>(i % 900) - 450);
      // Squares of these coordinates underflow.
      if (kind == Kind::tiny && i > 0) x = std::ldexp(x, small);
    }
  }
  for (Index i = 1; i < n; ++i)
    if (random.integer(0, 7) == 0) copy_point(points, random.integer(0, int(i) - 1), points, i);
  return points;
}

TEST_F(GpuForest, IsThatOfTheCpu) {
  for_each_seed(3000, [](Generator& random, bool is_small, std::int64_t) {
    const auto kind = static_cast<Kind>(random.integer(0, static_cast<int>(Kind::last)));
    const Index n = random.integer(1, is_small ? 40 : random.integer(0, 9) > 0 ? 700 : 5000);
    const Index d = random.integer(0, 3) > 0 ? random.integer(1, 8) : random.integer(0, 70);
    SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", " + std::to_string(n) +
                 " points of " + std::to_string(d) + " coordinates");
    const Points points = points_of(random, kind, n, d);
    expect_same(points);
    RipsOptions options;
    const auto edges = edges_of(points, {});
    if (edges.empty()) return;  // the threshold equals an edge, or is the next smaller number
    options.threshold = edges[static_cast<std::size_t>(random.real() * double(edges.size()))].value;
    expect_same(points, options);
    options.threshold = std::nextafter(*options.threshold, 0.0);
    expect_same(points, options);
  });
}

TEST_F(GpuForest, OfAMillionPoints) {
  for (const Kind kind : {Kind::cloud, Kind::clusters, Kind::grid}) {
    Generator random(7);
    expect_same(points_of(random, kind, seeds(1'000'000), 3));
  }
}

// There are more points than fit into one range of candidates or one tile of query points.
TEST_F(GpuForest, OfManyAxes) {
  for (const Index d : {9, 15, 16, 17, 33, 768}) {
    Generator random(static_cast<std::uint64_t>(d));
    expect_same(random.points(2600, d, false));
    expect_same(random.points(1100, d, true));
  }
}

TEST_F(GpuForest, OfSomeOfThePoints) {
  Generator random(3);
  const Points points = random.points(300, 2, true);
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < 300; i += 3) chosen.push_back(i);
  RipsOptions options;
  options.vertices = chosen;
  expect_same(points, options);
  options.merge_equal_points = true;
  expect_same(points, options);
}

TEST_F(GpuForest, OfNoPoints) {
  expect_same(Points());
  expect_same(Points(0, 3));
  expect_same(Points(1, 3));
  expect_same(Points(5, 3));
}

TEST_F(GpuForest, RefusesSquaresOutOfRange) {
  RipsOptions options;
  options.device = Device::gpu;
  for (const double x : {1e151, 1e-141})
    expect_error(ErrorKind::usage, "between 1e-140 and 1e150", [&] {
      Rips(Points{{x}, {0.0}}, options).graph(RipsForm::forest);
    });
}

TEST_F(GpuForest, StopsWhenAskedTo) {
  StoppedContext context;
  RipsOptions options;
  options.device = Device::gpu;
  Generator random(1);
  expect_error(ErrorKind::cancelled, "",
               [&] { Rips(random.points(9, 2, false), options).graph(RipsForm::forest, context); });
}

}  // namespace
}  // namespace ph::test
