// SPDX-License-Identifier: MIT
#include "libph/src/alpha/alpha_engine.hpp"

#include "libph/src/alpha/pairs/components.hpp"
#include "libph/src/alpha/pairs/hollows.hpp"
#include "libph/src/alpha/pairs/loops.hpp"

namespace ph::alpha {

namespace {

/// Pairs the simplices of dimensions 1 and 2. First, edges join components, from old to young. In
/// dimension 2, the other edges then join hollows, from young to old. In a periodic space, some
/// edges join neither and give birth to essential classes, and the top dimension may have an
/// essential class.
template <Field K>
void pair_plane(const AlphaCells& cells, const K& field, const RunContext& context,
                AlphaBars& bars) {
  const int dim = cells.dim();
  const bool wants_hollows = dim == 2 && (bars.wants(1) || (cells.is_periodic && bars.wants(2)));
  if (!wants_hollows && !bars.wants(0) && !cells.is_periodic) return;
  const RankedSimplices edges = ranked_edges(cells, context);
  SimplexSet is_paired(edges.size(), false, &context.memory);
  pair_components(cells, edges, field, context, bars, [&](std::size_t i) { is_paired[i] = true; });
  if (wants_hollows)
    // mutant: alpha-plane-loops
    Hollows<K>(cells, field, context, bars)
        .run(
            edges, [&](std::size_t i) { return !is_paired[i]; },
            [&](std::size_t i) { is_paired[i] = true; });
  if (!cells.is_periodic || !bars.wants(1)) return;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!is_paired[i])
      bars.essential(1, edges[i].value, [&] {
        const auto ends = ends_of(cells, edges[i]);
        return Simplex::of({ends[0], ends[1]});
      });
}

/// Pairs the simplices of dimension 3. Edges join components, and triangles join hollows. Loops
/// pairs the remaining edges and triangles. Lists are freed as soon as they are no longer needed.
template <Field K>
void pair_space(const AlphaCells& cells, const K& field, const RunContext& context,
                AlphaBars& bars) {
  const bool wants_loops = bars.wants(1) || (cells.is_periodic && bars.wants(2));
  const bool wants_hollows = wants_loops || bars.wants(2) || (cells.is_periodic && bars.wants(3));
  SimplexSet joins(cells.edge_states.size(), false, &context.memory);  // indexed by edge
  if (wants_loops || bars.wants(0)) {
    const RankedSimplices edges = ranked_edges(cells, context);
    pair_components(cells, edges, field, context, bars,
                    [&](std::size_t i) { joins[edges[i].number] = true; });
  }
  if (!wants_hollows) return;
  std::pmr::vector<std::uint32_t> column_of(cells.facets.size(), kNone, &context.memory);
  {
    const RankedSimplices facets = ranked_facets(cells, context);
    for (std::uint32_t i = 0; i < facets.size(); ++i) column_of[facets[i].number] = i;
    Hollows<K>(cells, field, context, bars)
        .run(
            facets, [](std::size_t) { return true; },
            [&](std::size_t i) { column_of[facets[i].number] = kNone; });
  }
  if (wants_loops) Loops<K>(cells, joins, column_of, field, context).run(bars);
}

}  // namespace

template <Field K>
void pair_simplices(const Alpha& alpha, const K& field, BarcodeBuilder<Alpha>& builder,
                    const RunContext& context) {
  AlphaBars bars(alpha, builder);
  if (alpha.cells().dim() == 3)
    pair_space(alpha.cells(), field, context, bars);
  else
    pair_plane(alpha.cells(), field, context, bars);
  bars.flush();
}

template void pair_simplices(const Alpha&, const Z2&, BarcodeBuilder<Alpha>&, const RunContext&);
template void pair_simplices(const Alpha&, const Zp&, BarcodeBuilder<Alpha>&, const RunContext&);

}  // namespace ph::alpha
