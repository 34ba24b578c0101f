// SPDX-License-Identifier: MIT
// Edge collapse removes edges, but must keep the bars, with valid cells and cycles.
#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/detail/rips/rips_graph.hpp"

#include <fstream>
#include <sstream>

#include "ph/eigen.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/representatives.hpp"
#include "tests/support/rips_graphs.hpp"
#include "tests/support/run_contexts.hpp"
#include "tests/support/test_data.hpp"

namespace ph::test {
namespace {

/// Random input: points, any matrix with missing edges, or sparse distances. Half of the inputs
/// have many ties: copies of points, distances of zero, and thresholds equal to a distance.
Rips random_rips(Generator& random, Index most_points, bool ties) {
  const Index n = random.integer(0, static_cast<int>(most_points));
  RipsOptions options;
  if (random.coin()) options.threshold = ties ? random.integer(0, 3) : random.real();
  options.merge_equal_points = random.coin();
  switch (random.integer(0, 2)) {
    case 0:
      return Rips(random.points(n, random.integer(1, 4), ties), options);
    case 1: {
      std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
      const bool has_holes = random.coin();
      for (double& d : lower)
        d = has_holes && random.integer(0, 4) == 0 ? kInfinity : random.value(ties);
      return Rips(DistanceMatrix(n, lower), options);
    }
    default:
      return Rips(random.sparse(n, ties, random.real()), options);
  }
}

/// The graph that the engine cohomology uses for H1. The collapse starts from this graph.
const RipsGraph& graph_of(const Rips& rips) {
  return planned_graph(rips, {.max_dim = 1, .engine = Engine::cohomology});
}

TEST(EdgeCollapse, LeavesTheBarsAsTheyAre) {
  for_each_seed(24000, [](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 3);
    const Rips rips = random_rips(random, max_dim == 3 ? 8 : 10, ties);
    const auto bars = [&](Engine engine, Collapse collapse) {
      return bars_of(persistence(
          rips, {.max_dim = max_dim, .field = field, .engine = engine, .collapse = collapse}));
    };
    EXPECT_EQ(bars(Engine::cohomology, Collapse::on), bars(Engine::standard, Collapse::off));
  });
}

// There are enough vertices for several words of bits, and some vertices are born late.
TEST(EdgeCollapse, LeavesTheBarsOfManyPointsAsTheyAre) {
  for_each_seed(40, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips = random.coin() ? Rips(random.points(70, random.integer(2, 3), false))
                                    : Rips(random.sparse(150, ties, 0.1));
    const auto bars = [&](Collapse collapse) {
      return bars_of(persistence(
          rips,
          {.max_dim = 1, .field = field, .engine = Engine::cohomology, .collapse = collapse}));
    };
    EXPECT_EQ(bars(Collapse::on), bars(Collapse::off));
  });
}

std::vector<std::array<double, 3>> edges_of(const RipsGraph& graph) {
  std::vector<std::array<double, 3>> edges;
  for (const FlagEdge& e : graph.edges())
    edges.push_back({e.value, static_cast<double>(e.u), static_cast<double>(e.v)});
  return edges;
}

TEST(EdgeCollapse, MovesEdgesToLaterValuesOfTheGraph) {
  std::size_t moved = 0;
  for_each_seed(2000, [&](Generator& random, bool ties, std::int64_t) {
    const Rips rips = random_rips(random, 12, ties);
    const RipsGraph& graph = graph_of(rips);
    const RipsGraph collapsed = collapse_edges(graph);
    EXPECT_EQ(edges_of(collapsed),
              edges_of(collapse_edges(graph, default_context(), CollapseLayout::lists)));
    EXPECT_EQ(collapsed.size(), graph.size());
    EXPECT_EQ(collapsed.threshold(), graph.threshold());
    for (std::uint32_t v = 0; v < graph.size(); ++v) EXPECT_EQ(collapsed.name(v), graph.name(v));
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> value_of;
    std::set<double> values;
    for (const FlagEdge& e : graph.edges()) {
      value_of[{e.u, e.v}] = e.value;
      values.insert(e.value);
    }
    const FlagEdge* before = nullptr;
    for (const FlagEdge& e : collapsed.edges()) {
      ASSERT_TRUE(value_of.contains({e.u, e.v})) << "not an edge, or there twice";
      EXPECT_GE(e.value, value_of.at({e.u, e.v}));
      EXPECT_TRUE(values.contains(e.value));
      const auto was_moved = [&](const FlagEdge& f) { return value_of.at({f.u, f.v}) < f.value; };
      if (before && before->value == e.value) {
        EXPECT_LE(was_moved(e), was_moved(*before)) << "edges moved to a value come first";
      }
      if (before) {
        EXPECT_LE(before->value, e.value);
        if (was_moved(*before) == was_moved(e) && !was_moved(e) && before->value == e.value) {
          EXPECT_LT(std::pair(before->u, before->v), std::pair(e.u, e.v));
        }
      }
      moved += was_moved(e);
      before = &e;
    }
    for (const FlagEdge& e : collapsed.edges()) value_of.erase({e.u, e.v});
    EXPECT_EQ(collapsed.edge_count() + value_of.size(), graph.edge_count());
  });
  EXPECT_TRUE(is_enough(moved, std::size_t{1000})) << moved;
}

// One pass is not enough, because an edge that has already been checked may become dominated later
// in the pass.
TEST(EdgeCollapse, GoesOnUntilLittleIsDominated) {
  for_each_seed(6, [](Generator& random, bool, std::int64_t) {
    const Rips rips(random.points(120, 3, false));
    EXPECT_GT(dominated_share(all_edges(rips)), 0.9);
    EXPECT_LT(dominated_share(collapse_edges(all_edges(rips))), 0.1);
  });
}

/// The diameter of a simplex in the input.
double diameter(const Rips& rips, const InputCell& cell) {
  const RipsGraph& graph = all_edges(rips);
  double largest = 0;
  for (std::size_t i = 0; i < cell.numbers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(largest, graph.value(graph.adjacency().key_of(
                                      static_cast<std::uint32_t>(cell.numbers[i]),
                                      static_cast<std::uint32_t>(cell.numbers[j]))));
  return largest;
}

TEST(EdgeCollapse, CellsHaveTheValuesOfTheirBar) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.distances(random.integer(1, 9), ties));
    const Barcode bars =
        persistence(rips, {.max_dim = 3, .field = field, .collapse = Collapse::on});
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_EQ(diameter(rips, bars.birth_cell(i)), bars[i].birth);
      if (const auto death = bars.death_cell(i)) {
        EXPECT_EQ(diameter(rips, *death), bars[i].death);
      }
    }
  });
}

/// Checks that a cycle of the collapsed complex is valid in the full complex: it has no boundary,
/// it is born at the birth of the bar, and it becomes a boundary at the death, not earlier.
template <Filtration F>
void check_cycle_by_value(const F& f, const OrderedCells<F>& cells, const Barcode& bars,
                          std::size_t i) {
  const int dim = bars[i].dim;
  const PositionChain cycle = closed_cycle(cells, bars, i);
  ASSERT_FALSE(cycle.empty());
  EXPECT_EQ(f.value(sorted_cells(f, dim)[cycle.rbegin()->first]), bars[i].birth);
  const auto cofaces = sorted_cells(f, dim + 1);
  const auto count_if = [&](auto&& enters) {
    return static_cast<std::size_t>(std::ranges::count_if(
        cofaces, [&](const auto& coface) { return enters(f.value(coface)); }));
  };
  EXPECT_FALSE(cells.is_boundary(cycle, dim, count_if([&](double v) { return v < bars[i].death; })))
      << "a boundary before its death";
  if (!bars[i].is_infinite()) {
    EXPECT_TRUE(
        cells.is_boundary(cycle, dim, count_if([&](double v) { return v <= bars[i].death; })))
        << "no boundary at its death";
  }
}

TEST(EdgeCollapse, CyclesAreThoseOfTheWholeComplex) {
  for_each_seed(900, [](Generator& random, bool ties, std::int64_t field) {
    const int max_dim = random.integer(0, 2);
    const Rips rips = random_rips(random, 8, ties);
    for (const Engine engine : {Engine::cohomology, Engine::twist}) {
      const Barcode bars = persistence(rips, {.max_dim = max_dim,
                                              .field = field,
                                              .engine = engine,
                                              .collapse = Collapse::on,
                                              .representatives = Representatives::cycles});
      with_rips_filtration(graph_of(rips), max_dim, [&](const auto& f) {
        const OrderedCells cells(f, max_dim + 1, field);
        for (std::size_t i = 0; i < bars.size(); ++i) check_cycle_by_value(f, cells, bars, i);
      });
    }
  });
}

TEST(EdgeCollapse, KeepsWhatItMust) {
  const auto kept = [](const Rips& rips) { return collapse_edges(all_edges(rips)).edge_count(); };
  // A full simplex collapses to a tree, whatever the lengths of the edges are.
  EXPECT_EQ(kept(Rips(DistanceMatrix(9, std::vector<double>(36, 1.0)))), 8U);
  EXPECT_EQ(kept(Rips(DistanceMatrix(3, {1, 2, 3}))), 2U);
  // In a square with diagonals, the first diagonal fills the hole, and the second changes nothing.
  EXPECT_EQ(kept(Rips(circle(4), {.threshold = 2.5})), 5U);
  // A graph without triangles does not collapse. The flag complexes of the cross-polytopes, which
  // are spheres, do not collapse either.
  EXPECT_EQ(kept(Rips(circle(9), {.threshold = chord(9, 1) * 1.01})), 9U);
  std::vector<WeightedEdge> octahedron;
  for (Index u = 0; u < 6; ++u)
    for (Index v = 0; v < u; ++v)
      if (u / 2 != v / 2) octahedron.push_back({u, v, 1});
  EXPECT_EQ(kept(Rips(SparseDistances(6, octahedron))), 12U);
  // The edge that closes a triangle is dominated at once if the third vertex is joined to both of
  // its ends.
  EXPECT_EQ(kept(Rips(SparseDistances(4, {{0, 1, 1}, {0, 2, 1}, {1, 2, 2}, {2, 3, 5}}))), 3U);
  for (const Index n : {0, 1, 2}) EXPECT_LE(kept(Rips(to_points(PointMatrix::Random(n, 2)))), 1U);
}

/// The points in a file; nothing if the file is missing.
std::optional<Points> points_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream numbers(line);
    auto& row = rows.emplace_back();
    for (double x; numbers >> x;) row.push_back(x);
  }
  if (rows.empty()) return std::nullopt;
  Points points(static_cast<Index>(rows.size()), static_cast<Index>(rows[0].size()));
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      points(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return points;
}

TEST(EdgeCollapse, CountsOfTestData) {
  const auto folder = test_data("data");
  if (folder.empty()) GTEST_SKIP() << no_test_data("data");
  const auto orthogonal = points_of(folder / "o3_1024.txt");
  const auto klein = points_of(folder / "klein_400.txt");
  if (!orthogonal || !klein) GTEST_SKIP() << "skipped: o3_1024.txt or klein_400.txt is missing";
  const Rips o3(*orthogonal, {.threshold = 1.8});
  EXPECT_EQ(all_edges(o3).edge_count(), 33189U);
  EXPECT_EQ(collapse_edges(all_edges(o3)).edge_count(), 7227U);
  const Rips bottle(*klein);
  EXPECT_EQ(all_edges(bottle).edge_count(), 66799U);
  EXPECT_EQ(collapse_edges(all_edges(bottle)).edge_count(), 1830U);
}

TEST(EdgeCollapse, RefusesWhatItWouldSpoil) {
  const Rips rips(circle(6));
  expect_error(ErrorKind::usage, "length zero",
               [&] { persistence(rips, {.collapse = Collapse::on, .min_persistence = -1}); });
  expect_error(ErrorKind::usage, "cocycles", [&] {
    persistence(rips, {.collapse = Collapse::on, .representatives = Representatives::cocycles});
  });
  expect_error(ErrorKind::usage, "Rips", [&] {
    persistence(Cubical(Image{{2}, {1, 2}}), {.collapse = Collapse::on});
  });
}

TEST(EdgeCollapse, StopsWhenAsked) {
  Generator random(1);
  const Rips rips(random.points(150, 3, false));
  for (const CollapseLayout layout : {CollapseLayout::rows, CollapseLayout::lists}) {
    StoppedContext context;
    expect_error(ErrorKind::cancelled, "",
                 [&] { collapse_edges(all_edges(rips), context, layout); });
  }
}

TEST(EdgeCollapse, KeepsToTheMemoryLimit) {
  Generator random(1);
  const Rips rips(random.points(100, 3, false));
  for (const CollapseLayout layout : {CollapseLayout::rows, CollapseLayout::lists}) {
    LimitedContext context(20000);
    expect_error(ErrorKind::resource, "memory limit",
                 [&] { collapse_edges(all_edges(rips), context, layout); });
    EXPECT_EQ(context.memory.used(), 0U);
  }
}

TEST(EdgeCollapse, TheSampleTellsSpheresFromSolids) {
  EXPECT_EQ(dominated_share(all_edges(Rips(Points(0, 2)))), 0);
  EXPECT_EQ(dominated_share(all_edges(Rips(DistanceMatrix(9, std::vector<double>(36, 1.0))))), 1);
  EXPECT_EQ(dominated_share(all_edges(Rips(circle(9), {.threshold = chord(9, 1) * 1.01}))), 0);
  Generator random(3);
  const Points solid = random.points(300, 2, false);
  EXPECT_GT(dominated_share(all_edges(Rips(solid))), 0.8);
  EXPECT_LT(dominated_share(all_edges(Rips(random.distances(100, false)))), 0.3);
}

}  // namespace
}  // namespace ph::test
