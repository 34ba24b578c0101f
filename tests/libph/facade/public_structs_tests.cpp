// SPDX-License-Identifier: MIT
// Structs that callers fill in are checked like files. Whatever the content, the struct or its
// constructor reports what it found. These tests should also run with sanitizers.
#include <gtest/gtest.h>

#include <climits>
#include <limits>

#include "ph/distance_to_measure.hpp"
#include "ph/distances.hpp"
#include "ph/eigen.hpp"
#include "ph/estimate.hpp"
#include "ph/explicit.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/persistence.hpp"
#include "ph/voxel_image.hpp"
#include "tests/support/wrong_values.hpp"

namespace ph::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kMost = std::numeric_limits<Index>::max();

constexpr auto kBad = ErrorKind::bad_data, kUsage = ErrorKind::usage,
               kResource = ErrorKind::resource;

// ---- complexes

SimplexList simplices(std::vector<Index> vertices, std::vector<std::size_t> offsets,
                      std::vector<double> values) {
  return {std::move(vertices), std::move(offsets), std::move(values)};
}

TEST(PublicStructs, SimplexList) {
  const auto complex_of = [](SimplexList list) {
    return [list = std::move(list)] { ExplicitComplex::from_simplices(list); };
  };
  const auto star_of = [](SimplexList list, std::vector<double> values) {
    return [list = std::move(list), values = std::move(values)] { lower_star(list, values); };
  };
  expect_errors({
      {"no offsets", kBad, "found no offsets", complex_of(simplices({0}, {}, {}))},
      {"offsets beyond", kBad, "from 0 to 1", complex_of(simplices({0}, {0, 5}, {0}))},
      {"offsets short of", kBad, "from 0 to 3", complex_of(simplices({0, 1, 2}, {0, 1}, {0}))},
      {"first not 0", kBad, "ascend", complex_of(simplices({0, 1}, {1, 2}, {0}))},
      {"descending", kBad, "ascend", complex_of(simplices({0, 1}, {0, 9, 2}, {0, 0}))},
      {"few values", kBad, "found 1 values, expected 2",
       complex_of(simplices({0, 1}, {0, 1, 2}, {0}))},
      {"no values", kBad, "found 0 values, expected 1", complex_of(simplices({0}, {0, 1}, {}))},
      {"many values", kBad, "found 3 values, expected 2",
       complex_of(simplices({0, 1}, {0, 1, 2}, {0, 0, 0}))},
      {"an empty simplex", kBad, "without vertices", complex_of(simplices({}, {0, 0}, {0}))},
      {"a negative vertex", kBad, "found vertex -1", complex_of(simplices({-1}, {0, 1}, {0}))},
      {"NaN", kBad, "nan", complex_of(simplices({0}, {0, 1}, {kNan}))},
      {"lower star, no offsets", kBad, "found no offsets", star_of(simplices({0}, {}, {}), {0})},
      {"lower star, beyond", kBad, "from 0 to 1", star_of(simplices({0}, {0, 7}, {}), {0})},
      {"lower star, no value", kBad, "has no value", star_of(simplices({1}, {0, 1}, {}), {0})},
      {"lower star, negative", kBad, "has no value", star_of(simplices({-1}, {0, 1}, {}), {0})},
      {"lower star, NaN", kBad, "nan", star_of(simplices({0}, {0, 1}, {}), {kNan})},
  });
  EXPECT_EQ(simplices({}, {}, {}).size(), 0U);
}

TEST(PublicStructs, BoundaryMatrix) {
  const auto complex_of = [](BoundaryMatrix matrix) {
    return [matrix = std::move(matrix)] { ExplicitComplex::from_boundary(matrix); };
  };
  const auto edge = [](auto&& change) {  // a complex of two vertices and an edge
    BoundaryMatrix matrix{{0, 0, 1}, {0, 0, 0, 2}, {0, 1}, {}, {}};
    change(matrix);
    return matrix;
  };
  expect_errors({
      {"no offsets", kBad, "found 0 offsets, expected 4",
       complex_of(edge([](auto& m) { m.offsets = {}; }))},
      {"offsets beyond", kBad, "from 0 to 2", complex_of(edge([](auto& m) {
         m.offsets = {0, 0, 0, 9};
       }))},
      {"descending", kBad, "ascend", complex_of(edge([](auto& m) {
         m.offsets = {0, 5, 1, 2};
       }))},
      {"a row beyond", kBad, "facet: found 3", complex_of(edge([](auto& m) {
         m.rows = {0, 3};
       }))},
      {"a negative row", kBad, "facet: found -1", complex_of(edge([](auto& m) {
         m.rows = {-1, 0};
       }))},
      {"few incidences", kBad, "1 incidence numbers, expected 2",
       complex_of(edge([](auto& m) { m.incidences = {1}; }))},
      {"few values", kBad, "1 values, expected 3",
       complex_of(edge([](auto& m) { m.values = {1}; }))},
      {"NaN", kBad, "nan", complex_of(edge([](auto& m) {
         m.values = {0, 0, kNan};
       }))},
      {"a negative dimension", kBad, "dimension -1", complex_of(edge([](auto& m) {
         m.dims = {0, -1, 1};
       }))},
      {"a huge dimension", kBad, "dimension 2147483647", complex_of(edge([](auto& m) {
         m.dims = {0, 0, INT_MAX};
       }))},
      {"too old", kBad, "before its facet", complex_of(edge([](auto& m) {
         m.values = {0, 2, 1};
       }))},
  });
  // An incidence may be any number, even INT_MIN, whose absolute value is not representable. A
  // column with such an incidence is not an edge between two vertices.
  const auto odd = ExplicitComplex::from_boundary(edge([](auto& m) {
    m.incidences = {INT_MIN, INT_MAX};
  }));
  EXPECT_FALSE(odd.edges_join_vertices());
}

TEST(PublicStructs, FilteredGraph) {
  const auto graph_of = [](std::vector<double> births, std::vector<WeightedEdge> edges) {
    return [births = std::move(births), edges = std::move(edges)] { FilteredGraph(births, edges); };
  };
  expect_errors({
      {"NaN", kBad, "nan", graph_of({0, kNan}, {})},
      {"beyond", kBad, "below 2", graph_of({0, 0}, {{0, 2, 1}})},
      {"negative", kBad, "below 2", graph_of({0, 0}, {{-1, 1, 1}})},
      {"NaN of an edge", kBad, "nan", graph_of({0, 0}, {{0, 1, kNan}})},
      {"too old", kBad, "at least", graph_of({0, 3}, {{0, 1, 1}})},
      {"lower star, beyond", kBad, "below 1",
       [] {
         FilteredGraph::lower_star(std::vector<double>{0}, std::vector{WeightedEdge{0, 1, 0}});
       }},
  });
}

Image image(std::vector<Index> extents, std::vector<double> values) {
  return {std::move(extents), Voxels(std::move(values))};
}

TEST(PublicStructs, ImageAndCubicalOptions) {
  const auto cubical = [](Image of, CubicalOptions options = {}) {
    return [of = std::move(of), options = std::move(options)] { Cubical(of, options); };
  };
  expect_errors({
      {"few values", kBad, "found 3 values, expected 4", cubical(image({2, 2}, {1, 2, 3}))},
      {"many values", kBad, "found 3 values, expected 2", cubical(image({2}, {1, 2, 3}))},
      {"no axes", kBad, "found 2 values", cubical(image({}, {1, 2}))},
      {"an extent of 0", kBad, "expected each >= 1", cubical(image({0}, {}))},
      {"a negative extent", kBad, "expected each >= 1", cubical(image({-2, -2}, {1, 2, 3, 4}))},
      {"a product that overflows", kBad, "found 1 values",
       cubical(image({Index{1} << 32, Index{1} << 32}, {1}))},
      {"extents beyond all", kBad, "found 1 values", cubical(image({kMost, kMost}, {1}))},
      {"nine axes", kUsage, "9 axes", cubical(image(std::vector<Index>(9, 1), {1}))},
      {"NaN", kBad, "nan", cubical(image({2}, {1, kNan}))},
      {"a threshold of NaN", kUsage, "nan", cubical(image({1}, {1}), {.threshold = kNan})},
      {"an axis that is not there", kUsage, "periodic axis 1",
       cubical(image({1}, {1}), {.periodic = {false, true}})},
  });
}

// ---- distances

TEST(PublicStructs, Distances) {
  const auto matrix = [](Index size, std::vector<double> lower, std::vector<double> births = {}) {
    return [=] { Rips(DistanceMatrix(size, lower, births)); };
  };
  const auto sparse = [](Index size, std::vector<WeightedEdge> edges) {
    return [=] { SparseDistances(size, edges); };
  };
  expect_errors({
      {"negative", kBad, "found -1 points", matrix(-1, {})},
      {"a size whose pairs overflow", kBad, "found 1099511627776 points",
       matrix(Index{1} << 40, {})},
      {"the largest size", kBad, "points, expected 0 to", matrix(kMost, {})},
      {"too few", kBad, "found 2 distances, expected 3 for 3", matrix(3, {1, 2})},
      {"NaN", kBad, "distance (1, 0): found nan", matrix(2, {kNan})},
      {"below 0", kBad, "distance (1, 0): found -1", matrix(2, {-1})},
      {"few births", kUsage, "found 1, expected one for each", matrix(2, {1}, {0})},
      {"NaN birth", kBad, "vertex 1: found birth nan", matrix(2, {1}, {0, kNan})},
      {"infinite birth", kBad, "vertex 0: found birth inf", matrix(2, {1}, {kInfinity, 0})},
      {"sparse: negative", kBad, "found -1 points", sparse(-1, {})},
      {"sparse: beyond", kBad, "below 2", sparse(2, {{0, 2, 1}})},
      {"sparse: negative vertex", kBad, "below 2", sparse(2, {{-1, 1, 1}})},
      {"sparse: NaN", kBad, "found distance nan", sparse(2, {{0, 1, kNan}})},
      {"sparse: twice", kBad, "twice", sparse(2, {{0, 1, 1}, {1, 0, 2}})},
      {"sparse: a loop", kBad, "two different", sparse(2, {{1, 1, 1}})},
      {"within NaN", kUsage, "radius: found nan",
       [] { SparseDistances::within(Points(2, 2), kNan); }},
      {"within less than 0", kUsage, "radius: found -1",
       [] { SparseDistances::within(Points(2, 2), -1); }},
  });
}

TEST(PublicStructs, PointsAndRipsOptions) {
  const Points square{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, odd{{0, 0}, {kNan, 1}};
  const auto rips = [&square](RipsOptions options) {
    return [&square, options] { Rips(square, options); };
  };
  const std::vector<std::uint32_t> descending{2, 1}, beyond{4};
  const std::vector<double> few{0}, below{0, 0, 0, -1}, nan{0, kNan, 0, 0};
  expect_errors({
      {"NaN coordinate", kBad, "nan", [&] { Rips graph(odd); }},
      {"NaN coordinate, forest", kBad, "nan", [&] { Rips(odd, {}).graph(RipsForm::forest); }},
      {"NaN threshold", kUsage, "nan", rips({.threshold = kNan})},
      {"negative threshold", kUsage, "-1", rips({.threshold = -1})},
      {"NaN threshold, forest", kUsage, "nan",
       [&] { Rips(square, {.threshold = kNan}).graph(RipsForm::forest); }},
      {"NaN threshold, sparse", kUsage, "nan",
       [] {
         Rips(SparseDistances(2, {{0, 1, 1}}), {.threshold = kNan});
       }},
      {"NaN threshold, matrix", kUsage, "nan",
       [] { Rips(DistanceMatrix(2, {1}), {.threshold = kNan}); }},
      {"NaN threshold, approximation", kUsage, "nan",
       rips({.threshold = kNan, .approximation = 0.5})},
      {"exponent NaN", kUsage, "exponent: found nan",
       rips({.distance = PointDistance::minkowski, .minkowski_p = kNan})},
      {"exponent below 1", kUsage, "exponent: found 0.5",
       rips({.distance = PointDistance::minkowski, .minkowski_p = 0.5})},
      {"approximation NaN", kUsage, "nan", rips({.approximation = kNan})},
      {"approximation 0", kUsage, "0", rips({.approximation = 0})},
      {"approximation infinite", kUsage, "inf", rips({.approximation = kInfinity})},
      {"vertices that descend", kUsage, "ascending", rips({.vertices = descending})},
      {"vertices beyond", kUsage, "below 4", rips({.vertices = beyond})},
      {"few births", kUsage, "found 1, expected one for each", rips({.births = few})},
      {"a birth below 0", kBad, "vertex 3: found birth -1", rips({.births = below})},
      {"a birth of NaN", kBad, "vertex 1: found birth nan", rips({.births = nan})},
      {"a cosine of nothing", kBad, "zero", rips({.distance = PointDistance::cosine})},
  });
}

TEST(PublicStructs, LimitsAndNeighbours) {
  const Points points = to_points(PointMatrix::Random(5, 2));
  const auto greedy = [&](GreedyLimits limits) {
    return [&points, limits] { greedy_permutation(points, limits); };
  };
  const auto measure = [&](Index k) { return [&points, k] { distance_to_measure(points, k); }; };
  const auto voxels = [&](double voxel, Index margin) {
    return [&points, voxel, margin] { voxel_image(points, voxel, VoxelValue::distance, margin); };
  };
  const auto bottleneck = [](Bar bar) {
    return [bar] { bottleneck_distance(std::span(&bar, 1), {}); };
  };
  expect_errors({
      {"no points", kUsage, "found 0 points", greedy({.points = 0})},
      {"fewer than no points", kUsage, "found -1 points", greedy({.points = -1})},
      {"radius NaN", kUsage, "radius nan", greedy({.radius = kNan})},
      {"radius below 0", kUsage, "radius -1", greedy({.radius = -1})},
      {"no neighbours", kUsage, "found 0", measure(0)},
      {"too many neighbours", kUsage, "found 6", measure(6)},
      {"fewer than none", kUsage, "found -3", measure(-3)},
      {"voxel NaN", kUsage, "voxel: found nan", voxels(kNan, 1)},
      {"voxel 0", kUsage, "voxel: found 0", voxels(0, 1)},
      {"voxel tiny", kResource, "2^32", voxels(1e-300, 1)},
      {"margin below 0", kUsage, "margin: found -1", voxels(1, -1)},
      {"margin beyond all", kResource, "2^32", voxels(1, kMost)},
      {"a bar of NaN", kBad, "nan", bottleneck({0, kNan, 1})},
      {"a bar that dies of NaN", kBad, "nan", bottleneck({0, 0, kNan})},
      {"a bar backwards", kBad, "found", bottleneck({0, 2, 1})},
  });
}

// ---- options

TEST(PublicStructs, Options) {
  const Rips rips(to_points(PointMatrix::Random(5, 2)));
  const Cubical cubical(image({2, 2}, {1, 2, 3, 4}));
  const ExplicitComplex listed =
      ExplicitComplex::from_boundary({{0, 0, 1}, {0, 0, 0, 2}, {0, 1}, {}, {}});
  const FilteredGraph graph(std::vector<double>{0, 1}, std::vector{WeightedEdge{0, 1, 2}});
  std::vector<Case> cases;
  const auto add = [&](const char* name, const char* part, const Options& options) {
    cases.push_back({name, kUsage, part, [&rips, options] { persistence(rips, options); }});
    cases.push_back({name, kUsage, part, [&cubical, options] { persistence(cubical, options); }});
    cases.push_back({name, kUsage, part, [&listed, options] { persistence(listed, options); }});
    cases.push_back({name, kUsage, part, [&graph, options] { persistence(graph, options); }});
    cases.push_back({name, kUsage, part, [&rips, options] { plan(rips, options); }});
    cases.push_back({name, kUsage, part, [&cubical, options] { estimate(cubical, options); }});
  };
  add("dimension below 0", "highest dimension: found -1", {.max_dim = -1});
  add("dimension far below 0", "highest dimension: found -2147483648", {.max_dim = INT_MIN});
  add("lowest dimension below 0", "lowest dimension: found -1", {.min_dim = -1});
  cases.push_back({"lowest dimension above the usual highest", kUsage,
                   "lowest dimension: found 2, expected at most 1",
                   [&] { persistence(rips, {.min_dim = 2}); }});
  add("persistence NaN", "least persistence: found nan", {.min_persistence = kNan});
  for (const std::int64_t field : {INT64_MIN, std::int64_t{-2}, std::int64_t{0}, std::int64_t{1},
                                   std::int64_t{4}, std::int64_t{1} << 31, INT64_MAX}) {
    const Options options{.field = field};
    cases.push_back({"field", kUsage, "field", [&, options] { persistence(rips, options); }});
    cases.push_back({"field", kUsage, "field", [&, options] { persistence(cubical, options); }});
  }
  expect_errors(cases);
  // A max_dim above the highest dimension is allowed.
  EXPECT_EQ(persistence(cubical, {.max_dim = INT_MAX}).size(), persistence(cubical).size());
  EXPECT_EQ(persistence(listed, {.max_dim = INT_MAX}).size(), persistence(listed).size());
}

}  // namespace
}  // namespace ph::test
