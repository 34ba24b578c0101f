// SPDX-License-Identifier: MIT
// Runs the conformance suite on complexes defined by a user. The user's engine is tested as well,
// because the program links it.
#include "tests/extension/own_complexes.hpp"
#include "tests/extension/polygon.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

TEST(Extension, TheEngineIsThere) {
  const std::optional<Engine> column = engine_named("column");
  ASSERT_TRUE(column);
  EXPECT_EQ(engine_names().back(), "column");
  EXPECT_EQ(facts_of(*column).listed_dim(1), 2);
  const Rips square(Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(plan(square, {.engine = *column}).options.engine, *column);
  EXPECT_EQ(persistence(square, {.engine = *column}).bars(1).size(), 1U);
  EXPECT_NE(plan(square).options.engine, *column) << "chosen though it says that it suits nothing";
  EXPECT_GT(estimate(square, {.engine = *column}).bytes_high, 0);
}

TEST(Extension, ANameIsGivenOnce) {
  expect_error(ErrorKind::usage, "engine twist: found a second engine of that name",
               [] { add_engine<TwistEngine>(); });
}

TEST(Extension, TheComplexPassesTheSuite) {
  for_each_seed(200, [](Generator& random, bool ties, std::int64_t field) {
    const Polygon polygon(random.points(random.integer(0, 9), 2, ties));
    check(polygon, 1, {field});
    check(listed(polygon), 1, {field});
    EXPECT_EQ(first_difference(persistence(polygon), persistence(listed(polygon))), "");
  });
}

TEST(Extension, SimplicesOfAFunctionPassTheSuite) {
  int dims[5] = {};
  for_each_seed(400, [&](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(1, 7);
    SimplexList list = random.simplices(n, 3, random.integer(0, 8), ties);
    for (double& value : list.values) value -= 1;  // some values are negative
    const LookedUp simplices(n, list);
    const auto listed_ones = ExplicitComplex::from_simplices(list);
    EXPECT_EQ(simplices.top_dim(), listed_ones.top_dim());
    ++dims[simplices.top_dim() + 1];
    check(simplices, 3, {field});
    EXPECT_EQ(first_difference(persistence(simplices, {.field = field}),
                               persistence(listed_ones, {.field = field})),
              "");
  });
  for (const int count : dims) EXPECT_TRUE(is_enough(count, 5));
}

TEST(Extension, DiametersAreTheRipsFiltration) {
  for_each_seed(100, [&](Generator& random, bool ties, std::int64_t field) {
    const DistanceMatrix distances = random.distances(random.integer(2, 8), ties);
    const Diameters simplices(distances);
    check(simplices, 2, {field});
    // The threshold is so high that all simplices are kept. The default, the enclosing radius,
    // would leave out some simplices, and with them bars of length zero.
    const Rips rips(distances, {.threshold = 10});
    const Options options{.max_dim = 2, .field = field};
    EXPECT_EQ(first_difference(persistence(simplices, options), persistence(rips, options)), "");
    EXPECT_EQ(plan(simplices, options).options.engine, Engine::cohomology);
    EXPECT_EQ(plan(simplices, {.max_dim = 0}).options.engine, Engine::union_find);
  });
}

TEST(Extension, NumberedCellsPassTheSuite) {
  for_each_seed(200, [](Generator& random, bool ties, std::int64_t field) {
    const auto cells =
        ExplicitComplex::from_simplices(random.simplices(7, 3, random.integer(0, 8), ties));
    const Numbered numbered(cells);
    EXPECT_EQ(numbered.top_dim(), cells.top_dim());
    check(numbered, 3, {field});
    EXPECT_EQ(first_difference(persistence(numbered), persistence(cells)), "");
  });
}

struct BadFunction : SimplexFiltration<BadFunction, 2> {
  double of_edges = 0, of_others = 0;
  static Index vertex_count() { return 3; }
  double simplex_value(std::span<const Index> vertices) const {
    return vertices.size() == 2 ? of_edges : of_others;
  }
};

TEST(Extension, AFunctionThatIsNoFiltrationIsRefused) {
  BadFunction simplices;
  EXPECT_EQ(persistence(simplices).bars(0).size(), 1U);
  const auto refuses = [&](const char* words) {
    for (const Engine engine : {Engine::standard, Engine::twist, Engine::cohomology})
      expect_error(ErrorKind::bad_data, words,
                   [&] { persistence(simplices, {.max_dim = 1, .engine = engine}); });
  };
  simplices.of_edges = std::numeric_limits<double>::quiet_NaN();
  refuses(": found value nan, expected a number");
  simplices.of_edges = 0.1;
  refuses("simplex 0 1 2: found value 0, expected at least 0.1, the value of its face 0 1; if");
  simplices.of_edges = -0.1;
  refuses(": found value -0.1, expected at least 0, the value of its face ");
}

}  // namespace
}  // namespace ph::test
