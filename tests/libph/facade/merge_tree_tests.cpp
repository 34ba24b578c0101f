// SPDX-License-Identifier: MIT
// Compares merge trees of H0 with brute force and with the oracle.
#include "ph/merge_tree.hpp"

#include <numeric>

#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/persistence.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;

// The connected components of a graph, computed by flood fill. Each component is named by its
// oldest vertex.
std::vector<Index> flooded(const std::vector<double>& births,
                           const std::vector<WeightedEdge>& edges, double value) {
  const auto n = births.size();
  std::vector<Index> component(n, -1);
  std::vector<std::size_t> by_age(n);
  std::iota(by_age.begin(), by_age.end(), std::size_t{0});
  std::stable_sort(by_age.begin(), by_age.end(),
                   [&](std::size_t a, std::size_t b) { return births[a] < births[b]; });
  for (const std::size_t root : by_age) {
    if (component[root] >= 0 || !(births[root] <= value) || births[root] == kInf) continue;
    std::vector<std::size_t> todo{root};
    component[root] = static_cast<Index>(root);
    while (!todo.empty()) {
      const auto v = static_cast<Index>(todo.back());
      todo.pop_back();
      for (const WeightedEdge& e : edges) {
        if (e.value > value || (e.u != v && e.v != v)) continue;
        const auto w = static_cast<std::size_t>(e.u == v ? e.v : e.u);
        if (component[w] >= 0) continue;
        component[w] = static_cast<Index>(root);
        todo.push_back(w);
      }
    }
  }
  return component;
}

// Checks everything that a merge tree promises, for a graph whose vertices have births.
void check_tree(const MergeTree& tree, const std::vector<double>& births,
                const std::vector<WeightedEdge>& edges, const Barcode& oracle) {
  ASSERT_EQ(tree.births, births);
  std::vector<double> values{-kInf, kInf};
  for (const double b : births) values.push_back(b);
  std::vector<std::pair<double, double>> bars;
  std::vector<Index> size(births.size(), 1);
  for (std::size_t i = 0; i < tree.merges.size(); ++i) {
    const Merge& m = tree.merges[i];
    values.push_back(m.value);
    if (i > 0) {
      EXPECT_GE(m.value, tree.merges[i - 1].value);
    }
    const auto elder = static_cast<std::size_t>(m.elder),
               younger = static_cast<std::size_t>(m.younger);
    EXPECT_TRUE(m.elder_birth < m.younger_birth ||
                (m.elder_birth == m.younger_birth && m.elder < m.younger));
    EXPECT_EQ(m.elder_birth, births[elder]);
    EXPECT_EQ(m.younger_birth, births[younger]);
    EXPECT_EQ(m.elder_size, size[elder]);
    EXPECT_EQ(m.younger_size, size[younger]);
    size[elder] += size[younger];
    size[younger] = 0;
    const bool is_edge = std::ranges::any_of(edges, [&](const WeightedEdge& e) {
      return e.value == m.value && ((e.u == m.u && e.v == m.v) || (e.u == m.v && e.v == m.u));
    });
    EXPECT_TRUE(is_edge) << m.u << " " << m.v << " at " << m.value;
    bars.emplace_back(m.younger_birth, m.value);
  }
  for (const double value : values)
    EXPECT_EQ(tree.components(value), flooded(births, edges, value));
  // The merges correspond to the finite bars of H0.
  std::vector<std::pair<double, double>> finite;
  for (const auto& bar : intervals(oracle, 0))
    if (bar.second < kInf) finite.push_back(bar);
  std::sort(bars.begin(), bars.end());
  EXPECT_EQ(bars, finite);
  // There is one class for each bar, in the order of the bars.
  const std::vector<MergeTree::Class> classes = tree.classes();
  ASSERT_EQ(classes.size(), oracle.bars(0).size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto& [birth, death, vertex, merge] = classes[i];
    EXPECT_EQ((Bar{0, birth, death}), oracle[i]);
    if (oracle.cell_kind() == CellKind::vertices) {  // for images, cells are coordinates instead
      EXPECT_EQ(vertex, oracle.birth_cell(i).numbers[0]);
    }
    if (merge < 0) {
      EXPECT_EQ(death, kInf);
    } else {
      EXPECT_EQ(tree.merges[static_cast<std::size_t>(merge)].younger, vertex);
      EXPECT_EQ(tree.merges[static_cast<std::size_t>(merge)].value, death);
    }
  }
  // There is one branch for each class. A branch that dies joins another branch that is at least as
  // old and dies no sooner.
  const std::vector<Branch> branches = tree.branches();
  std::vector<std::pair<double, double>> ends, all;
  for (const auto& c : classes) all.emplace_back(c.birth, c.death);
  for (const Branch& branch : branches) {
    ends.emplace_back(branch.birth, branch.death);
    if (branch.is_infinite()) continue;
    const Branch& elder = branches[static_cast<std::size_t>(branch.elder)];
    EXPECT_LE(elder.birth, branch.birth);
    EXPECT_GE(elder.death, branch.death);
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_EQ(ends, all);
}

template <class Complex>
Barcode oracle_of(const Complex& complex) {
  return persistence(complex, {.max_dim = 0, .engine = Engine::standard, .min_persistence = -1});
}

TEST(MergeTrees, OfPoints) {
  for_each_seed(200, [&](Generator& random) {
    const Points points = random.points(random.integer(0, 14), 2, random.coin());
    const Rips rips(points);
    std::vector<WeightedEdge> edges;
    const PointMetric metric(points);
    for (Index i = 0; i < points.rows(); ++i)
      for (Index j = i + 1; j < points.rows(); ++j)
        if (metric(i, j) <= all_edges(rips).threshold()) edges.push_back({i, j, metric(i, j)});
    const std::vector<double> births(static_cast<std::size_t>(points.rows()), 0.0);
    check_tree(merge_tree(rips), births, edges, oracle_of(rips));
  });
}

TEST(MergeTrees, OfGraphs) {
  for_each_seed(200, [&](Generator& random) {
    const SparseDistances graph = random.sparse(random.integer(0, 12), random.coin(), 0.2);
    std::vector<double> births(static_cast<std::size_t>(graph.size()));
    for (double& b : births) b = random.value(true);
    std::vector<WeightedEdge> edges = graph.edges();
    for (WeightedEdge& e : edges)
      e.value =
          std::max(births[static_cast<std::size_t>(e.u)], births[static_cast<std::size_t>(e.v)]);
    const ExplicitComplex complex = lower_star(graph.edges(), births);
    check_tree(merge_tree(complex), births, edges, oracle_of(complex));
    const FilteredGraph alone(births, edges);
    check_tree(merge_tree(alone), births, edges, oracle_of(alone));
  });
}

// Voxels that never enter keep their numbers.
TEST(MergeTrees, OfImages) {
  for_each_seed(200, [&](Generator& random) {
    const Index rows = random.integer(1, 4), columns = random.integer(1, 4);
    Image image = random.image({rows, columns}, random.coin());
    std::vector<double> births = image.values.doubles();
    if (random.coin()) births[0] = kInf;
    image.values = births;
    CubicalOptions options;
    if (random.coin()) options.threshold = 0.5;
    for (double& b : births)
      if (options.threshold && b > *options.threshold) b = kInf;
    std::vector<WeightedEdge> edges;
    const auto join = [&](Index a, Index b) {
      const double value =
          std::max(births[static_cast<std::size_t>(a)], births[static_cast<std::size_t>(b)]);
      if (value < kInf) edges.push_back({a, b, value});
    };
    for (Index i = 0; i < rows; ++i) {
      for (Index j = 0; j < columns; ++j) {
        if (i + 1 < rows) join(i * columns + j, (i + 1) * columns + j);
        if (j + 1 < columns) join(i * columns + j, i * columns + j + 1);
      }
    }
    const Cubical cubical(image, options);
    check_tree(merge_tree(cubical), births, edges, oracle_of(cubical));
  });
}

TEST(MergeTrees, CornersOfTheOtherConstruction) {
  const Cubical cells(Image{{3}, {0, 5, 1}}, {.construction = CubicalOptions::Construction::cells});
  const MergeTree tree = merge_tree(cells);
  EXPECT_EQ(tree.births, (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(tree.components(1), (std::vector<Index>{0, 0, 2, 2}));
  EXPECT_EQ(tree.components(5), (std::vector<Index>{0, 0, 0, 0}));
}

// The weight of a minimum spanning tree, by Prim's algorithm on all pairs.
double spanning_weight(const Points& points) {
  const PointMetric metric(points);
  std::vector<double> nearest(static_cast<std::size_t>(points.rows()), kInf);
  std::vector<bool> done(nearest.size(), false);
  double weight = 0;
  Index next = 0;
  for (Index step = 1; step < points.rows(); ++step) {
    done[static_cast<std::size_t>(next)] = true;
    Index best = -1;
    for (Index i = 0; i < points.rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (done[at]) continue;
      nearest[at] = std::min(nearest[at], metric(next, i));
      if (best < 0 || nearest[at] < nearest[static_cast<std::size_t>(best)]) best = i;
    }
    weight += nearest[static_cast<std::size_t>(best)];
    next = best;
  }
  return weight;
}

TEST(MergeTrees, ThePointsEdgesAreAMinimumSpanningTree) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Generator random(seed);
    const Points points =
        random.points(random.integer(2, 120), random.integer(1, 4), seed % 2 == 0);
    double weight = 0;
    const MergeTree tree = merge_tree(Rips(points));
    EXPECT_EQ(tree.merges.size(), static_cast<std::size_t>(points.rows() - 1));
    for (const Merge& m : tree.merges) {
      EXPECT_EQ(m.value, PointMetric(points)(m.u, m.v));
      weight += m.value;
    }
    EXPECT_NEAR(weight, spanning_weight(points), 1e-9);
  }
}

TEST(MergeTrees, LinkageNumbersClustersAsTheyAreMade) {
  const Points points{{0}, {1}, {10}, {12}, {1.5}, {30}};
  const auto rows = linkage(merge_tree(Rips(points)));
  EXPECT_EQ(rows, (std::vector<LinkageRow>{
                      {1, 4, 0.5, 2}, {0, 6, 1, 3}, {2, 3, 2, 2}, {7, 8, 8.5, 5}, {5, 9, 18, 6}}));
  EXPECT_EQ(linkage(merge_tree(Rips(points, {.threshold = 1}))),
            std::vector<LinkageRow>(rows.begin(), rows.begin() + 2));
}

TEST(MergeTrees, ASpanningForestGivesTheSameTree) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Generator random(seed);
    const Points points = random.points(random.integer(0, 20), random.integer(1, 3), random.coin());
    RipsOptions options;
    if (random.coin()) options.threshold = random.value(true);
    const Rips rips(points, options);
    const RipsGraph& edges = all_edges(rips);
    std::vector<WeightedEdge> listed;
    for (const FlagEdge& e : edges.edges()) listed.push_back({e.u, e.v, e.value});
    const Rips whole(
        RipsGraph::of_edges(edges.size(), listed, edges.threshold(), default_context()));
    ASSERT_FALSE(whole.has_form(RipsForm::forest));
    EXPECT_EQ(merge_tree(rips).merges, merge_tree(whole).merges) << "seed " << seed;
  }
}

TEST(MergeTrees, OfNothing) {
  EXPECT_EQ(merge_tree(Rips(Points(0, 2))).size(), 0);
  EXPECT_EQ(merge_tree(Cubical(Image{})).size(), 0);
  EXPECT_EQ(merge_tree(ExplicitComplex::from_simplices({})).size(), 0);
  EXPECT_TRUE(MergeTree{}.components(0).empty());
}

TEST(MergeTrees, AtAValueThatIsNoneNothingHasEntered) {
  const MergeTree line = merge_tree(Rips(Points{{0}, {1}, {3}, {7}, {15}}));
  EXPECT_EQ(line.components(std::numeric_limits<double>::quiet_NaN()), std::vector<Index>(5, -1));
}

// A chain that merges all vertices one after another must not take quadratic time.
TEST(MergeTrees, LongChains) {
  constexpr Index n = 300000;
  std::vector<double> births(static_cast<std::size_t>(n));
  std::vector<WeightedEdge> edges;
  for (Index i = 0; i < n; ++i) births[static_cast<std::size_t>(i)] = static_cast<double>(n - i);
  for (Index i = 0; i + 1 < n; ++i) edges.push_back({i, i + 1, 0});
  const MergeTree tree = merge_tree(lower_star(edges, births));
  const std::vector<Index> all = tree.components(kInf);
  EXPECT_EQ(std::ranges::count(all, n - 1), n);
}

TEST(MergeTrees, NeedEdgesThatJoinTwoVertices) {
  BoundaryMatrix m;
  m.dims = {0, 0, 0, 1};
  m.offsets = {0, 0, 0, 0, 3};
  m.rows = {0, 1, 2};
  const ExplicitComplex odd = ExplicitComplex::from_boundary(m);
  expect_error(ErrorKind::usage, "two vertices", [&] { merge_tree(odd); });
}

TEST(MergeTree, EqualTreesHaveEqualBirthsAndMerges) {
  const auto tree_of = [](double x, double y, double z) {
    const std::vector<double> line{x, y, z};
    return merge_tree(Rips(PointsView(line.data(), 3, 1)));
  };
  const MergeTree tree = tree_of(0, 1, 3);
  EXPECT_TRUE(tree == tree_of(0, 1, 3));
  EXPECT_FALSE(tree == tree_of(0, 1, 4));  // another value
  EXPECT_FALSE(tree == tree_of(1, 0, 3));  // another edge
  MergeTree late = tree;
  late.births[2] = 0.5;
  EXPECT_FALSE(tree == late);
}

}  // namespace
}  // namespace ph::test
