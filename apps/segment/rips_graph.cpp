// SPDX-License-Identifier: MIT
#include "rips_graph.hpp"

#include <algorithm>
#include <cmath>

#include "ph/metric/pairs_within.hpp"

namespace ph::segment {

FilteredGraph rips_graph(const Points& points, double distance, int steps,
                         const RunContext& context) {
  std::pmr::vector<WeightedEdge> edges(&context.memory);
  Ticker ticker(context, "complex");
  for_each_pair_within(points, distance, [&](Index i, Index j, double length) {
    edges.push_back({i, j, filtration_value(length, distance, steps)});
    ticker.tick();
  });
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
