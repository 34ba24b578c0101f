// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/alpha/pairs/alpha_bars.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::alpha {

/// Computes H0 by Kruskal's algorithm on the critical edges and the elder rule. Other edges do not
/// join components. For example, an edge that is paired with a triangle enters together with that
/// triangle, whose other two edges already connect the ends of the edge.
/// @param on_join called with the position in `edges` of each edge that joins components.
template <Field K, class OnJoin>
void pair_components(const AlphaCells& cells, const RankedSimplices& edges, const K& field,
                     const RunContext& context, AlphaBars& bars, OnJoin&& on_join) {
  const auto sites = static_cast<std::uint32_t>(cells.sites.size());
  DisjointSets sets(sites, &context.memory);
  // A late vertex enters with an edge to an earlier vertex.
  if (!cells.vertex_up.empty())
    for (std::uint32_t v = 0; v < sites; ++v) {
      std::uint32_t up = cells.vertex_up[v];
      if (up == kCritical) continue;
      if (cells.dim() == 3) {
        const auto& ends = cells.edges.ends[up];
        up = ends[0] == v ? ends[1] : ends[0];
      }
      sets.link(v, sets.find(up));  // mutant: alpha-late-component
    }
  const auto is_older = [&](std::uint32_t u, std::uint32_t v) {
    const double a = cells.vertex_value(u), b = cells.vertex_value(v);
    return a != b ? a < b : u < v;  // mutant: alpha-elder
  };
  std::size_t left = sites;  // the number of components
  for (const std::uint32_t up : cells.vertex_up) left -= up != kCritical ? 1 : 0;
  if (bars.wants(0)) bars.expect(left, edges);
  Ticker ticker(context, "components", edges.size());
  for (std::size_t i = 0; i < edges.size() && left > 1; ++i) {
    ticker.tick();
    constexpr std::size_t ahead = 8;
    if (i + 2 * ahead < edges.size()) {
      prefetch_ends(cells, edges[i + 2 * ahead]);
      for (const std::uint32_t v : ends_of(cells, edges[i + ahead])) sets.prefetch(v);
    }
    const auto ends = ends_of(cells, edges[i]);
    std::uint32_t elder = sets.find(ends[0]), younger = sets.find(ends[1]);
    if (elder == younger) continue;
    if (is_older(younger, elder)) std::swap(elder, younger);
    sets.link(younger, elder);
    on_join(i);
    --left;
    if (!bars.wants(0)) continue;
    const bool wants_cycle = bars.pair(
        0, cells.vertex_value(younger), edges[i].value, [&] { return Simplex::of({younger}); },
        [&] {
          return Simplex::of({ends[0], ends[1]});
        });
    if (!wants_cycle) continue;
    bars.add_term(Simplex::of({younger}), 1);
    bars.add_term(Simplex::of({elder}), -1);
    bars.finish_cycle(field.add(field.from_int(1), field.from_int(1)) == field.from_int(0));
  }
  if (!bars.wants(0)) return;
  for (std::uint32_t v = 0; v < sites; ++v)
    if (sets.find(v) == v &&
        bars.essential(0, cells.vertex_value(v), [&] { return Simplex::of({v}); })) {
      bars.add_term(Simplex::of({v}), 1);
      bars.finish_cycle(false);
    }
}

}  // namespace ph::alpha
