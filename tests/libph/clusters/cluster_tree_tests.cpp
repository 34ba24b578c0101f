// SPDX-License-Identifier: MIT
// Compares cluster trees with their definition: from the top down, on the matrix of all values.
#include "ph/cluster_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "ph/cubical.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/merge_tree.hpp"
#include "ph/rips.hpp"
#include "ph/sparse_distances.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"

namespace ph::test {
namespace {

constexpr double kInf = kInfinity;
using Members = std::vector<Index>;

/// The value of each pair of points, from the definition of mutual reachability.
class Values {
 public:
  Values(const Points& points, Index k)
      : n_(points.rows()), values_(points.rows() * points.rows()) {
    std::vector<double> core;
    for (Index i = 0; i < n_; ++i) {
      std::vector<double> row;
      for (Index j = 0; j < n_; ++j) {
        double sum = 0;
        for (Index a = 0; a < points.cols(); ++a)
          sum += (points(i, a) - points(j, a)) * (points(i, a) - points(j, a));
        at(i, j) = std::sqrt(sum);
        if (i != j) row.push_back(at(i, j));
      }
      std::ranges::sort(row);
      core.push_back(k == 0 ? 0 : row[static_cast<std::size_t>(k - 1)]);
    }
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; j < n_; ++j)
        at(i, j) = std::max({at(i, j), core[std::size_t(i)], core[std::size_t(j)]});
  }
  Index size() const { return n_; }
  double& at(Index i, Index j) { return values_[static_cast<std::size_t>(i * n_ + j)]; }
  double at(Index i, Index j) const { return values_[static_cast<std::size_t>(i * n_ + j)]; }
  void set_all_above(double limit, double value) {
    for (double& v : values_)
      if (v > limit) v = value;
  }

 private:
  Index n_;
  std::vector<double> values_;
};

/// The components of some points by the edges below a value.
std::vector<Members> components_below(const Values& values, Members left, double value) {
  std::vector<Members> found;
  while (!left.empty()) {
    Members component{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < component.size(); ++i)
      std::erase_if(left, [&](Index j) {
        if (!(values.at(component[i], j) < value)) return false;
        component.push_back(j);
        return true;
      });
    found.push_back(component);
  }
  return found;
}

/// The largest value of an edge without which the points fall apart.
double breaking_value(const Values& values, const Members& points) {
  std::set<double> all;
  for (const Index i : points)
    for (const Index j : points)
      if (i != j) all.insert(values.at(i, j));
  for (auto value = all.rbegin(); value != all.rend(); ++value)
    if (components_below(values, points, *value).size() > 1) return *value;
  return kInf;
}

struct PlainCluster {
  Members points;  // just below its top
  double top = kInf;
  double bottom = kInf;
  std::map<Index, double> leaves_at = {};  // of the points of the cluster itself
  std::vector<PlainCluster> children = {};

  double least() const {
    double least = bottom;
    for (const PlainCluster& child : children) least = std::min(least, child.least());
    return least;
  }
  /// The sum over the points of the cluster, also of those that go on in a child.
  double mass() const {
    double sum = 0;
    for (const Index p : points) {
      const auto own = leaves_at.find(p);
      sum += 1 / (own == leaves_at.end() ? bottom : own->second) - 1 / top;
    }
    return sum;
  }
};

PlainCluster cluster_from(const Values& values, Members points, Index min_size, double top) {
  PlainCluster cluster{.points = points, .top = top};
  while (true) {
    const double value = breaking_value(values, points);
    std::vector<PlainCluster> real;
    std::vector<Members> parts = components_below(values, points, value);
    const auto is_real = [&](const Members& part) {
      return static_cast<Index>(part.size()) >= min_size;
    };
    const auto count = std::ranges::count_if(parts, is_real);
    if (points.size() > 1)
      for (const Members& part : parts)
        if (count > 0 && !is_real(part))
          for (const Index p : part) cluster.leaves_at[p] = value;
    if (count == 1) {
      points = *std::ranges::find_if(parts, is_real);
      continue;
    }
    cluster.bottom = value;
    if (count == 0)
      for (const Index p : points) cluster.leaves_at[p] = value;
    else
      for (const Members& part : parts)
        if (is_real(part)) cluster.children.push_back(cluster_from(values, part, min_size, value));
    return cluster;
  }
}

PlainCluster root_of(const Values& values, Index min_size) {
  Members all(static_cast<std::size_t>(values.size()));
  std::iota(all.begin(), all.end(), Index{0});
  return cluster_from(values, all, min_size, kInf);
}

/// The clusters of a tree, each with the points just below its top.
std::map<Members, std::uint32_t> members_of(const ClusterTree& tree) {
  std::vector<Members> points(tree.clusters().size());
  for (Index p = 0; p < tree.size(); ++p)
    for (std::int64_t c = tree.cluster_of()[std::size_t(p)]; c >= 0;
         c = tree.clusters()[std::size_t(c)].parent)
      points[std::size_t(c)].push_back(p);
  std::map<Members, std::uint32_t> found;
  for (std::uint32_t c = 0; c < points.size(); ++c) found[points[c]] = c;
  return found;
}

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

struct Sample {
  Points points;
  Index k, min_size;
};
/// Points in clusters, in general position or with ties and copies.
Sample sample_of(Generator& random, bool ties, Index most) {
  Points points = random.points(random.integer(1, int(most)), random.integer(1, 3), ties);
  if (random.coin())
    for (Index i = 0; i < points.rows(); ++i)
      for (Index a = 0; a < points.cols(); ++a)
        points(i, a) = points(i, a) / 8 + double(i % random.integer(1, 4));
  if (random.integer(0, 3) == 0)
    for (Index i = 1; i < points.rows(); ++i)
      if (random.coin()) copy_point(points, random.integer(0, int(i) - 1), points, i);
  const Index k = random.integer(0, int(std::min<Index>(points.rows() - 1, 6)));
  return {std::move(points), k, random.integer(2, 6)};
}

ClusterTree tree_of(const Sample& sample) {
  return {Rips(sample.points, {.core_neighbours = sample.k}), sample.min_size};
}

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

}  // namespace
}  // namespace ph::test
