// SPDX-License-Identifier: MIT
// Chooses clusters from a ClusterTree.
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/clusters/cluster_data.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using Cluster = ClusterTree::Cluster;
using Flags = std::vector<bool>;

std::size_t root_of(std::span<const Cluster> clusters) { return clusters.size() - 1; }

Flags leaves(std::span<const Cluster> clusters, const ClusterOptions& options) {
  Flags is_leaf(clusters.size(), true);
  for (const Cluster& c : clusters)
    if (c.parent >= 0) is_leaf[static_cast<std::size_t>(c.parent)] = false;
  if (!options.allow_single) is_leaf[root_of(clusters)] = false;
  return is_leaf;
}

/// The clusters whose mass is at least the largest total mass of clusters inside them.
Flags heaviest(std::span<const Cluster> clusters, const ClusterOptions& options) {
  // Sums of numbers in ascending order do not depend on the order in which clusters are numbered.
  std::vector<std::vector<double>> below(clusters.size());
  Flags is_heavier(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Cluster& c = clusters[i];
    std::ranges::sort(below[i]);
    double best = 0;
    for (const double mass : below[i]) best += mass;
    below[i] = {};
    const bool may_be_chosen = (i != root_of(clusters) || options.allow_single) &&
                               (options.max_size == 0 || c.size <= options.max_size);
    is_heavier[i] = may_be_chosen && c.mass >= best;  // mutant: cluster-mass
    if (c.parent >= 0)
      below[static_cast<std::size_t>(c.parent)].push_back(is_heavier[i] ? c.mass : best);
  }
  return is_heavier;
}

/// Of nested clusters, leaves the outermost one.
/// @return for each cluster, the chosen cluster at or around it, or -1.
std::vector<std::int64_t> outermost(std::span<const Cluster> clusters, const Flags& candidates) {
  std::vector<std::int64_t> chosen(clusters.size(), -1);
  for (std::size_t i = clusters.size(); i-- > 0;) {
    const std::int64_t parent = clusters[i].parent;
    const std::int64_t around = parent < 0 ? -1 : chosen[static_cast<std::size_t>(parent)];
    chosen[i] = around >= 0 ? around : candidates[i] ? static_cast<std::int64_t>(i) : -1;
  }
  return chosen;
}

/// For each chosen cluster, the first cluster at or around it that joins others at `epsilon` or
/// above.
Flags widened(std::span<const Cluster> clusters, const std::vector<std::int64_t>& chosen,
              const ClusterOptions& options) {
  Flags wide(clusters.size());
  const auto root = static_cast<std::int64_t>(root_of(clusters));
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (chosen[i] != static_cast<std::int64_t>(i)) continue;
    std::size_t at = i;
    while (clusters[at].top < options.epsilon && clusters[at].parent >= 0 &&
           (options.allow_single || clusters[at].parent != root))
      at = static_cast<std::size_t>(clusters[at].parent);
    wide[at] = true;
  }
  return wide;
}

void check(const ClusterOptions& options) {
  if (!(options.epsilon >= 0))
    throw Error(ErrorKind::usage,
                fmt::format("epsilon: found {}, expected a number >= 0", options.epsilon));
  if (options.max_size < 0)
    throw Error(ErrorKind::usage,
                fmt::format("max_size: found {}, expected 0 or more points", options.max_size));
}

/// The chosen clusters of a tree that is not empty.
class Choice {
 public:
  Choice(std::span<const Cluster> tree, const ClusterOptions& options)
      : chosen_(outermost(tree, options.method == ClusterMethod::leaf ? leaves(tree, options)
                                                                      : heaviest(tree, options))),
        root_(static_cast<std::int64_t>(root_of(tree))),
        limit_of_root_(options.epsilon > 0 ? options.epsilon : tree.back().bottom) {
    if (options.epsilon > 0) chosen_ = outermost(tree, widened(tree, chosen_, options));
  }

  /// @param value the value at which a point leaves a cluster.
  /// @return the chosen cluster of the point; -1: it is noise.
  std::int64_t of(std::uint32_t cluster, double value) const {
    const std::int64_t c = chosen_[cluster];
    return c == root_ && value > limit_of_root_ ? -1 : c;
  }

 private:
  std::vector<std::int64_t> chosen_;  // by cluster: the chosen cluster at or around it, or -1
  std::int64_t root_;
  double limit_of_root_;  // a point that leaves the root at a larger value is noise
};

}  // namespace

Index ClusterTree::size() const { return static_cast<Index>(data_->cluster_of.size()); }
Index ClusterTree::min_size() const { return data_->min_size; }
ClusterScale ClusterTree::scale() const { return data_->scale; }
std::span<const ClusterTree::Cluster> ClusterTree::clusters() const { return data_->clusters; }
std::span<const std::uint32_t> ClusterTree::cluster_of() const { return data_->cluster_of; }
std::span<const double> ClusterTree::leaves_at() const { return data_->leaves_at; }

Clusters ClusterTree::select(const ClusterOptions& options) const {
  check(options);
  const Data& data = *data_;
  Clusters result;
  if (data.clusters.empty()) return result;
  const Choice choice(data.clusters, options);
  std::vector<Index> label(data.clusters.size(), -1);
  result.labels.resize(data.cluster_of.size(), -1);
  result.probabilities.resize(data.cluster_of.size());
  for (std::size_t p = 0; p < data.cluster_of.size(); ++p) {
    const double value = data.leaves_at[p];
    const std::int64_t c = choice.of(data.cluster_of[p], value);
    if (c < 0) continue;
    Index& number = label[static_cast<std::size_t>(c)];
    if (number < 0) {
      number = static_cast<Index>(result.chosen.size());
      result.chosen.push_back(static_cast<std::uint32_t>(c));
    }
    result.labels[p] = number;
    result.probabilities[p] =
        data.life.share(data.clusters[static_cast<std::size_t>(c)].bottom, value);
  }
  return result;
}

Clusters ClusterTree::locate(std::span<const Attachment> added,
                             const ClusterOptions& options) const {
  const Data& data = *data_;
  for (const Attachment& a : added)
    if (a.point >= size())
      throw Error(ErrorKind::usage,
                  fmt::format("point: found {}, expected one of the {} points", a.point, size()));
  Clusters result{std::vector<Index>(added.size(), -1), std::vector<double>(added.size()),
                  select(options).chosen};
  if (result.chosen.empty()) return result;
  const Choice choice(data.clusters, options);
  std::vector<Index> label(data.clusters.size(), -1);
  for (std::size_t i = 0; i < result.chosen.size(); ++i)
    label[result.chosen[i]] = static_cast<Index>(i);
  for (std::size_t i = 0; i < added.size(); ++i) {
    const auto [point, joins_at] = added[i];
    if (point < 0) continue;
    std::uint32_t cluster = data.cluster_of[static_cast<std::size_t>(point)];
    while (data.clusters[cluster].top <= joins_at &&  // mutant: cluster-joins
           data.clusters[cluster].parent >= 0)
      cluster = static_cast<std::uint32_t>(data.clusters[cluster].parent);
    const double value = std::max(data.leaves_at[static_cast<std::size_t>(point)], joins_at);
    const std::int64_t c = choice.of(cluster, value);
    if (c < 0 || label[static_cast<std::size_t>(c)] < 0) continue;
    result.labels[i] = label[static_cast<std::size_t>(c)];
    result.probabilities[i] =
        data.life.share(data.clusters[static_cast<std::size_t>(c)].bottom, value);
  }
  return result;
}

std::vector<double> ClusterTree::outlier_scores() const {
  const Data& data = *data_;
  std::vector<double> scores(data.cluster_of.size());
  for (std::size_t p = 0; p < scores.size(); ++p)
    scores[p] = 1 - data.life.share(data.clusters[data.cluster_of[p]].least, data.leaves_at[p]);
  return scores;
}

}  // namespace ph
