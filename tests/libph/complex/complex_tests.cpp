// SPDX-License-Identifier: MIT
// Stored complexes: the inputs that they refuse, the error messages, and the names of their cells.
#include <algorithm>
#include <limits>

#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/known_spaces.hpp"

namespace ph::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = kInfinity;

struct Entry {
  std::vector<Index> vertices;
  double value;
};
SimplexList list_of(std::initializer_list<Entry> entries) {
  SimplexList list;
  for (const Entry& e : entries) list.add(e.vertices, e.value);
  return list;
}
void refuse(std::initializer_list<Entry> entries, const std::string& what) {
  expect_error(ErrorKind::bad_data, what,
               [&] { ExplicitComplex::from_simplices(list_of(entries)); });
}

TEST(ExplicitComplexes, RefuseBrokenSimplexLists) {
  refuse({{{0}, 0}, {{0}, 1}}, "cell 1: simplex (0) occurs twice");
  refuse({{{0}, 0}, {{1}, 0}, {{0, 1}, 0}, {{1, 0}, 0}}, "cell 3: simplex (0 1) occurs twice");
  refuse({{{0}, 0}, {{0, 0}, 1}}, "cell 1: vertex 0 occurs twice");
  refuse({{{0}, 0}, {{0, 1}, 1}}, "facet (1) is missing");
  refuse({{{0}, 0}, {{1}, 2}, {{0, 1}, 1}}, "cell 2");
  refuse({{{0}, kNan}}, "nan");
  refuse({{{}, 0}}, "without vertices");
  refuse({{{-1}, 0}}, "found vertex -1");
}

TEST(ExplicitComplexes, ErrorsNameTheCellAsTheCallerDoes) {
  const auto line = [](std::size_t i) { return "mesh.txt:" + std::to_string(i + 10); };
  expect_error(ErrorKind::bad_data, "mesh.txt:11: ", [&] {
    ExplicitComplex::from_simplices(list_of({{{0}, 0}, {{0, 0}, 1}}), line);
  });
  const std::vector<double> one{0.0};
  expect_error(ErrorKind::bad_data, "mesh.txt:10: ", [&] {
    lower_star(list_of({{{0, 1}, 0}}), one, line);
  });
}

TEST(ExplicitComplexes, AnyOrderAndAnyVertexIdsWillDo) {
  const ExplicitComplex edge = ExplicitComplex::from_simplices(
      list_of({{{1'000'000'000'000, 5}, 3}, {{1'000'000'000'000}, 1}, {{5}, 2}}));
  check(edge, 1);
  const Barcode barcode = persistence(edge);
  EXPECT_EQ(bars_of(barcode), (std::vector<Bar>{{0, 1, kInf}, {0, 2, 3}}));
  EXPECT_EQ(barcode.cell_kind(), CellKind::vertices);
  EXPECT_EQ(barcode.birth_cell(0).numbers[0], 1'000'000'000'000);
  EXPECT_EQ(barcode.death_cell(1)->numbers[0], 5) << "vertices ascend";
}

TEST(ExplicitComplexes, TheEmptyComplex) {
  const ExplicitComplex none = ExplicitComplex::from_simplices({});
  EXPECT_EQ(none.top_dim(), -1);
  check(none, 2);
  EXPECT_TRUE(persistence(none).empty());
  EXPECT_TRUE(persistence(ExplicitComplex::from_boundary({})).empty());
}

// In the oracle, cells beyond the threshold have the value infinity, so they never enter.
TEST(ExplicitComplexes, AThresholdLeavesTheSubcomplexBelowIt) {
  InputGenerator gen(RandomChoices(7));
  for (int round = 0; round < 60; ++round) {
    const SimplexList list = gen.simplices(9, 3, 14, round % 2 == 0);
    const double threshold = gen.value(round % 2 == 0);
    SimplexList below = list;
    for (double& value : below.values)
      if (value > threshold) value = kInfinity;
    const ExplicitComplex oracle = ExplicitComplex::from_simplices(below);
    ExplicitComplex complex = ExplicitComplex::from_simplices(list);
    complex.set_threshold(threshold);
    for (const double least : {-1.0, 0.0, 0.3})
      for (const Engine engine : {Engine::automatic, Engine::twist, Engine::standard}) {
        SCOPED_TRACE(testing::Message() << round << ", " << least << ", " << engine.name());
        const Options options{.field = 3, .engine = engine, .min_persistence = least};
        const Barcode expected =
            persistence(oracle, {.field = 3, .engine = Engine::standard, .min_persistence = least});
        EXPECT_EQ(first_difference(persistence(complex, options), expected), "");
        EXPECT_EQ(first_difference(run(complex, plan(complex, options)), expected), "");
      }
    const MergeTree tree = merge_tree(complex), of_oracle = merge_tree(oracle);
    EXPECT_EQ(tree.births, of_oracle.births);
    EXPECT_TRUE(
        std::ranges::equal(tree.merges, of_oracle.merges, {}, &Merge::value, &Merge::value));
    EXPECT_EQ(tree.components(kInfinity), of_oracle.components(kInfinity));
  }
  ExplicitComplex none = ExplicitComplex::from_simplices({});
  expect_error(ErrorKind::usage, "threshold: found nan", [&] { none.set_threshold(kNan); });
}

// A triangle with its boundary, stored column by column.
BoundaryMatrix triangle() {
  BoundaryMatrix m;
  m.dims = {0, 0, 0, 1, 1, 1, 2};
  m.offsets = {0, 0, 0, 0, 2, 4, 6, 9};
  m.rows = {0, 1, 0, 2, 1, 2, 3, 4, 5};
  m.incidences = {-1, 1, -1, 1, -1, 1, 1, -1, 1};
  return m;
}

TEST(ExplicitComplexes, BoundaryMatrices) {
  const ExplicitComplex complex = ExplicitComplex::from_boundary(triangle());
  EXPECT_TRUE(complex.has_incidences());
  check(complex, 2);
  const Barcode barcode = persistence(complex, {.field = 3});
  EXPECT_EQ(bars_of(barcode), (std::vector<Bar>{{0, 0, kInf}, {0, 1, 3}, {0, 2, 4}, {1, 5, 6}}));
  EXPECT_EQ(barcode.cell_kind(), CellKind::row);
  EXPECT_EQ(barcode.birth_cell(3).numbers[0], 5);
  EXPECT_EQ(barcode.death_cell(3)->numbers[0], 6);
}

TEST(ExplicitComplexes, WithoutIncidencesOnlyTwoWillDo) {
  BoundaryMatrix m = triangle();
  m.incidences.clear();
  const ExplicitComplex complex = ExplicitComplex::from_boundary(m);
  EXPECT_FALSE(complex.has_incidences());
  check(complex, 2, {2});
  EXPECT_EQ(bars_of(persistence(complex)),
            bars_of(persistence(ExplicitComplex::from_boundary(triangle()))));
  expect_error(ErrorKind::usage, "incidence", [&] { persistence(complex, {.field = 3}); });
}

// The projective plane with one cell per dimension: the 2-cell is attached twice around the loop.
TEST(ExplicitComplexes, IncidencesThatVanishOverSomeFields) {
  BoundaryMatrix m;
  m.dims = {0, 1, 2};
  m.offsets = {0, 0, 0, 1};
  m.rows = {1};
  m.incidences = {2};
  const ExplicitComplex plane = ExplicitComplex::from_boundary(m);
  check(plane, 2, {2, 3, 5});
  EXPECT_EQ(betti_at_the_end(persistence(plane, {.field = 2}), 2), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(betti_at_the_end(persistence(plane, {.field = 3}), 2), (std::vector<int>{1, 0, 0}));
}

// In a lens space L(p, q), the 2-cell is attached p times around the loop. The homology differs
// from a sphere's only over Z/p.
TEST(ExplicitComplexes, LensSpaces) {
  for (const int p : {2, 3, 5, 7}) {
    BoundaryMatrix m;
    m.dims = {0, 1, 2, 3};
    m.offsets = {0, 0, 0, 1, 1};
    m.rows = {1};
    m.incidences = {p};
    const ExplicitComplex link = ExplicitComplex::from_boundary(m);
    for (const std::int64_t field : {2, 3, 5, 7}) {
      check(link, 3, {field});
      const std::vector<int> expected =
          field == p ? std::vector<int>{1, 1, 1, 1} : std::vector<int>{1, 0, 0, 1};
      EXPECT_EQ(betti_at_the_end(persistence(link, {.field = field}), 3), expected) << p << field;
    }
  }
}

TEST(ExplicitComplexes, RefuseBrokenBoundaryMatrices) {
  const auto broken = [](const std::string& what, auto&& change) {
    BoundaryMatrix m = triangle();
    change(m);
    expect_error(ErrorKind::bad_data, what, [&] { ExplicitComplex::from_boundary(m); });
  };
  broken("found 7", [](auto& m) { m.rows[0] = 7; });
  broken("found -1", [](auto& m) { m.rows[0] = -1; });
  broken("dimension", [](auto& m) { m.rows[0] = 4; });
  broken("dimension -1", [](auto& m) { m.dims[0] = -1; });
  broken("occurs twice", [](auto& m) { m.rows[1] = 0; });
  broken("before its facet", [](auto& m) { m.values = {0, 0, 0, 1, 1, 3, 2}; });
  broken("nan", [](auto& m) { m.values = {0, 0, 0, 1, 1, kNan, 2}; });
  broken("values", [](auto& m) { m.values = {0, 0}; });
  broken("", [](auto& m) { m.offsets.pop_back(); });
  broken("", [](auto& m) { m.offsets.clear(); });
  broken("", [](auto& m) { m.offsets.back() = 100; });
  broken("", [](auto& m) { m.offsets[5] = 1; });
  broken("", [](auto& m) { m.offsets.front() = 1; });
  broken("incidence", [](auto& m) { m.incidences.pop_back(); });
  broken("boundary of its boundary", [](auto& m) { m.incidences[6] = -1; });
  broken("boundary of its boundary",
         [](auto& m) { m.rows[8] = 4, m.rows[7] = 3, m.rows[6] = 5, m.incidences[8] = 1; });
  broken("boundary of its boundary", [](auto& m) {  // an edge is missing, over Z/2
    m.incidences.clear();
    m.rows.pop_back();
    m.offsets.back() = 8;
  });
}

// A dimension in a file must not determine how much memory is allocated.
TEST(ExplicitComplexes, AbsurdDimensionsAreRefused) {
  BoundaryMatrix m;
  m.dims = {0, std::numeric_limits<int>::max()};
  m.offsets = {0, 0, 0};
  expect_error(ErrorKind::bad_data, "dimension", [&] { ExplicitComplex::from_boundary(m); });
}

// ---- lower stars

TEST(LowerStars, AddFacesAndLoneVertices) {
  const std::vector<double> values{3, 1, 2, 9};
  const ExplicitComplex mesh = lower_star(list_of({{{2, 0, 1}, 77}}), values);
  EXPECT_EQ(mesh.size(), 8U) << "every vertex enters, faces are added";
  check(mesh, 2);
  EXPECT_EQ(bars_of(persistence(mesh)), (std::vector<Bar>{{0, 1, kInf}, {0, 9, kInf}}));
  // Simplices that share faces or occur twice are counted once.
  EXPECT_EQ(
      lower_star(list_of({{{0, 1}, 0}, {{1, 0}, 0}, {{0, 1, 2}, 0}, {{2}, 0}}), values).size(), 8U);
}

TEST(LowerStars, RefuseWhatHasNoValue) {
  const std::vector<double> values{0, 1}, broken{0, kNan};
  expect_error(ErrorKind::bad_data, "vertex 2", [&] {
    lower_star(list_of({{{0, 2}, 0}}), values);
  });
  expect_error(ErrorKind::bad_data, "vertex -1", [&] { lower_star(list_of({{{-1}, 0}}), values); });
  expect_error(ErrorKind::bad_data, "vertex 1", [&] { lower_star(SimplexList{}, broken); });
  expect_error(ErrorKind::bad_data, "occurs twice", [&] {
    lower_star(list_of({{{0, 0}, 0}}), values);
  });
  const std::vector<WeightedEdge> loop{{1, 1, 0}}, far{{0, 5, 0}};
  expect_error(ErrorKind::bad_data, "occurs twice", [&] { lower_star(loop, values); });
  expect_error(ErrorKind::bad_data, "vertex 5", [&] { lower_star(far, values); });
}

// ---- graphs

TEST(FilteredGraphs, AreLowerStarsWithoutTheComplex) {
  for_each_seed(100, [&](Generator& random) {
    const SparseDistances graph = random.sparse(random.integer(0, 9), true, 0.4);
    std::vector<double> values(static_cast<std::size_t>(graph.size()));
    for (double& v : values) v = random.value(random.coin());
    const Barcode expected = persistence(lower_star(graph.edges(), values), {.max_dim = 0});
    EXPECT_EQ(
        bars_of(persistence(FilteredGraph::lower_star(values, graph.edges()), {.max_dim = 0})),
        bars_of(expected));
  });
}

TEST(FilteredGraphs, RefuseWhatIsNoFilteredGraph) {
  const std::vector<double> births{0, 1, 2};
  const auto refuse_edge = [&](WeightedEdge e, const std::string& what) {
    const std::vector<WeightedEdge> edges{{0, 1, 1}, e};
    expect_error(ErrorKind::bad_data, what, [&] { FilteredGraph(births, edges); });
  };
  refuse_edge({0, 3, 5}, "edge (0, 3)");
  refuse_edge({-1, 0, 5}, "edge (-1, 0)");
  refuse_edge({0, 2, 1.5}, "found the value 1.5");
  refuse_edge({0, 2, kNan}, "found the value nan");
  const std::vector<double> broken{0, kNan};
  expect_error(ErrorKind::bad_data, "vertex 1", [&] { FilteredGraph(broken, {}); });
  const std::vector<WeightedEdge> far{{0, 7, 0}};
  expect_error(ErrorKind::bad_data, "edge (0, 7)", [&] { FilteredGraph::lower_star(births, far); });
  EXPECT_TRUE(persistence(FilteredGraph({}, {})).empty());
}

// ---- cubical complexes

TEST(CubicalComplexes, RefuseBrokenImages) {
  const auto refuse_image = [](ErrorKind kind, const std::string& what, const Image& image,
                               const CubicalOptions& options = {}) {
    expect_error(kind, what, [&] { Cubical(image, options); });
  };
  refuse_image(ErrorKind::bad_data, "found 3 values, expected 4", {{2, 2}, {0, 1, 2}});
  refuse_image(ErrorKind::bad_data, "found 5 values, expected 4", {{2, 2}, {0, 1, 2, 3, 4}});
  refuse_image(ErrorKind::bad_data, "2 x 0", {{2, 0}, {}});
  refuse_image(ErrorKind::bad_data, "-3", {{-3, -1}, {0, 0, 0}});
  refuse_image(ErrorKind::bad_data, "voxel 1: found nan", {{2}, {0, kNan}});
  refuse_image(ErrorKind::bad_data, "found 2 values", {{}, {0, 1}});
  refuse_image(ErrorKind::bad_data, "", {{Index{1} << 32, Index{1} << 32}, {0, 1}});
  refuse_image(ErrorKind::usage, "9 axes", {std::vector<Index>(9, 1), {0}});
  refuse_image(ErrorKind::usage, "periodic axis 1", {{2}, {0, 1}}, {.periodic = {false, true}});
  refuse_image(ErrorKind::usage, "threshold", {{2}, {0, 1}}, {.threshold = kNan});
  EXPECT_NO_THROW(Cubical(Image{{2}, {0, 1}}, {.periodic = {true, false, false}}));
}

TEST(CubicalComplexes, CellsHaveDoubledCoordinates) {
  const Image image{{3, 2}, {5, 3, 4, 9, 2, 1}};
  const Barcode barcode = persistence(Cubical(image));
  // The oldest voxel has the value 1 at (2, 1). The voxel with value 3 at (0, 1) is joined to it
  // through the voxels with the values 5 and 4, or through the voxel with the value 9.
  ASSERT_EQ(bars_of(barcode), (std::vector<Bar>{{0, 1, kInf}, {0, 3, 5}}));
  EXPECT_EQ(barcode.cell_kind(), CellKind::grid);
  const auto numbers = [](const InputCell& cell) {
    return std::vector<Index>(cell.numbers.begin(), cell.numbers.end());
  };
  EXPECT_EQ(numbers(barcode.birth_cell(0)), (std::vector<Index>{4, 2}));
  EXPECT_EQ(numbers(barcode.birth_cell(1)), (std::vector<Index>{0, 2}));
  EXPECT_EQ(numbers(*barcode.death_cell(1)), (std::vector<Index>{1, 0}));
}

}  // namespace
}  // namespace ph::test
