// SPDX-License-Identifier: MIT
#include "alpha/pairs/pair_simplices.hpp"

#include "alpha/pairs/components.hpp"
#include "alpha/pairs/hollows.hpp"
#include "alpha/pairs/loops.hpp"

namespace ph::alpha {

namespace {

/// H1 of dimension 1 and 2 that never dies: what an edge closes that joins neither components nor
/// hollows. In a periodic space only.
void report_essential_edges(const AlphaCells& cells, const RankedSimplices& edges,
                            const SimplexSet& joins, AlphaBars& bars) {
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!joins[i])
      bars.essential(1, edges[i].value, [&] {
        const auto ends = ends_of(cells, edges[i]);
        return Simplex::of({ends[0], ends[1]});
      });
}

template <Field K>
void pair_all(const AlphaCells& cells, const K& field, const RunContext& context, AlphaBars& bars) {
  const int dim = cells.dim();
  // In a periodic space the highest dimension may have a class, and that below has classes that
  // never die.
  const bool wants_top = cells.is_periodic && bars.wants(dim);
  const bool wants_loops = dim == 3 && (bars.wants(1) || (cells.is_periodic && bars.wants(2)));
  const bool wants_components =
      bars.wants(0) || (dim < 3 && cells.is_periodic) || (dim >= 2 && bars.wants(1)) || wants_loops;
  const RankedSimplices edges =
      wants_components ? ranked_edges(cells, context) : RankedSimplices(&context.memory);
  SimplexSet edge_joins(&context.memory);
  if (wants_components) pair_components(cells, edges, field, context, bars, edge_joins);
  if (dim == 2 && (bars.wants(1) || wants_top)) {
    // What joins no components closes a loop: it joins hollows.
    SimplexSet joins = edge_joins;
    Hollows<K>(cells, field, context, bars)
        .run(
            edges, [&](std::size_t i) { return !edge_joins[i]; },
            [&](std::size_t i) { joins[i] = true; });
    edge_joins.swap(joins);
  }
  if (dim < 3 && cells.is_periodic && bars.wants(1))
    report_essential_edges(cells, edges, edge_joins, bars);
  if (dim < 3 || !(wants_loops || wants_top || bars.wants(2))) return;
  const RankedSimplices facets = ranked_facets(cells, context);
  SimplexSet facet_joins(facets.size(), false, &context.memory);
  Hollows<K>(cells, field, context, bars)
      .run(
          facets, [](std::size_t) { return true; }, [&](std::size_t i) { facet_joins[i] = true; });
  if (wants_loops)
    Loops<K>(cells, edges, edge_joins, facets, facet_joins, field, context).run(bars);
}

}  // namespace

template <Field K>
void pair_simplices(const Alpha& alpha, const K& field, BarcodeBuilder<Alpha>& builder,
                    const RunContext& context) {
  AlphaBars bars(alpha, builder);
  pair_all(alpha.cells(), field, context, bars);
  bars.flush();
}

template void pair_simplices(const Alpha&, const Z2&, BarcodeBuilder<Alpha>&, const RunContext&);
template void pair_simplices(const Alpha&, const Zp&, BarcodeBuilder<Alpha>&, const RunContext&);

}  // namespace ph::alpha
