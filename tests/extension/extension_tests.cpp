// SPDX-License-Identifier: MIT
// The suite on somebody else's complex; somebody else's engine is in it by itself.
#include "polygon.hpp"
#include "support/conformance.hpp"
#include "support/expect_error.hpp"
#include "support/for_each_seed.hpp"

namespace ph::test {
namespace {

TEST(Extension, TheEngineIsThere) {
  const std::optional<Engine> column = engine_named("column");
  ASSERT_TRUE(column);
  EXPECT_EQ(engine_names().back(), "column");
  EXPECT_EQ(facts_of(*column).listed_dim(1), 2);
  const Rips square(Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(plan(square, {.engine = *column}).engine, *column);
  EXPECT_EQ(persistence(square, {.engine = *column}).bars(1).size(), 1U);
  EXPECT_NE(plan(square).engine, *column) << "chosen though it says that it suits nothing";
  EXPECT_GT(estimate(square, {.engine = *column}).bytes_high, 0);
}

TEST(Extension, ANameIsGivenOnce) {
  expect_error(ErrorKind::usage, "engine twist: there is one of that name",
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

}  // namespace
}  // namespace ph::test
