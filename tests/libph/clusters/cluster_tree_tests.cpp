// SPDX-License-Identifier: MIT
// Compares cluster trees with their definition: see plain_clusters.hpp.
#include "ph/cluster_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "ph/cubical.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/merge_tree.hpp"
#include "ph/rips.hpp"
#include "ph/sparse_distances.hpp"
#include "tests/libph/clusters/plain_clusters.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"

namespace ph::test {
namespace {

class Comparison {
 public:
  explicit Comparison(const ClusterTree& tree) : tree_(tree), by_members_(members_of(tree)) {}
  /// Compares a cluster and all inside it. @return the number of clusters.
  std::size_t compare(PlainCluster expected, std::int64_t parent = -1) const {
    std::ranges::sort(expected.points);
    const auto at = by_members_.find(expected.points);
    EXPECT_TRUE(at != by_members_.end());
    if (at == by_members_.end()) return 0;
    const ClusterTree::Cluster& found = tree_.clusters()[at->second];
    EXPECT_EQ(found.parent, parent);
    EXPECT_EQ(found.top, expected.top);
    EXPECT_EQ(found.bottom, expected.bottom);
    EXPECT_EQ(found.least, expected.least());
    EXPECT_EQ(found.size, static_cast<Index>(expected.points.size()));
    const double mass = expected.mass();
    if (std::isinf(mass)) {
      EXPECT_EQ(found.mass, mass);
    } else {
      EXPECT_NEAR(found.mass, mass, 1e-9 * (1 + mass));
    }
    for (const auto& [p, value] : expected.leaves_at) {
      EXPECT_EQ(tree_.cluster_of()[std::size_t(p)], at->second);
      EXPECT_EQ(tree_.leaves_at()[std::size_t(p)], value);
    }
    std::size_t count = 1;
    for (const PlainCluster& child : expected.children) count += compare(child, at->second);
    return count;
  }

 private:
  const ClusterTree& tree_;
  std::map<Members, std::uint32_t> by_members_;
};

TEST(ClusterTrees, AreWhatTheyAreByDefinition) {
  for_each_seed(1500, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 30);
    const ClusterTree tree = tree_of(sample);
    const Values values(sample.points, sample.k);
    EXPECT_EQ(Comparison(tree).compare(root_of(values, sample.min_size)), tree.clusters().size());
    for (std::size_t c = 0; c < tree.clusters().size(); ++c) {
      const std::int64_t parent = tree.clusters()[c].parent;
      EXPECT_EQ(parent < 0, c + 1 == tree.clusters().size());
      if (parent >= 0) {
        EXPECT_GT(parent, static_cast<std::int64_t>(c));
      }
    }
  });
}

// Pairs beyond a threshold are not edges, so several components may be left.
TEST(ClusterTrees, ComponentsWithoutAnEdgeJoinAtInfinity) {
  for_each_seed(500, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 24);
    const std::vector<double> core = core_distances(sample.points, sample.k);
    const double limit = std::max(std::ranges::max(core), random.value(ties));
    Values values(sample.points, sample.k);
    values.set_all_above(limit, kInf);
    const ClusterTree tree(Rips(sample.points, {.threshold = limit, .births = core}),
                           sample.min_size);
    EXPECT_EQ(Comparison(tree).compare(root_of(values, sample.min_size)), tree.clusters().size());
  });
}

// A merge tree has the edges of a spanning forest.
TEST(ClusterTrees, OfAMergeTreeAreThoseOfItsFiltration) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 60);
    const Rips rips(sample.points, {.core_neighbours = sample.k});
    const ClusterTree tree(rips, sample.min_size), other(merge_tree(rips), sample.min_size);
    EXPECT_TRUE(std::ranges::equal(tree.cluster_of(), other.cluster_of()));
    EXPECT_TRUE(std::ranges::equal(tree.leaves_at(), other.leaves_at()));
  });
}

// Edges that are not in a spanning forest change nothing.
TEST(ClusterTrees, OfAGraphAreThoseOfItsForest) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 30);
    Values values(sample.points, sample.k);
    if (random.coin()) values.set_all_above(random.value(ties), kInf);
    std::vector<WeightedEdge> edges;
    for (Index i = 0; i < values.size(); ++i)
      for (Index j = 0; j < i; ++j) edges.push_back({i, j, values.at(i, j)});
    const ClusterTree tree(values.size(), edges, sample.min_size);
    EXPECT_EQ(Comparison(tree).compare(root_of(values, sample.min_size)), tree.clusters().size());
  });
  const std::vector<WeightedEdge> bad{{0, 2, 1}}, nan{{0, 1, std::nan("")}};
  for (const auto& edges : {bad, nan})
    expect_error(ErrorKind::usage, "expected two of the 2 points",
                 [&] { ClusterTree(2, edges, 2); });
}

/// The same tree in all its numbers, apart from the order of clusters.
void expect_equal(const ClusterTree& a, const ClusterTree& b) {
  EXPECT_EQ(a.min_size(), b.min_size());
  ASSERT_EQ(a.clusters().size(), b.clusters().size());
  EXPECT_TRUE(std::ranges::equal(a.leaves_at(), b.leaves_at()));
  const auto of_a = members_of(a), of_b = members_of(b);
  for (const auto& [members, i] : of_a) {
    const auto at = of_b.find(members);
    ASSERT_TRUE(at != of_b.end());
    const ClusterTree::Cluster &x = a.clusters()[i], &y = b.clusters()[at->second];
    EXPECT_EQ(x.top, y.top);
    EXPECT_EQ(x.bottom, y.bottom);
    EXPECT_EQ(x.least, y.least);
    EXPECT_EQ(x.size, y.size);
    EXPECT_EQ(x.mass, y.mass);
  }
}

TEST(ClusterTrees, WithAnotherLeastSizeAreThoseMadeAnew) {
  for_each_seed(1500, [](Generator& random, bool ties, std::int64_t) {
    Sample sample = sample_of(random, ties, 60);
    const ClusterTree fine = tree_of(sample);
    sample.min_size += random.integer(0, 12);
    const ClusterTree anew = tree_of(sample);
    expect_equal(fine.with_min_size(sample.min_size), anew);
    const Index between = random.integer(int(fine.min_size()), int(sample.min_size));
    expect_equal(fine.with_min_size(between).with_min_size(sample.min_size), anew);
    expect_error(ErrorKind::usage, "with which the tree was made",
                 [&] { anew.with_min_size(anew.min_size() - 1); });
  });
}

TEST(ClusterTrees, OfAnImageOnALinearScale) {
  const Cubical image(Image{{9}, {5, 1, 2, 7, 3, 4, 3, 9, 0}});
  const MergeTree merges = merge_tree(image);
  const ClusterTree tree(merges, 2, ClusterScale::linear);
  ASSERT_EQ(tree.clusters().size(), 3U);
  EXPECT_EQ(tree.clusters()[0].bottom, 2);
  EXPECT_EQ(tree.clusters()[1].bottom, 4);
  EXPECT_EQ(tree.clusters()[0].top, 7);
  // 9 - value: two voxels from 2 on, a third one from 5 on, until 7.
  EXPECT_EQ(tree.clusters()[0].mass, 2 * 3 + 3 * 2);
  EXPECT_EQ(tree.select().labels, (std::vector<Index>{0, 0, 0, -1, 1, 1, 1, -1, -1}));
  expect_error(ErrorKind::usage, "use the scale linear", [] {
    ClusterTree(merge_tree(Cubical(Image{{2}, {-1, -2}})), 2);
  });
}

TEST(ClusterTrees, OfFewPointsAndBadNumbers) {
  const ClusterTree none(Rips(Points(0, 2)), 2);
  EXPECT_TRUE(none.clusters().empty());
  EXPECT_TRUE(none.select().labels.empty());
  const ClusterTree one(Rips(Points{{1.0}}), 2);
  EXPECT_EQ(one.clusters().size(), 1U);
  EXPECT_EQ(one.select().labels, (std::vector<Index>{-1}));
  const ClusterTree few(Rips(Points{{0.0}, {1.0}, {3.0}}), 5);
  EXPECT_EQ(few.clusters().size(), 1U);
  EXPECT_EQ(few.clusters()[0].bottom, 2);
  EXPECT_EQ(few.select().labels, (std::vector<Index>{-1, -1, -1}));
  EXPECT_EQ(few.select({.allow_single = true}).labels, (std::vector<Index>{0, 0, 0}));
  const Rips pair(Points{{0.0}, {1.0}});
  expect_error(ErrorKind::usage, "at least 2", [&] { ClusterTree(pair, 1); });
  const ClusterTree tree(pair, 2);
  expect_error(ErrorKind::usage, "epsilon", [&] { tree.select({.epsilon = -1}); });
  expect_error(ErrorKind::usage, "max_size", [&] { tree.select({.max_size = -1}); });
  expect_error(ErrorKind::usage, "all points as vertices", [] {
    ClusterTree(Rips(Points{{0.0}, {1.0}}, {.vertices = {1}}), 2);
  });
}

}  // namespace
}  // namespace ph::test
