// SPDX-License-Identifier: MIT
// Tests the function persistence(): its options and engines, estimates, and a filtration defined by
// the user.
#include "ph/estimate.hpp"

#include "ph/detail/rips/edge_collapse.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"
#include "tests/support/rips_graphs.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;

TEST(Options, MakeSenseOrAreRefused) {
  const Rips rips(circle(5));
  const Cubical cubical(Image{{3}, {0, 2, 1}});
  const ExplicitComplex complex = all_at_once(torus_of_seven_vertices());
  const auto refuse = [&](const std::string& what, const Options& options) {
    for (const AnyComplex& any : {AnyComplex(rips), AnyComplex(cubical), AnyComplex(complex)}) {
      expect_error(ErrorKind::usage, what, [&] { persistence(any, options); });
      expect_error(ErrorKind::usage, what, [&] { plan(any, options); });
      expect_error(ErrorKind::usage, what, [&] { estimate(any, options); });
    }
  };
  refuse("found -1", {.max_dim = -1});
  refuse("found 4", {.field = 4});
  refuse("found 0", {.field = 0});
  refuse("found -2", {.field = -2});
  refuse("found 2147483648", {.field = std::int64_t{1} << 31});
  refuse("engine union-find: cannot compute homology of this complex up to dimension 1",
         {.max_dim = 1, .engine = Engine::union_find});

  const ExplicitComplex unsigned_edge =
      ExplicitComplex::from_boundary({{0, 0, 1}, {0, 0, 0, 2}, {0, 1}, {}, {}});
  const auto refuse_of = [](const AnyComplex& any, const std::string& what,
                            const Options& options) {
    expect_error(ErrorKind::usage, what, [&] { persistence(any, options); });
    expect_error(ErrorKind::usage, what, [&] { plan(any, options); });
    expect_error(ErrorKind::usage, what, [&] { estimate(any, options); });
  };
  refuse_of(unsigned_edge, "field 3: this boundary matrix has no incidence numbers", {.field = 3});
  for (const AnyComplex& any : {AnyComplex(cubical), AnyComplex(complex)})
    refuse_of(any, "edge collapse is for Rips complexes only", {.collapse = Collapse::on});
}

TEST(FirstDifference, DoesNotDependOnTheOrder) {
  const auto bars = [](const std::vector<Bar>& all) {
    Barcode barcode;
    for (const Bar& bar : all) barcode.add(bar, {}, {});
    return barcode;
  };
  const Barcode some = bars({{1, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  EXPECT_EQ(first_difference(some, bars({{0, 0, 1}, {1, 0, 1}, {0, 0, 1}})), "");
  EXPECT_EQ(first_difference(some, bars({{0, 0, 1}, {1, 0, 1}})),
            "H0 [0, 1) is in the first barcode only");
  EXPECT_EQ(first_difference(bars({{0, 0, 1}}), some), "H0 [0, 1) is in the second barcode only");
  EXPECT_EQ(first_difference(bars({{1, 0, 1}}), bars({{1, 0, 2}})),
            "H1 [0, 1) is in the first barcode only");
}

TEST(Options, DefaultDimensions) {
  EXPECT_EQ(persistence(Rips(circle(6))).bars(1).size(), 1U) << "H1 of points";
  const Cubical shell(Image{{3, 3}, {0, 0, 0, 0, kInf, 0, 0, 0, 0}});
  EXPECT_EQ(betti_at_the_end(persistence(shell), 2), (std::vector<int>{1, 1, 0}));
  const ExplicitComplex sphere = all_at_once(cross_polytope(3));
  EXPECT_EQ(betti_at_the_end(persistence(sphere), 3), (std::vector<int>{1, 0, 0, 1}));
  for (const int max_dim : {3, 4, 1000, INT_MAX})
    EXPECT_EQ(persistence(sphere, {.max_dim = max_dim}).bars(3).size(), 1U);
}

TEST(Options, MinPersistenceIsExclusive) {
  const ExplicitComplex complex = [] {
    const std::vector<double> values{0, 5, 1, 3, 3};
    const std::vector<WeightedEdge> path{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 4, 0}};
    return lower_star(path, values);
  }();
  const auto count = [&](double least) {
    return persistence(complex, {.min_persistence = least}).size();
  };
  EXPECT_EQ(count(-1), 5U) << "zero-length bars too";
  EXPECT_EQ(count(0), 2U);
  EXPECT_EQ(count(3.9), 2U);
  EXPECT_EQ(count(4), 1U);
  EXPECT_EQ(count(kInf), 1U) << "infinite bars stay";
}

// Bars over different fields differ only if the homology has torsion. All large primes give the
// same bars.
TEST(Options, LargeCharacteristics) {
  const ExplicitComplex klein = vertex_by_vertex(klein_bottle());
  check(klein, 2, {65537, 2147483647});
  EXPECT_EQ(bars_of(persistence(klein, {.field = 2147483647})),
            bars_of(persistence(klein, {.field = 3})));
}

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const auto& engine : detail::engine_facts()) {
    EXPECT_TRUE(names.insert(engine.id.name()).second);
    EXPECT_EQ(engine_named(engine.id.name()), engine.id);
    EXPECT_EQ(&facts_of(engine.id), &engine);
  }
  EXPECT_GE(names.size(), 4U);
  EXPECT_EQ(engine_named("auto"), Engine::automatic);
  EXPECT_EQ(Engine::automatic.name(), "auto");
  EXPECT_EQ(engine_named("lens"), Engine::edge_links);
  EXPECT_EQ(engine_named("arrows"), Engine::gradient);
  EXPECT_EQ(engine_named("union_find"), Engine::union_find);
  EXPECT_EQ(engine_named("ripser"), std::nullopt);
  expect_error(ErrorKind::usage, "ripser", [] { facts_of(Engine("ripser")); });
  EXPECT_EQ(engine_named(""), std::nullopt);
}

// ---- estimates

template <class F>
std::vector<double> count_cells(const F& f, int top) {
  std::vector<double> cells;
  for (int dim = 0; dim <= std::min(top, f.top_dim()); ++dim) {
    cells.push_back(0);
    f.for_each_cell(dim, [&](const auto&) { ++cells.back(); });
  }
  while (!cells.empty() && cells.back() == 0) cells.pop_back();
  return cells;
}

TEST(Estimates, CountTheCells) {
  for_each_seed(50, [&](Generator& random) {
    const Cubical cubical(random.image({3, 4}, true), random.cubical_options(2));
    const auto with_twist = [&](int max_dim) {
      return estimate(cubical, {.max_dim = max_dim, .engine = Engine::twist}).cells;
    };
    EXPECT_EQ(with_twist(2), count_cells(cubical, 2));
    EXPECT_EQ(with_twist(0), count_cells(cubical, 1));
    EXPECT_TRUE(estimate(cubical).cells.empty());  // the engine lists no cells
    const auto complex = ExplicitComplex::from_simplices(random.simplices(7, 3, 6, true));
    EXPECT_EQ(estimate(complex).cells, count_cells(complex, 3));

    const Rips rips(random.sparse(random.integer(0, 12), true, random.real()));
    for (const auto& [engine, top] : {std::pair(Engine::cohomology, 2), {Engine::twist, 3}}) {
      const Estimate e =
          estimate(rips, {.max_dim = 2, .engine = engine, .collapse = Collapse::off});
      with_all_edges(rips, 2, [&](const auto& f) { EXPECT_EQ(e.cells, count_cells(f, top)); });
      EXPECT_EQ(e.counted_dims, static_cast<int>(e.cells.size()));
      EXPECT_GE(e.bytes_high, e.bytes_low);
      EXPECT_GE(e.bytes_low, 0);
    }
  });
  const Rips full(DistanceMatrix(6, std::vector<double>(15, 1.0)));
  EXPECT_EQ(
      estimate(full, {.max_dim = 3, .engine = Engine::cohomology, .collapse = Collapse::off}).cells,
      (std::vector<double>{6, 15, 20, 15}));
}

TEST(Estimates, SampleTheCellsWhereTheyAreMany) {
  Generator random(7);
  const auto check_sample = [](const Rips& rips, int max_dim) {
    const Estimate e = estimate(
        rips, {.max_dim = max_dim, .engine = Engine::cohomology, .collapse = Collapse::off});
    EXPECT_LT(e.counted_dims, static_cast<int>(e.cells.size()));
    with_all_edges(rips, max_dim, [&](const auto& f) {
      const auto exact = count_cells(f, max_dim);
      ASSERT_EQ(e.cells.size(), exact.size());
      for (std::size_t dim = 0; dim < exact.size(); ++dim) {
        EXPECT_LE(std::abs(e.cells[dim] - exact[dim]), 0.1 * exact[dim]) << dim;
        if (static_cast<int>(dim) < e.counted_dims) {
          EXPECT_EQ(e.cells[dim], exact[dim]);
        }
      }
    });
  };
  check_sample(Rips(random.points(140, 3, false)), 3);  // most pairs are edges
  check_sample(Rips(random.points(1500, 2, false), {.threshold = 0.11}), 3);  // few pairs are edges
  check_sample(Rips(DistanceMatrix(30, std::vector<double>(435, 1.0))), 6);
}

// The memory that a computation takes lies in the predicted interval. This is tested for engines
// with and without lists of cells, for points and for distance matrices.
TEST(Estimates, HoldThePeak) {
  Generator random(11);
  const auto check_peak = [](const auto& input, const Options& options) {
    RunContext context;
    context.threads = 1;
    const Rips rips(input, {}, context);
    const Estimate e = estimate(rips, options, context);
    RunContext own;
    own.threads = 1;
    const Rips again(input, {}, own);
    persistence(again, options, own);
    const auto peak = static_cast<double>(own.memory.peak());
    EXPECT_GE(peak, 0.9 * e.bytes_low) << e.options.engine.name();
    EXPECT_LE(peak, e.bytes_high) << e.options.engine.name();
  };
  const Points cloud = random.points(100, 3, false);
  const DistanceMatrix noise = random.distances(60, false);
  for (const Engine engine :
       {Engine::automatic, Engine::edge_links, Engine::cohomology, Engine::twist}) {
    for (const int max_dim : {1, 2}) {
      if (engine == Engine::twist && max_dim == 2) continue;
      check_peak(cloud, {.max_dim = max_dim, .engine = engine});
      check_peak(noise, {.max_dim = max_dim, .engine = engine, .collapse = Collapse::off});
    }
  }
  // Here the columns need far more memory than the fixed allowance.
  check_peak(random.distances(140, false),
             {.max_dim = 2, .engine = Engine::cohomology, .collapse = Collapse::off});
}

TEST(Estimates, NameTheEngineThatWillRun) {
  const Rips rips(circle(6));
  EXPECT_EQ(estimate(rips).options.engine, Engine::edge_links);
  EXPECT_EQ(estimate(rips, {.max_dim = 2}).options.engine, Engine::edge_links);
  EXPECT_EQ(estimate(rips, {.max_dim = 3}).options.engine, Engine::edge_links);
  EXPECT_EQ(estimate(rips, {.max_dim = 4}).options.engine, Engine::cohomology);
  EXPECT_EQ(*estimate(rips).options.max_dim, 1);
  EXPECT_EQ(estimate(rips, {.max_dim = 0}).options.engine, Engine::union_find);
  EXPECT_EQ(estimate(rips, {.engine = Engine::standard}).options.engine, Engine::standard);
  EXPECT_FALSE(estimate(rips).reason.empty());
  EXPECT_EQ(*estimate(rips, {.max_dim = 100, .collapse = Collapse::off}).options.max_dim, 4)
      << "a triangle short of six: 5 vertices";
  const ExplicitComplex torus = all_at_once(torus_of_seven_vertices());
  EXPECT_EQ(*estimate(torus).options.max_dim, 2);
  expect_error(ErrorKind::usage, "found -1", [&] { estimate(rips, {.max_dim = -1}); });
  expect_error(ErrorKind::usage, "union-find",
               [&] { estimate(torus, {.engine = Engine::union_find}); });
}

TEST(Estimates, SayWhetherEdgesAreCollapsed) {
  Generator random(3);
  const Rips solid(random.points(60, 2, false)), ring(circle(12));
  const auto says = [](const Rips& rips, const Options& options, bool collapses,
                       const std::string& reason) {
    const Estimate e = estimate(rips, options);
    EXPECT_EQ(e.options.collapse == Collapse::on, collapses) << e.collapse_reason;
    EXPECT_NE(e.collapse_reason.find(reason), std::string::npos) << e.collapse_reason;
    EXPECT_GE(e.bytes_high, e.bytes_low);
    return e;
  };
  const Estimate e =
      says(solid, {.max_dim = 2, .engine = Engine::cohomology}, true, "% of a sample");
  EXPECT_EQ(e.options.engine, Engine::cohomology);
  EXPECT_EQ(
      e.cells,
      count_cells(RipsFiltration<RipsLayout::sparse, 1>(collapse_edges(all_edges(solid))), 2));
  EXPECT_LT(e.cells[1], static_cast<double>(all_edges(solid).edge_count()));
  says(ring, {.max_dim = 2, .engine = Engine::cohomology}, false, "% of a sample");
  says(ring, {.max_dim = 2, .collapse = Collapse::on}, true, "requested");
  says(solid, {.max_dim = 2, .collapse = Collapse::off}, false, "requested");
  says(solid, {}, false, "looks only at edges");
  says(solid, {.max_dim = 2, .engine = Engine::standard}, false, "reference engine");
  says(solid, {.max_dim = 2, .engine = Engine::cohomology, .min_persistence = -1}, false,
       "length zero");
  says(solid,
       {.max_dim = 2, .engine = Engine::cohomology, .representatives = Representatives::cocycles},
       false, "cocycles");
  EXPECT_EQ(estimate(Cubical(Image{{2}, {1, 2}})).collapse_reason, "");
}

TEST(Estimates, OfNothing) {
  for (const AnyComplex& nothing : {AnyComplex(Rips(Points(0, 2))), AnyComplex(Cubical(Image{})),
                                    AnyComplex(ExplicitComplex::from_simplices({}))}) {
    const Estimate e = estimate(nothing);
    EXPECT_LE(e.bytes_high, 5 << 20);  // memory for the code and the allocator
    for (const double count : e.cells) EXPECT_EQ(count, 0);
  }
}

// ---- a filtration of the user's own, with facets only

/// The boundary of a square with 4 vertices and 4 edges. Vertex i enters at i. Edge i joins i to i
/// + 1 and enters at 10 + i. With `filled`, the square itself enters at 20.
struct Square {
  using Cell = int;
  bool filled = false;

  int top_dim() const { return filled ? 2 : 1; }
  double value(Cell c) const { return c < 10 ? c : c < 20 ? c : 20; }
  bool precedes(Cell a, Cell b) const { return a < b; }
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim > top_dim()) return;
    if (dim == 2) visit(20);
    // Cells may be visited in any order.
    for (int i = 3; dim < 2 && i >= 0; --i) visit(10 * dim + i);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell c, Visit&& visit) const {
    if (dim == 1) {
      visit((c - 10 + 1) % 4, 1);
      visit(c - 10, -1);
    }
    if (dim == 2)
      for (int i = 0; i < 4; ++i) visit(10 + i, 1);
  }
  CellKind cell_kind() const { return CellKind::row; }
  void append_input_cell(int, Cell c, std::vector<Index>& numbers) const { numbers.push_back(c); }
};
static_assert(Filtration<Square> && !CofacetFiltration<Square> && !GraphFiltration<Square>);

TEST(UserFiltrations, FacetsAreEnough) {
  for (const bool filled : {false, true}) {
    const Square square{filled};
    check(square, 2);
    const Barcode barcode = persistence(square, {.field = 3});
    EXPECT_EQ(bars_of(barcode),
              (std::vector<Bar>{
                  {0, 0, kInf}, {0, 1, 10}, {0, 2, 11}, {0, 3, 12}, {1, 13, filled ? 20 : kInf}}));
    EXPECT_EQ(barcode.birth_cell(4).numbers[0], 13);
  }
}

TEST(UserFiltrations, EnginesThatNeedMoreSaySo) {
  expect_error(ErrorKind::usage, "engine cohomology: cannot",
               [] { persistence(Square{}, {.engine = Engine::cohomology}); });
  expect_error(ErrorKind::usage, "engine union-find: cannot",
               [] { persistence(Square{}, {.max_dim = 0, .engine = Engine::union_find}); });
}

/// The same square with cofacets. It visits cofacets in the worst order, which is allowed because
/// first_equal_cofacet_is_oldest is false.
struct SquareWithCofacets : Square {
  static constexpr bool first_equal_cofacet_is_oldest = false;
  unsigned key(Cell c) const { return static_cast<unsigned>(value(c)); }
  template <class Visit>
  void for_each_cofacet(int dim, Cell c, Visit&& visit) const {
    if (dim == 0 && visit(10 + c, -1)) visit(10 + (c + 3) % 4, 1);
    if (dim == 1 && filled) visit(20, 1);
  }
};
static_assert(CofacetFiltration<SquareWithCofacets>);

TEST(UserFiltrations, CofacetsInAnyOrder) {
  for (const bool filled : {false, true}) check(SquareWithCofacets{{filled}}, 2);
}

/// Simplices with value 0, numbered from 0 in each dimension. As the contract allows, the number of
/// a cell is unique only within its dimension.
class NumberedByDimension {
 public:
  using Cell = unsigned;
  static constexpr bool first_equal_cofacet_is_oldest = true;

  explicit NumberedByDimension(const Simplices& space) {
    for (const auto& simplex : space) {
      for (unsigned mask = 1; mask < (1U << simplex.size()); ++mask) {
        std::vector<Index> face;
        for (std::size_t k = 0; k < simplex.size(); ++k)
          if (mask >> k & 1) face.push_back(simplex[k]);
        std::sort(face.begin(), face.end());
        cells_.resize(std::max(cells_.size(), face.size()));
        auto& same = cells_[face.size() - 1];
        if (std::ranges::find(same, face) == same.end()) same.push_back(face);
      }
    }
  }
  int top_dim() const { return static_cast<int>(cells_.size()) - 1; }
  double value(Cell) const { return 0; }
  unsigned key(Cell) const { return 0; }
  bool precedes(Cell a, Cell b) const { return a < b; }
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim > top_dim()) return;
    for (Cell c = 0; c < of(dim).size(); ++c) visit(c);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell c, Visit&& visit) const {
    for (std::size_t k = 0; dim > 0 && k <= static_cast<std::size_t>(dim); ++k) {
      auto facet = of(dim)[c];
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
      visit(static_cast<Cell>(std::ranges::find(of(dim - 1), facet) - of(dim - 1).begin()),
            k % 2 == 0 ? 1 : -1);
    }
  }
  template <class Visit>
  void for_each_cofacet(int dim, Cell c, Visit&& visit) const {
    bool go_on = dim < top_dim();
    for (Cell larger = 0; go_on && larger < of(dim + 1).size(); ++larger) {
      for_each_facet(dim + 1, larger, [&](Cell facet, int incidence) {
        if (facet == c && go_on) go_on = visit(larger, incidence);
      });
    }
  }
  CellKind cell_kind() const { return CellKind::vertices; }
  void append_input_cell(int dim, Cell c, std::vector<Index>& numbers) const {
    numbers.insert(numbers.end(), of(dim)[c].begin(), of(dim)[c].end());
  }

 private:
  const std::vector<std::vector<Index>>& of(int dim) const {
    return cells_[static_cast<std::size_t>(dim)];
  }
  // For each dimension, the ascending vertices of each cell.
  std::vector<std::vector<std::vector<Index>>> cells_;
};
static_assert(CofacetFiltration<NumberedByDimension>);

/// The same filtration without cofacets, so all pairs must be found by a reduction.
struct FacetsOnly : private NumberedByDimension {
  using Cell = unsigned;
  using NumberedByDimension::append_input_cell, NumberedByDimension::cell_kind,
      NumberedByDimension::for_each_cell, NumberedByDimension::for_each_facet,
      NumberedByDimension::NumberedByDimension, NumberedByDimension::precedes,
      NumberedByDimension::top_dim, NumberedByDimension::value;
};
static_assert(Filtration<FacetsOnly> && !CofacetFiltration<FacetsOnly>);

TEST(UserFiltrations, CellsNeedOnlyBeUniqueInTheirDimension) {
  for (const Simplices& space : {torus_of_seven_vertices(), projective_plane(), klein_bottle(),
                                 suspension(projective_plane()), cross_polytope(3)}) {
    const NumberedByDimension f(space);
    check(f, f.top_dim());
    check(FacetsOnly(space), f.top_dim());
    for (const std::int64_t field : {2, 3}) {
      EXPECT_EQ(betti_at_the_end(persistence(f, {.field = field}), f.top_dim()),
                betti_at_the_end(persistence(all_at_once(space), {.field = field}), f.top_dim()));
    }
  }
}

}  // namespace
}  // namespace ph::test
