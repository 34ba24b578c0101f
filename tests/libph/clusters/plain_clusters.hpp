// SPDX-License-Identifier: MIT
// Clusters by their definition: from the top down, on the matrix of all values. And samples of
// points.
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "ph/cluster_tree.hpp"
#include "ph/rips.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"

namespace ph::test {

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
inline std::vector<Members> components_below(const Values& values, Members left, double value) {
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
inline double breaking_value(const Values& values, const Members& points) {
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

inline PlainCluster cluster_from(const Values& values, Members points, Index min_size, double top) {
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

inline PlainCluster root_of(const Values& values, Index min_size) {
  Members all(static_cast<std::size_t>(values.size()));
  std::iota(all.begin(), all.end(), Index{0});
  return cluster_from(values, all, min_size, kInf);
}

/// The clusters of a tree, each with the points just below its top.
inline std::map<Members, std::uint32_t> members_of(const ClusterTree& tree) {
  std::vector<Members> points(tree.clusters().size());
  for (Index p = 0; p < tree.size(); ++p)
    for (std::int64_t c = tree.cluster_of()[std::size_t(p)]; c >= 0;
         c = tree.clusters()[std::size_t(c)].parent)
      points[std::size_t(c)].push_back(p);
  std::map<Members, std::uint32_t> found;
  for (std::uint32_t c = 0; c < points.size(); ++c) found[points[c]] = c;
  return found;
}

struct Sample {
  Points points;
  Index k, min_size;
};
/// Points in clusters, in general position or with ties and copies.
inline Sample sample_of(Generator& random, bool ties, Index most) {
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

inline ClusterTree tree_of(const Sample& sample) {
  return {Rips(sample.points, {.core_neighbours = sample.k}), sample.min_size};
}

}  // namespace ph::test
