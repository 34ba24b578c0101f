// SPDX-License-Identifier: MIT
// Compares every engine with the oracle on random small filtrations, half of which have many ties.
#include <cmath>
#include <numbers>

#include "ph/detail/complex/filtered_graph.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/edge_link_pairs.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

TEST(RandomConformance, RipsOfPoints) {
  for_each_seed(4000, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random.points(random.integer(0, 10), random.integer(1, 4), ties);
    check(Rips(points), random.integer(0, 3), {field});
    check_points_alone(points, field);
  });
}

TEST(RandomConformance, RipsOfAnyMatrix) {
  for_each_seed(4000, [](Generator& random, bool ties, std::int64_t field) {
    RipsOptions options;
    if (random.coin()) options.threshold = ties ? random.integer(0, 3) : random.real();
    const Rips rips(random.distances(random.integer(0, 9), ties), options);
    check(rips, random.integer(0, 3), {field});
  });
}

TEST(RandomConformance, RipsOfSparseDistances) {
  for_each_seed(4000, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.sparse(random.integer(0, 10), ties, random.real()));
    check(rips, random.integer(0, 3), {field});
  });
}

TEST(RandomConformance, WideRipsCells) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.sparse(random.integer(1, 8), ties, 0.7));
    const int max_dim = random.integer(0, 3);
    check(RipsFiltration<RipsLayout::any, 4>(all_edges(rips)), max_dim, {field});
  });
}

/// The pairs computed by several threads. Each thread takes one column at a time.
template <class F>
std::vector<Pair> pairs_of_threads(const F& f, int max_dim, std::int64_t field, int threads,
                                   bool oldest_first = false) {
  RunContext context;
  context.threads = threads;
  BarcodeBuilder<F> bars(f, max_dim, -1);
  detail::with_field(field, [&](const auto& k) {
    using K = std::decay_t<decltype(k)>;
    CohomologyReduction<F, K> reduction(f, k, bars, context,
                                        {.piece = 1, .oldest_first = oldest_first});
    for (int dim = 0; dim <= std::min(max_dim, f.top_dim()); ++dim) reduction.reduce_dimension(dim);
  });
  return pairs_of(bars.finish());
}

TEST(RandomConformance, AnyNumberOfThreads) {
  for_each_seed(6000, [](Generator& random, bool ties, std::int64_t field) {
    const int threads = random.integer(1, 8);
    const auto check_threads = [&](const auto& f, int max_dim) {
      const auto oracle = pairs_of(f, max_dim, field, Engine::standard);
      EXPECT_EQ(pairs_of_threads(f, max_dim, field, threads), oracle);
      // In this order, every column that can lose its pivot to another column does lose it.
      EXPECT_EQ(pairs_of_threads(f, max_dim, field, 1, true), oracle);
    };
    if (random.integer(0, 9) == 0) {
      check_threads(Cubical(random.image({4, 4, 3}, ties), random.cubical_options(3)), 3);
      return;
    }
    const Index n = random.integer(3, 10);
    const int max_dim = random.integer(1, 3);
    const Rips rips = random.coin() ? Rips(random.points(n, random.integer(2, 5), ties))
                                    : Rips(random.distances(n, ties));
    with_all_edges(rips, max_dim, [&](const auto& f) { check_threads(f, max_dim); });
  });
}

// Columns are long and take each other's pivots. The bars must equal the bars from one thread,
// which runs the sequential algorithm.
TEST(RandomConformance, ThreadsOnManyColumns) {
  for_each_seed(8, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.distances(26, ties));
    with_all_edges(rips, 2, [&](const auto& f) {
      const auto alone = pairs_of_threads(f, 2, field, 1);
      EXPECT_EQ(alone, pairs_of(f, 2, field, Engine::edge_links));
      for (const int threads : {2, 3, 8}) EXPECT_EQ(pairs_of_threads(f, 2, field, threads), alone);
    });
  });
}

// If distances differ by orders of magnitude, even a few distances lie in many bins. Some bins are
// never sorted.
TEST(RandomConformance, LinkStopsWhereNothingHappens) {
  std::size_t late = 0;
  for_each_seed(20000, [&](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(4, 9);
    std::vector<WeightedEdge> edges = random.sparse(n, ties, 0.6 + random.real() / 2).edges();
    for (WeightedEdge& e : edges) e.value *= std::pow(1e60, random.integer(-2, 2));
    const Rips rips(SparseDistances(n, edges));
    with_all_edges(rips, 1, [&](const auto& f) {
      std::vector<Pair> found;
      for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists}) {
        found = pairs_of_edge_links(f, 1, field, {.layout = layout}, 0);
        EXPECT_EQ(found, of_positive_length(pairs_of(f, 1, field, Engine::standard)));
      }
      for (const Pair& p : found) late += p.bar.dim == 1 && p.bar.birth > 1e100 ? 1 : 0;
    });
  });
  EXPECT_TRUE(is_enough(late, std::size_t{1000})) << late;
}

// There are many classes, and vectors are long. As a result, generators disappear and return, and
// vectors become equal.
TEST(RandomConformance, LinkOfWideClasses) {
  for_each_seed(60, [](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.distances(random.integer(24, 34), ties));
    with_all_edges(rips, 1, [&](const auto& f) {
      const auto oracle = pairs_of(f, 1, field, Engine::standard);
      for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists})
        EXPECT_EQ(pairs_of_edge_links(f, 1, field, {.layout = layout}, -1), oracle);
    });
  });
}

// There are more vertices than bits in a word: rows have several words, and not all vertices are
// landmarks.
TEST(RandomConformance, LinkOfManyVertices) {
  for_each_seed(60, [](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(65, 200);
    const Rips rips = random.coin() ? Rips(random.points(n, random.integer(2, 4), ties))
                                    : Rips(random.sparse(n, ties, 6 * random.real() / 20));
    with_all_edges(rips, 1, [&](const auto& f) {
      const auto expected = pairs_of(f, 1, field, Engine::cohomology);
      for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists})
        for (const std::size_t active_rows : {0, 500})
          EXPECT_EQ(
              pairs_of_edge_links(f, 1, field,
                                  {.layout = layout, .vertices_of_active_rows = active_rows}, -1),
              expected);
    });
  });
}

// The limits are so low that cocycles are kept as formal sums from the start. Relations are solved
// at once or later.
TEST(RandomConformance, LinkFormally) {
  std::size_t finite = 0;
  for_each_seed(8000, [&](Generator& random, bool ties, std::int64_t) {
    const Index n = random.integer(4, random.integer(0, 9) == 0 ? 24 : 12);
    const Rips rips = random.coin() ? Rips(random.distances(n, ties))
                                    : Rips(random.sparse(n, ties, random.real()));
    with_all_edges(rips, 1, [&](const auto& f) {
      const auto oracle = pairs_of(f, 1, 2, Engine::standard);
      for (const std::size_t classes : {1, 4})
        for (const std::size_t relations : {1, 5}) {
          const SweepTuning formal{.layout = LinkLayout::rows,
                                   .classes_for_formal = classes,
                                   .relations_for_formal = relations};
          EXPECT_EQ(pairs_of_edge_links(f, 1, 2, formal, -1), oracle);
        }
      for (const Pair& p : oracle)
        finite += p.bar.dim == 1 && p.bar.persistence() > 0 && !p.death_cell.empty() ? 1 : 0;
    });
  });
  EXPECT_TRUE(is_enough(finite, std::size_t{1000})) << finite;  // the test covers enough cases
}

// Repeats the test with many classes of edges. The lists of relations turn into rows of bits more
// than once.
TEST(RandomConformance, LinkFormallyOfManyPoints) {
  for_each_seed(100, [](Generator& random, bool ties, std::int64_t) {
    const Rips rips(random.distances(random.integer(60, 150), ties));
    with_all_edges(rips, 1, [&](const auto& f) {
      const SweepTuning plain{.layout = LinkLayout::rows, .classes_for_formal = SIZE_MAX};
      const auto expected = pairs_of_edge_links(f, 1, 2, plain, -1);
      for (const std::size_t relations : {1, 50, 1000}) {
        const SweepTuning formal{.layout = LinkLayout::rows,
                                 .classes_for_formal = 20,
                                 .relations_for_formal = relations};
        EXPECT_EQ(pairs_of_edge_links(f, 1, 2, formal, -1), expected);
      }
    });
  });
}

// There are enough points for many classes of H2 to be alive at the same time. Depending on the
// limits, cocycles turn into rows of bits at once, later or never.
TEST(RandomConformance, LinkSurfaces) {
  std::size_t finite = 0;
  for_each_seed(10000, [&](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(7, random.integer(0, 9) == 0 ? 15 : 10);
    const Rips rips = [&] {
      switch (random.integer(0, 2)) {
        case 0:
          return Rips(random.points(n, random.integer(2, 5), ties));
        case 1:
          return Rips(random.distances(n, ties));
        default:
          return Rips(random.sparse(n, ties, 0.5 + random.real() / 2));
      }
    }();
    with_all_edges(rips, 2, [&](const auto& f) {
      const auto oracle = pairs_of(f, 2, field, Engine::standard);
      EXPECT_EQ(pairs_of(f, 2, field, Engine::edge_links), oracle);
      for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists}) {
        const SweepTuning rows{.layout = layout, .most_terms = 0};
        const SweepTuning both{.layout = layout, .most_terms = 1, .vertices_of_active_rows = 0};
        EXPECT_EQ(pairs_of_edge_links(f, 2, field, rows, -1), oracle);
        EXPECT_EQ(pairs_of_edge_links(f, 2, field, both, 0), of_positive_length(oracle));
      }
      for (const Pair& p : oracle) {
        finite += p.bar.dim == 2 && p.bar.persistence() > 0 && !p.death_cell.empty() ? 1 : 0;
      }
    });
  });
  EXPECT_TRUE(is_enough(finite, std::size_t{1000})) << finite;  // the test covers enough cases
}

Points random_sphere(Generator& random, Index n) {
  Points sphere(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double z = 2 * random.real() - 1, angle = 2 * std::numbers::pi * random.real();
    const double r = std::sqrt(1 - z * z);
    sphere.set_row(i, {r * std::cos(angle), r * std::sin(angle), z});
  }
  return sphere;
}

// On a sphere, there is a single cocycle, which has many triangles.
TEST(RandomConformance, LinkSurfacesOfSpheres) {
  for_each_seed(12, [](Generator& random, bool, std::int64_t field) {
    const Rips rips(random_sphere(random, 100));
    with_all_edges(rips, 2, [&](const auto& f) {
      const auto expected = pairs_of(f, 2, field, Engine::cohomology);
      for (const std::size_t most_terms : {0, 64})
        for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists})
          EXPECT_EQ(
              pairs_of_edge_links(f, 2, field, {.layout = layout, .most_terms = most_terms}, -1),
              expected);
    });
  });
}

TEST(RandomConformance, CubicalUpToThreeAxes) {
  for_each_seed(5000, [](Generator& random, bool ties, std::int64_t field) {
    std::vector<Index> extents;
    const int dim = random.integer(1, 3);
    for (int k = 0; k < dim; ++k) extents.push_back(random.integer(1, dim == 3 ? 3 : 4));
    const Cubical cubical(random.image(extents, ties), random.cubical_options(dim));
    check(cubical, random.integer(0, dim), {field});
  });
}

TEST(RandomConformance, CubicalFourCubedAndFourAxes) {
  for_each_seed(200, [](Generator& random, bool ties, std::int64_t field) {
    check(Cubical(random.image({4, 4, 4}, ties), random.cubical_options(3)), 3, {field});
    check(Cubical(random.image({2, 1, 3, 2}, ties), random.cubical_options(4)), 4, {field});
  });
}

TEST(RandomConformance, SimplicialComplexes) {
  for_each_seed(3000, [](Generator& random, bool ties, std::int64_t field) {
    const auto list = random.simplices(random.integer(4, 9), 3, random.integer(1, 12), ties);
    check(ExplicitComplex::from_simplices(list), random.integer(0, 3), {field});
  });
}

// These graphs may have edges from a vertex to itself, and parallel edges.
TEST(RandomConformance, FilteredGraphs) {
  for_each_seed(2000, [](Generator& random, bool ties, std::int64_t field) {
    std::vector<double> births(static_cast<std::size_t>(random.integer(1, 9)));
    for (double& b : births) b = random.integer(0, 19) == 0 ? -kInfinity : random.value(ties) - 1;
    std::vector<WeightedEdge> edges;
    for (int i = random.integer(0, 15); i > 0; --i) {
      const Index u = random.integer(0, static_cast<int>(births.size()) - 1);
      const Index v = random.integer(0, static_cast<int>(births.size()) - 1);
      const double born =
          std::max(births[static_cast<std::size_t>(u)], births[static_cast<std::size_t>(v)]);
      edges.push_back({u, v, std::max(born, random.value(ties) - 1)});
    }
    const FilteredGraph graph(births, edges);
    const auto oracle = pairs_of(graph, 1, field, Engine::standard);
    ASSERT_NO_FATAL_FAILURE(check_euler(graph, oracle));
    EXPECT_EQ(pairs_of(graph, 1, field, Engine::twist), oracle);
    EXPECT_EQ(pairs_of(graph, 0, field, Engine::union_find),
              pairs_of(graph, 0, field, Engine::standard));
    // The suite identifies cells by their vertices, so its graphs have no parallel edges.
    std::set<std::pair<Index, Index>> seen;
    std::erase_if(
        edges, [&](const WeightedEdge& e) { return !seen.insert(std::minmax(e.u, e.v)).second; });
    check(FilteredGraph(births, edges), random.integer(0, 1), {field});
    check(FilteredGraph::lower_star(births, edges), 1, {field});
  });
}

// The complexes are large enough for methods that pay off only for many cells.
TEST(RandomConformance, MoreCells) {
  Generator random(7);
  for (const bool ties : {true, false}) {
    check(Rips(random.points(48, 3, ties)), 1, {2, 3});
    check(Rips(random.sparse(120, ties, 0.16)), 1, {2, 3});
    check(Cubical(random.image({36, 36}, ties), random.cubical_options(2)), 2, {2});
    check(Cubical(random.image({11, 11, 11}, ties), random.cubical_options(3)), 3, {3});
  }
}

// A chain complex over Z/2 that is not a simplicial complex, with columns of any length.
TEST(RandomConformance, BoundaryMatrices) {
  for_each_seed(1000, [](Generator& random, bool ties, std::int64_t) {
    BoundaryMatrix m;
    const int vertices = random.integer(0, 6), edges = random.integer(0, 8);
    for (int i = 0; i < vertices + edges; ++i) {
      m.dims.push_back(i < vertices ? 0 : 1);
      for (int v = 0; i >= vertices && v < vertices; ++v)
        if (random.integer(0, 2) == 0) m.rows.push_back(v);
      m.offsets.push_back(m.rows.size());
      m.values.push_back(i < vertices ? 0 : 1 + random.value(ties));
    }
    check(ExplicitComplex::from_boundary(m), 1, {2});
  });
}

}  // namespace
}  // namespace ph::test
