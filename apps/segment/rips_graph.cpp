// SPDX-License-Identifier: MIT
#include "rips_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "ph/metric/pairs_within.hpp"

namespace ph::segment {
namespace {

/// filtration_value for many lengths: the levels are computed once.
class Levels {
 public:
  Levels(double distance, int steps) : distance_(distance), steps_(steps) {
    constexpr int most = 4096;
    if (steps < 1 || steps > most || !(distance > 0)) return;
    per_length_ = steps / distance;
    for (int k = 0; k < steps; ++k) levels_.push_back(k * distance / steps);
    levels_.push_back(distance);
  }
  double round_up(double length) const {
    return levels_.empty() ? filtration_value(length, distance_, steps_) : levels_[place(length)];
  }
  /// Sorts edges that have levels for values, if these are few.
  void sort(std::pmr::vector<WeightedEdge>& edges) const {
    if (levels_.empty()) return;
    std::vector<std::size_t> next(levels_.size() + 1);
    for (const WeightedEdge& e : edges) ++next[place(e.value) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::pmr::vector<WeightedEdge> sorted(edges.size(), edges.get_allocator());
    for (const WeightedEdge& e : edges) sorted[next[place(e.value)]++] = e;
    edges.swap(sorted);
  }

 private:
  std::size_t place(double length) const {
    // Rounding may miss the level by one: look at the neighbours, too.
    std::size_t k = std::min(static_cast<std::size_t>(length * per_length_), levels_.size() - 1);
    while (k > 0 && levels_[k - 1] >= length) --k;
    while (levels_[k] < length) ++k;
    return k;
  }

  double distance_;
  int steps_;
  double per_length_ = 0;
  std::vector<double> levels_;  // empty: too many to keep, or exact lengths
};

}  // namespace

FilteredGraph rips_graph(const Points& points, double distance, int steps,
                         const RunContext& context) {
  std::pmr::vector<WeightedEdge> edges(&context.memory);
  constexpr std::size_t of_a_surface = 12;  // edges a voxel, where it reaches two voxels far
  edges.reserve(of_a_surface * static_cast<std::size_t>(points.rows()));
  const Levels levels(distance, steps);
  Ticker ticker(context, "complex");
  for_each_pair_within(
      points, distance,
      [&](Index i, Index j, double length) {
        edges.push_back({i, j, levels.round_up(length)});
        ticker.tick();
      },
      context);
  levels.sort(edges);
  const std::vector<double> births(static_cast<std::size_t>(points.rows()), 0.0);
  return FilteredGraph(births, edges, context);
}

double filtration_value(double length, double distance, int steps) {
  if (steps == 0 || length == 0) return length;
  const auto level = [&](double k) { return k == steps ? distance : k * distance / steps; };
  // The division may round to the wrong side of a level: look at the neighbours, too.
  double k = std::clamp(std::ceil(length / distance * steps), 1.0, static_cast<double>(steps));
  while (k > 1 && level(k - 1) >= length) --k;
  while (k < steps && level(k) < length) ++k;
  return level(k);
}

}  // namespace ph::segment
