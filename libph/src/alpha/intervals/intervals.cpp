// SPDX-License-Identifier: MIT
#include "libph/src/alpha/intervals/intervals.hpp"

#include <algorithm>
#include <limits>

namespace ph::alpha {

const CriticalFacet* critical_facet(const AlphaCells& cells, std::uint32_t code) {
  code = std::min(code, cells.across(code));  // kNone is larger than any code
  const auto at = std::ranges::lower_bound(cells.facets, code, {}, &CriticalFacet::code);
  return at != cells.facets.end() && at->code == code ? &*at : nullptr;
}

double facet_value(const AlphaCells& cells, std::uint32_t code) {
  return facet_value(cells, code, critical_facet(cells, code));
}

double facet_value(const AlphaCells& cells, std::uint32_t code, const CriticalFacet* critical) {
  if (critical != nullptr) return critical->value;
  const std::uint32_t other = cells.across(code);
  if (cells.belongs_to(code)) return cells.cell_values[code >> 2];
  if (other != kNone && cells.belongs_to(other)) return cells.cell_values[other >> 2];
  // The facet is the upper end of its interval, and is paired with one of its own faces.
  if (cells.dim() == 2) {
    const auto ends = cells.facet_vertices(code);
    return cells.vertex_values[cells.vertex_up[ends[0]] == ends[1] ? ends[0] : ends[1]];
  }
  for (const std::uint32_t e : cells.facet_edges(code)) {
    const std::uint32_t up = cells.edge_states[e].up;
    if (up == code || (up == other && other != kNone)) return cells.edge_states[e].value;
  }
  return std::numeric_limits<double>::quiet_NaN();  // this line is never reached
}

}  // namespace ph::alpha
