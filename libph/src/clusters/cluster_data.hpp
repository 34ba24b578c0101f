// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ph/cluster_tree.hpp"

namespace ph::detail {

/// The life of clusters and points as a function of the value, see ClusterScale.
class Lifetime {
 public:
  /// @param largest the largest finite value of an edge.
  Lifetime(ClusterScale scale, double largest) : scale_(scale), largest_(largest) {}

  double operator()(double value) const {
    switch (scale_) {
      case ClusterScale::linear:
        return value < kInfinity ? largest_ - value : 0;
      case ClusterScale::logarithmic:
        if (value == 0) return kInfinity;
        return value < kInfinity ? std::log(largest_) - std::log(value) : 0;
      case ClusterScale::inverse:
        break;
    }
    return 1 / value;
  }
  /// The quotient of the lives until `value` and until `end`, at most 1.
  double share(double end, double value) const {
    if (value <= end) return 1;
    if (!(value < kInfinity)) return 0;
    if (scale_ == ClusterScale::inverse) return end / value;
    const double until_end = (*this)(end);
    return until_end < kInfinity ? (*this)(value) / until_end : 0;
  }

 private:
  ClusterScale scale_;
  double largest_;
};

}  // namespace ph::detail

namespace ph {

struct ClusterTree::Data {
  Index min_size;
  ClusterScale scale;
  detail::Lifetime life;
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> cluster_of;  // by point
  std::vector<double> leaves_at;          // by point
  // Only for a tree from which others are made: the points by (cluster, value), and for each
  // cluster its first place in that order, and the end.
  std::vector<std::uint32_t> order = {};
  std::vector<std::uint32_t> first = {};
};

/// The clusters of a tree while the value grows. Their masses are sums, whose order depends only on
/// the values.
class ClusterTree::Growth {
 public:
  explicit Growth(Data& data) : life_(data.life), clusters_(data.clusters) {}

  std::uint32_t add(double value) {
    clusters_.push_back({.bottom = value, .least = value});
    last_.push_back(value);
    return static_cast<std::uint32_t>(clusters_.size() - 1);
  }
  /// Counts the time that the points of a cluster have spent in it since the last value at which
  /// its size changed.
  void live(std::uint32_t cluster, double value) {
    Cluster& c = clusters_[cluster];
    c.mass += (life_(last_[cluster]) - life_(value)) * static_cast<double>(c.size);
    last_[cluster] = value;
  }
  /// The child joins other clusters. Precondition: it has lived until this value.
  void join(std::uint32_t child, std::uint32_t parent, double value) {
    Cluster& c = clusters_[child];
    c.top = value;
    c.parent = parent;
    clusters_[parent].least = std::min(clusters_[parent].least, c.least);
  }

 private:
  const detail::Lifetime life_;
  std::vector<Cluster>& clusters_;
  std::vector<double> last_;  // by cluster: the last value at which its size changed
};

}  // namespace ph
