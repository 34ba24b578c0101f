// SPDX-License-Identifier: MIT
// Makes a ClusterTree from the edges of a spanning forest, from the leaves up.
#include <fmt/format.h>

#include <algorithm>
#include <memory_resource>
#include <numeric>
#include <utility>

#include "libph/src/clusters/cluster_data.hpp"
#include "libph/src/facade/rips_plan.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/error.hpp"
#include "ph/merge_tree.hpp"
#include "ph/rips.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

void check(Index points, Index min_size) {
  if (min_size < 2)
    throw Error(ErrorKind::usage, fmt::format("min_size: found {}, expected at least 2", min_size));
  if (points >= Index{kNone})
    throw Error(ErrorKind::resource,
                fmt::format("clusters: found {} points, expected fewer than 2^32 - 1", points));
}

/// @param edges ascending and finite. @return the scale of their values.
detail::Lifetime lifetime_of(ClusterScale scale, std::span<const FlagEdge> edges) {
  if (scale != ClusterScale::linear && !edges.empty() && edges.front().value < 0)
    throw Error(ErrorKind::usage,
                fmt::format("clusters: found the value {}, expected values >= 0 with the scale "
                            "{}; use the scale linear",
                            edges.front().value, name_of(scale)));
  return {scale, edges.empty() ? 0 : edges.back().value};
}

}  // namespace

/// The components of a growing value. Only small components, of fewer than `min_size` points, need
/// lists of their points: the points of a cluster are assigned as soon as they join it.
class ClusterTree::Condenser {
 public:
  Condenser(Data& data, Index points, const RunContext& context)
      : data_(data),
        min_size_(static_cast<std::uint32_t>(std::min<Index>(data.min_size, kNone))),
        sets_(static_cast<std::size_t>(points), &context.memory),
        next_(static_cast<std::size_t>(points), &context.memory),
        size_(next_.size(), 1, &context.memory),
        cluster_(next_.size(), kNone, &context.memory),
        order_(&context.memory),
        ticker_(context, "clusters", next_.size()) {
    context.memory.require(next_.size() * (2 * sizeof(std::uint32_t) + sizeof(double)));
    std::iota(next_.begin(), next_.end(), 0U);
    data_.cluster_of.resize(next_.size());
    data_.leaves_at.resize(next_.size());
    order_.reserve(next_.size());
  }

  /// @param edges ascending and finite.
  void run(std::span<const FlagEdge> edges) {
    for (auto begin = edges.begin(); begin != edges.end();) {
      const auto end = std::find_if(begin, edges.end(),
                                    [&](const FlagEdge& e) { return e.value != begin->value; });
      join({begin, end});
      ticker_.tick(static_cast<std::uint64_t>(end - begin));
      begin = end;
    }
    join_at_infinity();
    finish();
  }

 private:
  /// A component just before a join.
  struct Part {
    std::uint32_t whole;  // the root after the join
    std::uint32_t root;   // the root before it; a member of the component
    std::uint32_t cluster;
  };

  /// Joins components by all edges of one value.
  void join(std::span<const FlagEdge> edges) {
    parts_.clear();
    for (const FlagEdge& e : edges) {
      const std::uint32_t u = sets_.find(e.u), v = sets_.find(e.v);
      if (u == v) continue;
      for (const std::uint32_t root : {u, v}) parts_.push_back({0, root, cluster_[root]});
    }
    if (parts_.empty()) return;
    if (parts_.size() > 2) {  // several edges may have a common end
      const auto by_root = [](const Part& part) { return part.root; };
      std::ranges::sort(parts_, {}, by_root);
      const auto rest = std::ranges::unique(parts_, {}, by_root);
      parts_.erase(rest.begin(), rest.end());
    }
    for (const FlagEdge& e : edges) link(sets_.find(e.u), sets_.find(e.v));
    for (Part& part : parts_) part.whole = sets_.find(part.root);
    std::ranges::stable_sort(parts_, {}, &Part::whole);
    for_each_run(edges.front().value);
  }
  void join_at_infinity() {
    parts_.clear();
    for (std::uint32_t p = 0; p < next_.size(); ++p)
      if (sets_.find(p) == p) parts_.push_back({0, p, cluster_[p]});
    if (parts_.size() < 2) return;
    for (const Part& part : parts_) link(sets_.find(part.root), sets_.find(parts_[0].root));
    for (Part& part : parts_) part.whole = sets_.find(part.root);
    for_each_run(kInfinity);
  }
  /// The larger set survives, which keeps the paths to roots short.
  void link(std::uint32_t a, std::uint32_t b) {
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    sets_.link(b, a);
    size_[a] += size_[b];
  }
  /// @param value the value at which parts with the same root after the join become one component.
  void for_each_run(double value) {
    last_value_ = value;
    for (auto begin = parts_.begin(); begin != parts_.end();) {
      const auto end = std::find_if(begin, parts_.end(),
                                    [&](const Part& part) { return part.whole != begin->whole; });
      become_one({begin, end}, value);
      begin = end;
    }
  }
  void become_one(std::span<const Part> parts, double value) {
    const std::uint32_t whole = parts.front().whole;
    std::uint32_t real = 0, cluster = kNone;
    for (const Part& part : parts) {
      if (part.cluster == kNone) continue;
      ++real;
      cluster = part.cluster;
    }
    if (real == 1)
      growth_.live(cluster, value);
    else if (real > 1 || size_[whole] >= min_size_)  // mutant: cluster-real
      cluster = growth_.add(value);
    for (const Part& part : parts) {
      if (cluster == kNone)
        splice(part.root, parts.front().root);
      else if (part.cluster == kNone)
        assign(part.root, cluster, value);
      else if (part.cluster != cluster) {
        growth_.live(part.cluster, value);
        growth_.join(part.cluster, cluster, value);
      }
    }
    cluster_[whole] = cluster;
    if (cluster != kNone) data_.clusters[cluster].size = size_[whole];
  }
  void splice(std::uint32_t a, std::uint32_t b) {
    if (a != b) std::swap(next_[a], next_[b]);
  }
  /// All points of a small component leave a cluster.
  void assign(std::uint32_t root, std::uint32_t cluster, double value) {
    std::uint32_t p = root;
    do {
      data_.cluster_of[p] = cluster;
      data_.leaves_at[p] = value;
      order_.push_back(p);
      p = next_[p];
    } while (p != root);
  }

  void finish() {
    const std::size_t n = next_.size();
    if (n == 0) return;
    if (const std::uint32_t root = sets_.find(0); cluster_[root] == kNone) {
      // There are fewer points than a cluster has, so the root is not a real component.
      const std::uint32_t cluster = growth_.add(last_value_);
      data_.clusters[cluster].size = static_cast<Index>(n);
      assign(root, cluster, last_value_);
    }
    growth_.live(static_cast<std::uint32_t>(data_.clusters.size() - 1), kInfinity);
    // The points were assigned in ascending order of their values, which the sort keeps.
    data_.first.assign(data_.clusters.size() + 1, 0);
    for (const std::uint32_t c : data_.cluster_of) ++data_.first[c + 1];
    std::partial_sum(data_.first.begin(), data_.first.end(), data_.first.begin());
    data_.order.resize(n);
    std::vector<std::uint32_t> place(data_.first.begin(), data_.first.end() - 1);
    for (const std::uint32_t p : order_) data_.order[place[data_.cluster_of[p]]++] = p;
  }

  Data& data_;
  Growth growth_{data_};
  const std::uint32_t min_size_;
  DisjointSets sets_;
  std::pmr::vector<std::uint32_t> next_;     // circular lists of the points of small components
  std::pmr::vector<std::uint32_t> size_;     // by root
  std::pmr::vector<std::uint32_t> cluster_;  // by root: kNone for a small component
  std::pmr::vector<std::uint32_t> order_;    // the points as they were assigned
  std::vector<Part> parts_;
  double last_value_ = kInfinity;  // the value of the last join
  Ticker ticker_;
};

namespace {

const RipsGraph& forest_of(const Rips& rips, const RunContext& context) {
  const RipsGraph& graph = rips.graph(detail::form_of_tree(rips), context);
  if (graph.has_names())
    throw Error(ErrorKind::usage,
                "clusters: found points that are not vertices, because only some vertices are "
                "selected, equal points are merged, or the threshold is below some births "
                "(weights); expected all points as vertices");
  return graph;
}

FlagEdges edges_of(const MergeTree& tree, const RunContext& context) {
  FlagEdges edges(&context.memory);
  edges.reserve(tree.merges.size());
  for (const Merge& m : tree.merges)
    edges.push_back({m.value, static_cast<std::uint32_t>(m.u), static_cast<std::uint32_t>(m.v)});
  return edges;
}

}  // namespace

std::shared_ptr<const ClusterTree::Data> ClusterTree::condensed(std::span<const FlagEdge> edges,
                                                                Index points, Index min_size,
                                                                ClusterScale scale,
                                                                const RunContext& context) {
  check(points, min_size);
  // All components that are left are joined at infinity at once, with or without such edges.
  const auto is_finite = [](const FlagEdge& e) { return e.value < kInfinity; };
  edges = {edges.begin(), std::ranges::partition_point(edges, is_finite)};
  auto data = std::make_shared<Data>(Data{min_size, scale, lifetime_of(scale, edges), {}, {}, {}});
  Condenser(*data, points, context).run(edges);
  return data;
}

ClusterTree::ClusterTree(const Rips& rips, Index min_size, const RunContext& context) {
  check(rips.size(), min_size);
  const RipsGraph& forest = forest_of(rips, context);
  data_ = condensed(forest.edges(), forest.size(), min_size, ClusterScale::inverse, context);
  finest_ = data_;
}

ClusterTree::ClusterTree(Index points, std::span<const WeightedEdge> edges, Index min_size,
                         ClusterScale scale, const RunContext& context) {
  check(points, min_size);
  FlagEdges sorted(&context.memory);
  sorted.reserve(edges.size());
  for (const WeightedEdge& e : edges) {
    if (std::min(e.u, e.v) < 0 || std::max(e.u, e.v) >= points || std::isnan(e.value))
      throw Error(
          ErrorKind::usage,
          fmt::format("clusters: found the edge ({}, {}) of value {}, expected two of the {} "
                      "points and a number",
                      e.u, e.v, e.value, points));
    sorted.push_back({e.value, static_cast<std::uint32_t>(e.u), static_cast<std::uint32_t>(e.v)});
  }
  std::ranges::sort(sorted, precedes);
  data_ = condensed(sorted, points, min_size, scale, context);
  finest_ = data_;
}

ClusterTree::ClusterTree(const MergeTree& tree, Index min_size, ClusterScale scale,
                         const RunContext& context) {
  check(tree.size(), min_size);
  data_ = condensed(edges_of(tree, context), tree.size(), min_size, scale, context);
  finest_ = data_;
}

}  // namespace ph
