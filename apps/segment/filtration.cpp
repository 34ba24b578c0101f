// SPDX-License-Identifier: MIT
#include "filtration.hpp"

#include <algorithm>
#include <cmath>

namespace ph::segment {

double filtration_value(double value, double distance, int steps) {
  if (steps == 0 || value == 0) return value;
  const auto level = [&](double k) { return k == steps ? distance : k * distance / steps; };
  // The division may round to the wrong side of a level: look at the neighbours, too.
  double k = std::clamp(std::ceil(value / distance * steps), 1.0, static_cast<double>(steps));
  while (k > 1 && level(k - 1) >= value) --k;
  while (k < steps && level(k) < value) ++k;
  return level(k);
}

Rips rips_filtration(const Points& vertices, double distance, int steps,
                     const RunContext& context) {
  const SparseDistances near = SparseDistances::within(vertices, distance);
  if (steps == 0) return Rips(near, {.threshold = distance}, context);
  std::vector<WeightedEdge> edges = near.edges();
  for (WeightedEdge& e : edges) e.value = filtration_value(e.value, distance, steps);
  return Rips(SparseDistances(near.size(), std::move(edges)), {.threshold = distance}, context);
}

}  // namespace ph::segment
