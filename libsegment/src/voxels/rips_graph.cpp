// SPDX-License-Identifier: MIT
#include "libsegment/src/voxels/rips_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ph/detail/metric/pairs_within.hpp"

namespace ph::segment {
namespace {

/// The values of `filtration_value` for lengths up to `distance`, if there are few of them.
class Levels {
 public:
  Levels(double distance, int steps) {
    constexpr int most = 4096;
    if (steps < 1 || steps > most || !(distance > 0)) return;
    per_length_ = steps / distance;
    for (int k = 0; k < steps; ++k) values_.push_back(k * distance / steps);
    values_.push_back(distance);
  }
  // The number of levels, or 0 if there are too many levels or if lengths are exact.
  std::size_t size() const { return values_.size(); }
  double operator[](std::size_t k) const { return values_[k]; }
  /// The first level that is not below a length.
  std::uint32_t above(double length) const {
    // Rounding may miss the level by one. The neighbouring levels are therefore checked as well.
    auto k = std::min(static_cast<std::size_t>(length * per_length_), values_.size() - 1);
    while (k > 0 && values_[k - 1] >= length) --k;
    while (values_[k] < length) ++k;
    return static_cast<std::uint32_t>(k);
  }

 private:
  double per_length_ = 0;
  std::vector<double> values_;
};

using Edges = std::pmr::vector<WeightedEdge>;

// The number of edges per voxel of a surface, if edges span two voxels.
constexpr std::size_t kEdgesOfAVoxel = 12;

Edges edges_with_values(const Points& points, double distance, int steps,
                        const RunContext& context) {
  Edges edges(&context.memory);
  edges.reserve(kEdgesOfAVoxel * static_cast<std::size_t>(points.rows()));
  for_each_pair_within(
      points, distance,
      [&](Index i, Index j, double length) {
        edges.push_back({i, j, filtration_value(length, distance, steps)});
      },
      context);
  return edges;
}

/// Sorts the edges by value without comparisons.
Edges edges_by_level(const Points& points, double distance, const Levels& levels,
                     const RunContext& context) {
  struct Edge {
    std::uint32_t u, v, level;
  };
  std::pmr::vector<Edge> edges(&context.memory);
  edges.reserve(kEdgesOfAVoxel * static_cast<std::size_t>(points.rows()));
  std::vector<std::size_t> next(levels.size() + 1);  // for each level, the place of its next edge
  for_each_pair_within(
      points, distance,
      [&](Index i, Index j, double length) {
        const std::uint32_t level = levels.above(length);
        edges.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), level});
        ++next[level + 1];
      },
      context);
  std::partial_sum(next.begin(), next.end(), next.begin());
  Edges sorted(edges.size(), &context.memory);
  for (const auto& [u, v, level] : edges) sorted[next[level]++] = {u, v, levels[level]};
  return sorted;
}

}  // namespace

FilteredGraph rips_graph(const Points& points, double distance, int steps,
                         const RunContext& context) {
  const Levels levels(distance, steps);
  const Edges edges = levels.size() > 0 ? edges_by_level(points, distance, levels, context)
                                        : edges_with_values(points, distance, steps, context);
  const std::vector<double> births(static_cast<std::size_t>(points.rows()), 0.0);
  return FilteredGraph(births, edges, context);
}

double filtration_value(double length, double distance, int steps) {
  if (steps == 0 || length == 0) return length;
  const auto level = [&](double k) { return k == steps ? distance : k * distance / steps; };
  // The division may round to the wrong side of a level. The neighbouring levels are therefore
  // checked as well.
  double k = std::clamp(std::ceil(length / distance * steps), 1.0, static_cast<double>(steps));
  while (k > 1 && level(k - 1) >= length) --k;
  while (k < steps && level(k) < length) ++k;
  return level(k);
}

}  // namespace ph::segment
