// SPDX-License-Identifier: MIT
// Compares the choice of clusters, and the clusters of added points, with their definitions.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "ph/cluster_tree.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/rips.hpp"
#include "tests/libph/clusters/plain_clusters.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"

namespace ph::test {
namespace {

// The brute force tries all sets of clusters of which none is inside another.
class Antichains {
 public:
  Antichains(const ClusterTree& tree, bool allow_single) : tree_(tree), single_(allow_single) {}
  double heaviest() const {
    return tree_.clusters().empty() ? 0 : best(tree_.clusters().size() - 1, single_);
  }

 private:
  double best(std::size_t c, bool may_be_chosen) const {
    double sum = 0;
    for (std::size_t child = 0; child < c; ++child)
      if (tree_.clusters()[child].parent == static_cast<std::int64_t>(c)) sum += best(child, true);
    return may_be_chosen ? std::max(sum, tree_.clusters()[c].mass) : sum;
  }
  const ClusterTree& tree_;
  bool single_;
};

bool is_inside(const ClusterTree& tree, std::int64_t c, std::int64_t around) {
  while (c >= 0 && c != around) c = tree.clusters()[std::size_t(c)].parent;
  return c == around;
}

TEST(ChosenClusters, AreTheHeaviestOnes) {
  for_each_seed(1000, [](Generator& random, bool ties, std::int64_t) {
    const ClusterTree tree = tree_of(sample_of(random, ties, 60));
    const bool single = random.coin();
    const Clusters clusters = tree.select({.allow_single = single});
    double mass = 0;
    std::set<Index> seen;
    for (const std::uint32_t c : clusters.chosen) {
      mass += tree.clusters()[c].mass;
      for (const std::uint32_t other : clusters.chosen)
        if (other != c) {
          EXPECT_FALSE(is_inside(tree, other, c));
        }
      if (!single) {
        EXPECT_LT(c + 1, tree.clusters().size());
      }
    }
    const double expected = Antichains(tree, single).heaviest();
    // Clusters that leave no point of their own at infinity do not occur among the labels.
    if (std::isfinite(expected)) {
      EXPECT_NEAR(mass, expected, 1e-9 * (1 + expected));
    }
    for (Index p = 0; p < tree.size(); ++p) {
      const Index label = clusters.labels[std::size_t(p)];
      if (label >= 0 && seen.insert(label).second) {
        EXPECT_EQ(label, Index(seen.size()) - 1);
      }
      for (Index other = 0; other < Index(clusters.chosen.size()); ++other) {
        const std::uint32_t c = clusters.chosen[std::size_t(other)];
        if (c + 1 == tree.clusters().size()) continue;  // the root has noise
        EXPECT_EQ(label == other, is_inside(tree, tree.cluster_of()[std::size_t(p)], c));
      }
      const double value = tree.leaves_at()[std::size_t(p)],
                   share = clusters.probabilities[std::size_t(p)];
      if (label < 0) {
        EXPECT_EQ(share, 0);
      } else if (value == 0) {
        EXPECT_EQ(share, 1);
      } else {
        const double bottom = tree.clusters()[clusters.chosen[std::size_t(label)]].bottom;
        EXPECT_EQ(share, bottom == value ? 1.0 : std::min(1.0, bottom / value));
      }
    }
  });
}

TEST(ChosenClusters, OfMethodLeafHaveNoChildren) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const ClusterTree tree = tree_of(sample_of(random, ties, 60));
    const Clusters clusters = tree.select({.method = ClusterMethod::leaf});
    std::set<std::uint32_t> expected;
    for (std::uint32_t c = 0; c + 1 < tree.clusters().size(); ++c) expected.insert(c);
    for (const ClusterTree::Cluster& c : tree.clusters())
      if (c.parent >= 0) expected.erase(static_cast<std::uint32_t>(c.parent));
    EXPECT_EQ(std::set(clusters.chosen.begin(), clusters.chosen.end()), expected);
  });
}

// With the method leaf, epsilon gives the leaves of the tree without its splits below epsilon.
TEST(ChosenClusters, EpsilonUndoesSplits) {
  for_each_seed(600, [](Generator& random, bool ties, std::int64_t) {
    const ClusterTree tree = tree_of(sample_of(random, ties, 60));
    std::vector<double> tops{random.value(ties)};
    for (const ClusterTree::Cluster& c : tree.clusters())
      if (c.top < kInf && c.top > 0) tops.push_back(c.top);
    const double epsilon = tops[std::size_t(random.integer(0, int(tops.size()) - 1))];
    if (epsilon == 0) return;
    std::set<std::uint32_t> expected;
    const auto has_top = [&](const ClusterTree::Cluster& c) { return c.top >= epsilon; };
    for (std::uint32_t c = 0; c + 1 < tree.clusters().size(); ++c)
      if (has_top(tree.clusters()[c])) expected.insert(c);
    for (const ClusterTree::Cluster& c : tree.clusters())
      if (c.parent >= 0 && has_top(c)) expected.erase(static_cast<std::uint32_t>(c.parent));
    // The root is not chosen, so its children stay if all splits are undone.
    if (expected.empty())
      for (std::uint32_t c = 0; c + 1 < tree.clusters().size(); ++c)
        if (tree.clusters()[c].parent + 1 == std::int64_t(tree.clusters().size()))
          expected.insert(c);
    const Clusters clusters = tree.select({.method = ClusterMethod::leaf, .epsilon = epsilon});
    EXPECT_EQ(std::set(clusters.chosen.begin(), clusters.chosen.end()), expected);
  });
}

using Partition = std::set<std::set<Index>>;
Partition partition_of(const Clusters& clusters, const std::vector<Index>& name) {
  std::vector<std::set<Index>> parts(clusters.chosen.size());
  for (std::size_t p = 0; p < clusters.labels.size(); ++p)
    if (clusters.labels[p] >= 0) parts[std::size_t(clusters.labels[p])].insert(name[p]);
  return {parts.begin(), parts.end()};
}

// Ties, scales and copies change nothing.
TEST(ChosenClusters, DependOnlyOnTheDistances) {
  for_each_seed(1000, [](Generator& random, bool ties, std::int64_t seed) {
    const Sample sample = sample_of(random, ties, 60);
    const Index n = sample.points.rows();
    const ClusterOptions options{.method = random.coin() ? ClusterMethod::eom : ClusterMethod::leaf,
                                 .allow_single = random.integer(0, 4) == 0};
    std::vector<Index> same(static_cast<std::size_t>(n)), shuffled;
    std::iota(same.begin(), same.end(), Index{0});
    const Clusters clusters = tree_of(sample).select(options);
    const Partition expected = partition_of(clusters, same);

    shuffled = same;
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1], shuffled[std::size_t(random.integer(0, int(i) - 1))]);
    Sample renumbered{Points(n, sample.points.cols()), sample.k, sample.min_size};
    for (Index i = 0; i < n; ++i)
      copy_point(sample.points, shuffled[std::size_t(i)], renumbered.points, i);
    const Clusters of_renumbered = tree_of(renumbered).select(options);
    EXPECT_EQ(partition_of(of_renumbered, shuffled), expected) << seed;
    for (std::size_t i = 0; i < shuffled.size(); ++i)
      EXPECT_EQ(of_renumbered.probabilities[i], clusters.probabilities[std::size_t(shuffled[i])]);

    const Sample larger{scaled(sample.points, std::ldexp(1, random.integer(-40, 40))), sample.k,
                        sample.min_size};
    EXPECT_EQ(tree_of(larger).select(options).labels, clusters.labels);

    Sample doubled{Points(2 * n, sample.points.cols()), 2 * sample.k + 1, 2 * sample.min_size};
    std::vector<Index> copies;
    for (Index i = 0; i < 2 * n; ++i) {
      copy_point(sample.points, i / 2, doubled.points, i);
      copies.push_back(i / 2);
    }
    EXPECT_EQ(partition_of(tree_of(doubled).select(options), copies), expected);
  });
}

// Compares with the definition. A fitted point gets its own core distance, and joins the hierarchy
// at that value.
TEST(Attachments, AreWhatTheyAreByDefinition) {
  constexpr PointDistance kinds[] = {PointDistance::euclidean, PointDistance::manhattan,
                                     PointDistance::chebyshev, PointDistance::hamming};
  for_each_seed(800, [&](Generator& random, bool ties, std::int64_t) {
    Sample sample = sample_of(random, ties, 60);
    const Index n = sample.points.rows();
    const PointDistance distance = kinds[random.integer(0, 3)];
    Points added = random.points(random.integer(0, 20), sample.points.cols(), ties);
    for (Index i = 0; i < added.rows(); i += 2) copy_point(sample.points, i % n, added, i);
    const std::vector<double> core = core_distances(sample.points, sample.k, distance),
                              of_added =
                                  core_distances_among(sample.points, added, sample.k, distance);
    const std::vector<Attachment> found =
        attachments(sample.points, core, added, of_added, distance);
    ASSERT_EQ(found.size(), std::size_t(added.rows()));
    for (Index i = 0; i < added.rows(); ++i) {
      Points both(n + 1, added.cols());
      for (Index j = 0; j < n; ++j) copy_point(sample.points, j, both, j);
      copy_point(added, i, both, n);
      const PointMetric metric(both, distance);
      std::vector<double> lengths;
      for (Index j = 0; j < n; ++j) lengths.push_back(metric(j, n));
      std::vector<double> sorted = lengths;
      std::ranges::sort(sorted);
      const double born = sample.k == 0 ? 0 : sorted[std::size_t(sample.k)];
      EXPECT_EQ(of_added[std::size_t(i)], born);
      Attachment best;
      for (Index j = 0; j < n; ++j) {
        const double value = std::max({lengths[std::size_t(j)], core[std::size_t(j)], born});
        if (value < best.value) best = {j, value};
      }
      EXPECT_EQ(found[std::size_t(i)].point, best.point);
      EXPECT_EQ(found[std::size_t(i)].value, best.value);
      if (i % 2 == 0) {
        EXPECT_EQ(born, core[std::size_t(i % n)]);
      }
    }
  });
  expect_error(ErrorKind::usage, "found 1 coordinates, expected 2", [] {
    core_distances_among(Points{{0, 0}}, Points{{1}}, 0);
  });
  expect_error(ErrorKind::usage, "one per point", [] {
    attachments(Points{{0, 0}}, {}, Points{{1, 1}}, std::vector<double>{0});
  });
  EXPECT_EQ(core_distances_among(Points{{0, 0}}, Points{{1, 1}}, 1)[0], kInf);
  EXPECT_EQ(attachments(Points(0, 2), {}, Points{{1, 1}}, std::vector<double>{0})[0].point, -1);
}

TEST(OutlierScores, AreWhatTheyAreByDefinition) {
  const Points line{{0.0}, {1.0}, {2.0}, {2.0}, {10.0}};
  const ClusterTree tree(Rips(line), 2);
  // The copies stay longest. All others leave the root.
  EXPECT_EQ(tree.outlier_scores(), (std::vector<double>{1, 1, 0, 0, 1}));
  const ClusterTree spread(Rips(Points{{0.0}, {1.0}, {3.0}, {7.0}}), 2);
  EXPECT_EQ(spread.outlier_scores(), (std::vector<double>{0, 0, 0.5, 0.75}));
}

// A point that is added again joins the hierarchy as it did, unless another point is as near.
TEST(ChosenClusters, OfPointsThatAreAddedAgain) {
  for_each_seed(800, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 60);
    const std::vector<double> core = core_distances(sample.points, sample.k);
    const std::vector<Attachment> again = attachments(sample.points, core, sample.points, core);
    const ClusterTree tree = tree_of(sample);
    const ClusterOptions options{.method = random.coin() ? ClusterMethod::eom : ClusterMethod::leaf,
                                 .epsilon = random.coin() ? 0 : random.value(ties),
                                 .allow_single = random.coin(),
                                 .max_size = random.integer(0, 1) * random.integer(1, 30)};
    const Clusters chosen = tree.select(options), located = tree.locate(again, options);
    EXPECT_EQ(located.labels, chosen.labels);
    EXPECT_EQ(located.probabilities, chosen.probabilities);
    EXPECT_EQ(located.chosen, chosen.chosen);
  });
}

// By the definition: the point is put into the hierarchy with its edge, and the clusters stay.
TEST(ChosenClusters, OfAddedPoints) {
  for_each_seed(800, [](Generator& random, bool ties, std::int64_t) {
    const Sample sample = sample_of(random, ties, 60);
    const ClusterTree tree = tree_of(sample);
    const Index point = random.integer(0, int(sample.points.rows()) - 1);
    std::vector<double> values{random.value(ties), kInf};
    for (const ClusterTree::Cluster& c : tree.clusters()) values.push_back(c.top);
    const double value = values[std::size_t(random.integer(0, int(values.size()) - 1))];
    const Clusters clusters = tree.select();
    const Clusters found = tree.locate(std::vector<Attachment>{{point, value}, {-1, kInf}});
    // The chosen cluster that has the point just below the value, and still at the value.
    Index expected = -1;
    for (std::size_t i = 0; i < clusters.chosen.size(); ++i)
      if (is_inside(tree, tree.cluster_of()[std::size_t(point)], clusters.chosen[i]) &&
          value < tree.clusters()[clusters.chosen[i]].top)
        expected = Index(i);
    EXPECT_EQ(found.labels, (std::vector<Index>{expected, -1}));
    EXPECT_EQ(found.probabilities[1], 0);
    if (expected < 0) {
      EXPECT_EQ(found.probabilities[0], 0);
      return;
    }
    const double bottom = tree.clusters()[clusters.chosen[std::size_t(expected)]].bottom,
                 leaves = std::max(value, tree.leaves_at()[std::size_t(point)]);
    EXPECT_EQ(found.probabilities[0], leaves <= bottom ? 1 : bottom / leaves);
  });
  const ClusterTree pair(Rips(Points{{0.0}, {1.0}}), 2);
  expect_error(ErrorKind::usage, "point: found 2, expected one of the 2 points", [&] {
    pair.locate(std::vector<Attachment>{{2, 1}});
  });
}

}  // namespace
}  // namespace ph::test
