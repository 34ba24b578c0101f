// SPDX-License-Identifier: MIT
#include "libsegment/src/tree/cross_check.hpp"

#include <gtest/gtest.h>

#include "libsegment/src/voxels/rips_graph.hpp"
#include "ph/detail/segment/tree_barcode.hpp"

namespace ph::segment {
namespace {

TEST(CrossCheck, FindsADifference) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  const FilteredGraph graph = rips_graph(points, 2, 0);
  const MergeTree right = merge_tree(graph);
  EXPECT_EQ(cross_check(graph, barcode_of(right)), "");
  MergeTree late = right;
  late.merges.back().value = 1.5;
  EXPECT_NE(cross_check(graph, barcode_of(late)), "");
  MergeTree missing = right;
  missing.merges.pop_back();
  EXPECT_NE(cross_check(graph, barcode_of(missing)), "");
  MergeTree other = right;
  other.merges.back().u = 0;  // the same bars, but another edge
  EXPECT_NE(cross_check(graph, barcode_of(other)), "");
}

}  // namespace
}  // namespace ph::segment
