// SPDX-License-Identifier: MIT
// The graph of a Rips filtration: thresholds, layouts, small and degenerate inputs.
#include <limits>

#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = kInfinity;

TEST(RipsGraphs, TheDefaultThresholdIsTheEnclosingRadius) {
  for_each_seed(200, [&](Generator& random) {
    const Index n = random.integer(1, 12);
    const DistanceMatrix d = random.distances(n, random.coin());
    double radius = kInf;
    for (Index i = 0; i < n; ++i) {
      double farthest = 0;
      for (Index j = 0; j < n; ++j) farthest = std::max(farthest, d(i, j));
      radius = std::min(radius, farthest);
    }
    const Rips rips(d);
    EXPECT_EQ(all_edges(rips).threshold(), radius);
    // Nothing changes beyond the enclosing radius, whatever the distances are.
    EXPECT_EQ(bars_of(persistence(rips, {.max_dim = 3})),
              bars_of(persistence(Rips(d, {.threshold = kInf}), {.max_dim = 3})));
  });
}

TEST(RipsGraphs, TheThresholdIsInclusive) {
  const DistanceMatrix d(3, {1, 2, 3});
  EXPECT_EQ(all_edges(Rips(d, {.threshold = 2})).edge_count(), 2U);
  EXPECT_EQ(all_edges(Rips(d, {.threshold = std::nextafter(2.0, 0.0)})).edge_count(), 1U);
  EXPECT_EQ(all_edges(Rips(d, {.threshold = 0})).edge_count(), 0U);
  EXPECT_EQ(
      all_edges(Rips(SparseDistances(3, {{0, 1, 2}, {1, 2, 3}}), {.threshold = 2})).edge_count(),
      1U);
  const Points line{{0}, {1}, {3}};
  EXPECT_EQ(all_edges(Rips(line, {.threshold = 2})).edge_count(), 2U) << "by the k-d tree";
  EXPECT_EQ(
      all_edges(Rips(line, {.threshold = 2, .distance = PointDistance::manhattan})).edge_count(),
      2U);
  for (const double bad : {-1.0, kNan, -kInf}) {
    expect_error(ErrorKind::usage, "threshold", [&] { Rips(d, {.threshold = bad}); });
    expect_error(ErrorKind::usage, "threshold",
                 [&] { Rips(SparseDistances(1, {}), {.threshold = bad}); });
    expect_error(ErrorKind::usage, "", [&] { Rips(line, {.threshold = bad}); });
  }
}

// Checks that the keys 1, 2, … follow the order of the edges by (distance, larger end, smaller
// end).
void expect_keys_ascend(const Rips& rips) {
  std::vector<std::array<double, 3>> edges;
  for (RipsGraph::Key key = 1; key <= all_edges(rips).edge_count(); ++key) {
    const auto edge = all_edges(rips).edge(key);
    EXPECT_GT(edge.u, edge.v);
    EXPECT_EQ(all_edges(rips).adjacency().key_of(edge.u, edge.v), key);
    EXPECT_EQ(all_edges(rips).adjacency().key_of(edge.v, edge.u), key);
    edges.push_back({all_edges(rips).value(key), double(edge.u), double(edge.v)});
  }
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
}

TEST(RipsGraphs, KeysAscendWithDistanceAndVertices) {
  const Rips small(DistanceMatrix(4, {1, 1, 1, 0, 2, 1}), {.threshold = 2});
  EXPECT_EQ(all_edges(small).edge_count(), 6U);
  expect_keys_ascend(small);
  for (const bool ties : {true, false}) {
    Generator random(5);
    const Points points = random.points(70, 2, ties);
    expect_keys_ascend(Rips(points));
    expect_keys_ascend(Rips(points, {.threshold = 1}));
    expect_keys_ascend(Rips(SparseDistances::within(points, 1)));
    expect_keys_ascend(Rips(random.distances(70, ties)));
  }
}

struct NegativeZeros {
  Index size() const { return 60; }
  double operator()(Index i, Index j) const { return (i + j) % 2 == 0 ? 0.0 : -0.0; }
};

// Some bins have many edges, some have few edges, and some have a single value. The threshold may
// be absent.
TEST(RipsGraphs, ManyEdgesAreSorted) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Generator random(seed);
    const Index n = 300;
    std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
    for (double& d : lower) {
      const double scale[] = {1, 1, 1e-300, 1e300};
      d = seed % 2 == 0 ? random.integer(0, 5) : random.real() * scale[random.integer(0, 3)];
    }
    const DistanceMatrix distances(n, lower);
    const double threshold = seed % 4 < 2 ? kInf : distances(17, 4);
    std::vector<std::array<double, 3>> expected, found;
    for (Index u = 0; u < n; ++u)
      for (Index v = 0; v < u; ++v)
        if (distances(u, v) <= threshold)
          expected.push_back({distances(u, v), double(u), double(v)});
    std::sort(expected.begin(), expected.end());
    const Rips rips(distances, {.threshold = threshold});
    for (const FlagEdge& e : all_edges(rips).edges())
      found.push_back({e.value, double(e.u), double(e.v)});
    EXPECT_EQ(found, expected) << "seed " << seed;
  }
}

// If edges are requested bin by bin, they are the same as if all are requested at once. Other bins
// stay unsorted.
TEST(RipsGraphs, BinsAreSortedWhenTheyAreNeeded) {
  Generator random(3);
  // The distances are nearly equal, so the bins are large.
  const Points points = random.points(1000, 8, false);
  RunContext one, three;
  one.threads = 1;
  three.threads = 3;
  const Rips expected(points, {}, one), found(points, {}, three);
  const BinnedEdges& bins = found.graph(RipsForm::edges, three).binned_edges();
  ASSERT_GT(bins.bin_count(), 10U);
  const auto is_sorted = [](std::span<const FlagEdge> edges) {
    return std::ranges::is_sorted(edges,
                                  [](const auto& a, const auto& b) { return precedes(a, b); });
  };
  const std::size_t half = bins.bin_count() / 2;
  EXPECT_EQ(bins.sorted_bins(half).size(), bins.bin_begin(half));
  EXPECT_TRUE(is_sorted(bins.sorted_bins(half)));
  EXPECT_FALSE(bins.with_bins(half, bins.bin_count(), is_sorted));
  const auto all = all_edges(found).edges();
  ASSERT_EQ(all.size(), expected.graph(RipsForm::edges, one).edge_count());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const FlagEdge& e = all_edges(expected).edges()[i];
    ASSERT_TRUE(all[i].value == e.value && all[i].u == e.u && all[i].v == e.v) << i;
  }
}

// There are enough edges for several threads to share the sorting and the links.
TEST(RipsGraphs, ThreadsAgreeOnManyEdges) {
  Generator random(5);
  const Points points = random.points(1400, 8, false);
  std::vector<Pair> alone;
  for (const int threads : {1, 2, 3, 8}) {
    RunContext context;
    context.threads = threads;
    const Rips rips(points, {}, context);
    const auto found = pairs_of(persistence(rips, {.max_dim = 1}, context));
    if (threads == 1) alone = found;
    EXPECT_EQ(found, alone) << threads << " threads";
  }
  EXPECT_GT(alone.size(), 1400U);
}

TEST(RipsGraphs, ZeroHasOneSign) {
  const Rips rips(NegativeZeros{});
  expect_keys_ascend(rips);
  for (RipsGraph::Key key = 1; key <= all_edges(rips).edge_count(); ++key)
    EXPECT_FALSE(std::signbit(all_edges(rips).value(key)));
}

TEST(RipsGraphs, InfiniteDistancesAreNoEdges) {
  const Rips matrix(DistanceMatrix(3, {1, kInf, kInf}), {.threshold = kInf});
  EXPECT_EQ(all_edges(matrix).edge_count(), 1U);
  const Rips no_radius(DistanceMatrix(3, {1, kInf, kInf}));
  EXPECT_EQ(all_edges(no_radius).edge_count(), 1U);
  EXPECT_EQ(bars_of(persistence(no_radius)),
            (std::vector<Bar>{{0, 0, 1}, {0, 0, kInf}, {0, 0, kInf}}));
  EXPECT_EQ(all_edges(Rips(SparseDistances(2, {{0, 1, kInf}}))).edge_count(), 0U);
}

TEST(RipsGraphs, ADistanceThatOverflowsIsNotTakenForInfinite) {
  const Points far{{-1.7e308}, {1.7e308}};
  for (const std::optional<double> threshold : {std::optional<double>(), std::optional(kInf)})
    expect_error(ErrorKind::bad_data, "largest double",
                 [&] { all_edges(Rips(far, {.threshold = threshold})); });
}

// Vertices without edges make the graph sparse, and change nothing else.
TEST(RipsGraphs, LayoutsAgree) {
  for_each_seed(200, [&](Generator& random) {
    const SparseDistances few = random.sparse(random.integer(4, 9), random.coin(), 0.8);
    const SparseDistances many(few.size() + 40, few.edges());
    const Rips dense(few), sparse(many);
    EXPECT_FALSE(all_edges(sparse).is_dense());
    const auto expected = pairs_of(persistence(dense, {.max_dim = 3, .min_persistence = -1}));
    std::vector<Pair> found;
    for (Pair& p : pairs_of(persistence(sparse, {.max_dim = 3, .min_persistence = -1})))
      if (p.birth_cell[0] < few.size()) found.push_back(std::move(p));
    EXPECT_EQ(found, expected);
  });
  EXPECT_TRUE(all_edges(Rips(DistanceMatrix(3, {1, 1, 1}))).is_dense());
}

TEST(RipsGraphs, CliqueBoundsHold) {
  for_each_seed(300, [&](Generator& random) {
    const Rips rips(random.sparse(random.integer(0, 12), true, random.real()));
    const Index bound = all_edges(rips).adjacency().clique_bound();
    EXPECT_LE(bound, rips.size());
    with_all_edges(rips, 20, [&](const auto& f) {
      EXPECT_EQ(f.top_dim(), static_cast<int>(bound) - 1);
      for (int dim = 0; dim <= f.top_dim() + 1; ++dim) f.for_each_cell(dim, [](const auto&) {});
    });
    // Checks that no simplex is missing: the Euler characteristic equals the Euler characteristic
    // of the complex of all cliques.
    check(rips, 12, {2});
  });
}

TEST(RipsInputs, NoneOneAndTwoPoints) {
  for (const int max_dim : {0, 1, 2, 60, INT_MAX}) {
    EXPECT_TRUE(persistence(Rips(Points(0, 3)), {.max_dim = max_dim}).empty());
    EXPECT_TRUE(persistence(Rips(SparseDistances(0, {})), {.max_dim = max_dim}).empty());
    EXPECT_EQ(bars_of(persistence(Rips(DistanceMatrix(1, {})), {.max_dim = max_dim})),
              (std::vector<Bar>{{0, 0, kInf}}));
    EXPECT_EQ(bars_of(persistence(Rips(DistanceMatrix(2, {3})), {.max_dim = max_dim})),
              (std::vector<Bar>{{0, 0, 3}, {0, 0, kInf}}));
    EXPECT_EQ(bars_of(persistence(Rips(DistanceMatrix(2, {0})), {.max_dim = max_dim})),
              (std::vector<Bar>{{0, 0, kInf}}));
  }
}

struct Arc {  // points on a circle of circumference 12, with the user's own distance
  Index size() const { return 12; }
  int operator()(Index i, Index j) const {
    const auto steps = static_cast<int>(std::abs(i - j));
    return std::min(steps, 12 - steps);
  }
};

TEST(RipsInputs, AMetricOfTheUsersOwn) {
  const Rips rips(Arc{});
  check(rips, 1);
  const Barcode barcode = persistence(rips);
  EXPECT_EQ(intervals(barcode, 1), (std::vector<std::pair<double, double>>{{1, 4}}));
}

struct Broken {
  double value;
  Index size() const { return 3; }
  double operator()(Index i, Index j) const { return i + j == 3 ? value : 1; }
};

TEST(RipsInputs, ABrokenMetricIsRefused) {
  for (const double bad : {-1.0, kNan, -kInf}) {
    expect_error(ErrorKind::bad_data, "distance (2, 1)",
                 [&] { all_edges(Rips(Broken{bad}, {.threshold = 5})); });
    expect_error(ErrorKind::bad_data, "distance", [&] { all_edges(Rips(Broken{bad})); });
    expect_error(ErrorKind::bad_data, "distance (2, 1)",
                 [&] { Rips(Broken{bad}).graph(RipsForm::forest); });
  }
}

TEST(RipsInputs, NamedDistances) {
  const Points square{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const auto loop = [&](PointDistance distance) {
    return intervals(persistence(Rips(square, {.distance = distance})), 1);
  };
  using Loops = std::vector<std::pair<double, double>>;
  EXPECT_EQ(loop(PointDistance::euclidean), (Loops{{1, std::sqrt(2.0)}}));
  EXPECT_EQ(loop(PointDistance::manhattan), (Loops{{1, 2}}));
  EXPECT_EQ(loop(PointDistance::chebyshev), Loops{});
  EXPECT_EQ(loop(PointDistance::hamming), (Loops{{1, 2}}));
}

TEST(RipsInputs, MergingEqualPointsLosesNothingButBarsOfLengthZero) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Generator random(seed);
    Points points = random.points(random.integer(0, 14), random.integer(0, 2), true);
    for (double& x : points.coordinates())
      if (x == 0 && random.coin()) x = -0.0;
    RipsOptions options;
    if (random.coin()) options.threshold = random.integer(0, 3);
    options.merge_equal_points = false;
    const Rips all(points, options);
    options.merge_equal_points = true;
    const Rips merged(points, options);
    for (const int p : {2, 3})
      ASSERT_EQ(bars_of(persistence(merged, {.max_dim = 3, .field = p})),
                bars_of(persistence(all, {.max_dim = 3, .field = p})))
          << "seed " << seed;
  }
}

TEST(RipsInputs, MergedPointsAreNamedByTheFirstOfThem) {
  Points points{{3}, {3}, {0}, {3}, {0}};
  const Rips merged(points, {.merge_equal_points = true});
  EXPECT_EQ(merged.size(), 5);
  EXPECT_EQ(merged.graph(RipsForm::distinct_edges).size(), 2);
  const Barcode barcode = persistence(merged);
  ASSERT_EQ(barcode.size(), 2U);
  EXPECT_EQ(barcode[0], (Bar{0, 0, 3}));
  EXPECT_TRUE(std::ranges::equal(barcode.death_cell(0)->numbers, std::vector<Index>{0, 2}));
  expect_error(ErrorKind::usage, "merge", [&] { merge_tree(merged); });
  points(1, 0) = kNan;
  expect_error(ErrorKind::bad_data, "point 1", [&] { Rips(points, {.merge_equal_points = true}); });
}

// Each pair of points would be an edge. In total, there would be 5 * 10^11 edges.
TEST(RipsInputs, AMillionCopiesTakeNearLinearTime) {
  Points points(1000000, 3);
  for (Index i = 0; i < points.rows(); ++i)
    points.set_row(i, {static_cast<double>(i % 7), static_cast<double>(i % 3), 1e300});
  const Rips rips(points, {.merge_equal_points = true});
  EXPECT_EQ(rips.graph(RipsForm::distinct_edges).size(), 21);
  const Rips near(points, {.threshold = 1, .merge_equal_points = true});
  EXPECT_EQ(near.graph(RipsForm::distinct_edges).edge_count(), 32U) << "a grid of 7 x 3";
}

// With 2^20 points, one word holds a cell of three vertices, and four words hold a cell of twelve.
TEST(RipsInputs, WideCellsWhereOneWordIsNotEnough) {
  std::vector<WeightedEdge> edges;
  const Simplices sphere = cross_polytope(3);
  const Index n = 1 << 20;
  for (Index u = 0; u < 8; ++u)
    for (Index v = u + 1; v < 8; ++v)
      if (u / 2 != v / 2) edges.push_back({n - 1 - u * 1000, n - 1 - v * 1000, 1});
  const Barcode barcode = persistence(Rips(SparseDistances(n, edges)), {.max_dim = 3});
  EXPECT_EQ(barcode.bars(0).size(), static_cast<std::size_t>(n));
  EXPECT_EQ(barcode.bars(1).size(), 0U);
  EXPECT_EQ(barcode.bars(2).size(), 0U);
  EXPECT_EQ(intervals(barcode, 3), (std::vector<std::pair<double, double>>{{1, kInf}}));
}

TEST(RipsInputs, SimplicesTooLargeForAnyCellAreRefused) {
  const Rips rips(DistanceMatrix(300, std::vector<double>(300 * 299 / 2, 1.0)));
  expect_error(ErrorKind::resource, "lower the dimension",
               [&] { persistence(rips, {.max_dim = 200, .collapse = Collapse::off}); });
  EXPECT_EQ(persistence(rips, {.max_dim = 200}).size(), 300U) << "a tree is left of the edges";
}

/// The cells that are in no apparent pair, found with or without rows of bits.
template <class F>
auto unmatched_cells(const F& f, int dim, bool has_rows) {
  std::vector<typename F::Cell> cells;
  typename F::UnmatchedCells unmatched(f, dim, has_rows);
  unmatched.for_each(
      0, f.group_count(), [&](const auto& c) { cells.push_back(c); }, [] {});
  return cells;
}

// The bits of all vertices take several words.
TEST(RipsFiltrations, CellsInNoApparentPair) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Generator random(seed);
    const bool ties = seed % 2 == 0;
    const Rips rips = seed % 3 == 0
                          ? Rips(random.points(70, 3, ties), {.threshold = ties ? 1 : 0.4})
                      : seed % 3 == 1 ? Rips(random.sparse(140, ties, 0.15))
                                      : Rips(random.distances(20, ties));
    with_all_edges(rips, 4, [&](const auto& f) {
      check_apparent_pairs(f, 2);
      for (const int dim : {1, 2, 3, 4})
        EXPECT_EQ(unmatched_cells(f, dim, true), unmatched_cells(f, dim, false)) << seed;
    });
  }
}

}  // namespace
}  // namespace ph::test
