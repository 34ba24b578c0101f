// SPDX-License-Identifier: MIT
#include "apps/cluster/data/make_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "apps/common/inputs/read_data.hpp"
#include "ph/distance_to_measure.hpp"

namespace ph::cluster {
namespace {

/// The core distances of points of which only some distances are known. They are infinite where
/// fewer are known than there should be neighbours.
std::vector<double> core_distances(const SparseDistances& some, Index neighbours,
                                   const RunContext& context) {
  const auto k = static_cast<std::size_t>(neighbours);
  std::vector<double> core(static_cast<std::size_t>(some.size()), k == 0 ? 0 : kInfinity);
  if (k == 0) return core;
  const MemoryClaim claim(context.memory, 2 * some.edges().size() * sizeof(double));
  std::vector<std::vector<double>> of_point(core.size());
  for (const WeightedEdge& e : some.edges())
    for (const Index end : {e.u, e.v}) of_point[static_cast<std::size_t>(end)].push_back(e.value);
  for (std::size_t i = 0; i < core.size(); ++i) {
    if (of_point[i].size() < k) continue;
    const auto last = of_point[i].begin() + (neighbours - 1);
    std::ranges::nth_element(of_point[i], last);
    core[i] = *last;  // mutant: cluster-core
  }
  return core;
}

/// Distances that are infinite for some points.
struct WithoutPoints {
  DistanceMatrix all;
  std::vector<bool> is_out;

  Index size() const { return all.size(); }
  double operator()(Index i, Index j) const {
    const bool is_known =
        !is_out[static_cast<std::size_t>(i)] && !is_out[static_cast<std::size_t>(j)];
    return i == j || is_known ? all(i, j) : kInfinity;
  }
};

SparseDistances without(const SparseDistances& some, const std::vector<bool>& is_out) {
  std::vector<WeightedEdge> edges;
  for (const WeightedEdge& e : some.edges())
    if (!is_out[static_cast<std::size_t>(e.u)] && !is_out[static_cast<std::size_t>(e.v)])
      edges.push_back(e);
  return {some.size(), std::move(edges)};
}

WithoutPoints without(const DistanceMatrix& all, std::vector<bool> is_out) {
  return {all, std::move(is_out)};
}

/// The filtration of distances with births.
template <class Distances>
Rips filtration_of(const Distances& distances, RipsOptions options, const RunContext& context) {
  std::vector<bool> is_out(options.births.size());
  for (std::size_t i = 0; i < is_out.size(); ++i)
    if (std::isinf(options.births[i])) {
      is_out[i] = true;
      options.births[i] = 0;
    }
  if (std::ranges::count(is_out, true) == 0) return Rips(distances, std::move(options), context);
  return Rips(without(distances, is_out), std::move(options), context);
}

Rips filtration_of(const ReadResult& read, const Arguments& a, Index neighbours,
                   const RunContext& context) {
  RipsOptions options = a.rips;
  if (const auto points = app::points_of(read)) {
    options.core_neighbours = neighbours;
    return Rips::borrowed(*points, std::move(options), context);
  }
  if (const auto* some = std::get_if<SparseDistances>(&read.data)) {
    options.births = core_distances(*some, neighbours, context);
    return filtration_of(*some, std::move(options), context);
  }
  const auto& all = std::get<DistanceMatrix>(read.data);
  if (!a.has_births()) options.births = ph::core_distances(all, neighbours, context);
  return filtration_of(all, std::move(options), context);
}

}  // namespace

Index neighbours_of(const Arguments& a, Index points) {
  const Index others = std::max<Index>(points - 1, 0);
  if (!a.neighbours) return std::min(a.min_size - 1, others);
  if (*a.neighbours > others && points > 0)
    throw Error(ErrorKind::usage,
                fmt::format("--neighbours: found {}, expected at most the number of other points, "
                            "{}",
                            *a.neighbours, others));
  return std::min(*a.neighbours, others);
}

ClusterTree make_tree(const Loaded& loaded, const Arguments& a, Index neighbours,
                      const RunContext& context) {
  try {
    const Rips rips = filtration_of(loaded.read, a, neighbours, context);
    return ClusterTree(rips, a.min_size, context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}", mark_place(loaded.name), error.marked()));
  }
}

}  // namespace ph::cluster
