// SPDX-License-Identifier: MIT
// Components of cloud parts: the division of a cloud into blocks, and the joining of forests.
#include <gtest/gtest.h>

#include <algorithm>

#include "libph/src/metric/blocks/numbered_forest.hpp"
#include "libph/src/metric/blocks/sample_tree.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

// Each point belongs to exactly one side of a split, even if its coordinate is tied.
TEST(SampleTree, PointsOfTheSampleLieInTheirCells) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random.points(random.integer(1, 100), random.integer(1, 4), ties);
    const auto sample = static_cast<std::size_t>(random.integer(1, int(points.rows())));
    const auto blocks = static_cast<std::uint32_t>(random.integer(1, 9));
    const SampleTree tree(points, sample, blocks, default_context());
    for (SampleTree::Cell cell = 0; cell < tree.cell_count(); ++cell) {
      const double* const x = tree.points().row(Index{cell});
      EXPECT_TRUE(std::equal(x, x + points.cols(), points.row(tree.number(cell)).begin()));
      SampleTree::Node node = SampleTree::kRoot;
      while (!tree.is_leaf(node)) node = tree.child(node, x);
      ASSERT_EQ(tree.cells(node).begin, cell);
      ASSERT_EQ(tree.cells(node).size(), 1U);
      const auto of_block = tree.cells(tree.node_of_block(tree.blocks(node).begin));
      EXPECT_TRUE(of_block.begin <= cell && cell < of_block.end);
    }
    // Blocks differ little in size.
    std::uint32_t least = UINT32_MAX, most = 0;
    for (std::uint32_t b = 0; b < blocks; ++b) {
      const auto size = tree.cells(tree.node_of_block(b)).size();
      least = std::min(least, size);
      most = std::max(most, size);
    }
    EXPECT_LE(most, least + 4);  // each split may put one more point on one side
  });
}

TEST(NumberedForest, KeepsClaimsThatAreOpen) {
  const RunContext& context = default_context();
  NumberedForest forest(context), other(context);
  forest.numbers = {1, 5, 9};
  forest.edges = {{2, 1, 0}};
  forest.claims = {{1, 1, 0}, {2, 1, 0}, {4, 2, 0}};
  forest.reduce(context);
  ASSERT_EQ(forest.claims.size(), 2U);  // up to the value 1, the edge of length 2 joins nothing
  EXPECT_EQ(forest.claims[0].value, 1);
  EXPECT_EQ(forest.claims[1].value, 4);
  other.numbers = {5, 7, 9};
  other.edges = {{1, 1, 0}, {4, 2, 1}};
  forest.join(std::move(other), context);
  EXPECT_EQ(forest.numbers, (std::pmr::vector<Index>{1, 5, 7, 9}));
  EXPECT_EQ(forest.edges.size(), 3U);
  ASSERT_EQ(forest.claims.size(), 1U);
  EXPECT_EQ(forest.claims[0].value, 1);
}

}  // namespace
}  // namespace ph::test
