// SPDX-License-Identifier: MIT
#include "libph/src/alpha/triangulation/triangulation.hpp"

#include <algorithm>

#include "libph/src/alpha/triangulation/triangulations.hpp"

namespace ph::alpha {

Triangulation triangulate(const Sites& sites, const RunContext& context) {
  if (sites.size() == 0) return Triangulation(&context.memory);
  return sites.coordinates == 3 ? triangulate_space(sites, context)
                                : triangulate_plane(sites, context);
}

void remove_hidden(Sites& sites, Triangulation& triangulation,
                   std::pmr::vector<std::uint32_t>& hidden) {
  // The heaviest copy hides the others.
  // mutant: alpha-hidden-copies
  for (const auto& [copy, site] : sites.copies) hidden.push_back(copy);
  sites.copies.clear();
  std::pmr::vector<std::uint32_t> number(sites.size(), kNone, hidden.get_allocator());
  for (const auto& cell : triangulation.cells)
    for (const std::uint32_t v : cell)
      if (v != kNone) number[v] = 0;
  std::uint32_t kept = 0;
  for (std::uint32_t site = 0; site < number.size(); ++site) {
    if (number[site] == kNone) {
      hidden.push_back(sites.input[site]);  // mutant: alpha-hidden
      continue;
    }
    number[site] = kept;
    sites.points[kept] = sites.points[site];
    sites.weights[kept] = sites.weights[site];
    sites.input[kept++] = sites.input[site];
  }
  sites.points.resize(kept);
  sites.weights.resize(kept);
  sites.input.resize(kept);
  for (auto& cell : triangulation.cells)
    for (std::uint32_t& v : cell)
      if (v != kNone) v = number[v];
  std::ranges::sort(hidden);
}

}  // namespace ph::alpha
