// SPDX-License-Identifier: MIT
#include "alpha/pairs/pair_simplices.hpp"

#include "alpha/pairs/components.hpp"
#include "alpha/pairs/hollows.hpp"
#include "alpha/pairs/loops.hpp"

namespace ph::alpha {

namespace {

template <Field K>
void pair_all(const AlphaCells& cells, const K& field, const RunContext& context, AlphaBars& bars) {
  const int dim = cells.dim();
  const bool wants_loops = dim == 3 && bars.wants(1);
  const bool wants_components = bars.wants(0) || (dim >= 2 && bars.wants(1));
  const RankedSimplices edges =
      wants_components ? ranked_edges(cells, context) : RankedSimplices(&context.memory);
  SimplexSet edge_joins(&context.memory);
  if (wants_components) pair_components(cells, edges, field, context, bars, edge_joins);
  if (dim == 2 && bars.wants(1))
    // What joins no components closes a loop: each joins hollows.
    Hollows<K>(cells, field, context, bars)
        .run(
            edges, [&](std::size_t i) { return !edge_joins[i]; }, [](std::size_t) {});
  if (dim < 3 || !(wants_loops || bars.wants(2))) return;
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
