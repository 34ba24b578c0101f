// SPDX-License-Identifier: MIT
#pragma once
#include <numeric>

#include "alpha/pairs/alpha_bars.hpp"
#include "alpha/pairs/critical_simplices.hpp"
#include "alpha/pairs/edge_column.hpp"
#include "alpha/pairs/edge_forest.hpp"
#include "cubical/columns/parallel_reduction.hpp"

namespace ph::alpha {

/// H1 of dimension 3: the boundaries of the triangles that union-find has left over, reduced. They
/// are begun in the order in which they lie in space, not by age, so that what a column needs is
/// near; an older column takes a pivot over (see ParallelReduction).
template <Field K>
class Loops {
  using Chain = EdgeColumn<K>;
  using Reduction = cubical::ParallelReduction<K, Chain>;
  using Column = typename Reduction::Column;

 public:
  /// @param edges, facets critical ones. @param edge_joins, facet_joins by their places: whether
  /// they join components, or hollows.
  Loops(const AlphaCells& cells, const RankedSimplices& edges, const SimplexSet& edge_joins,
        const RankedSimplices& facets, const SimplexSet& facet_joins, const K& field,
        const RunContext& context)
      : cells_(cells),
        edges_(edges),
        edge_joins_(edge_joins),
        field_(field),
        context_(context),
        joins_(cells.edge_states.size(), false, &context.memory),
        columns_(&context.memory),
        column_of_(cells.facets.size(), kNone, &context.memory),
        owners_(cells.edge_states.size(), nullptr, &context.memory) {
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (edge_joins[i]) joins_[edges[i].number] = true;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (facet_joins[i]) continue;
      column_of_[facets[i].number] = static_cast<std::uint32_t>(columns_.size());
      columns_.push_back(facets[i].number);
    }
  }

  void run(AlphaBars& bars) {
    // Of several columns that end at one edge the content may depend on which came first, though
    // their ends do not. Cycles are to be the same for any number of threads.
    const bool in_turn = bars.wants_cycles();
    Reduction reduction(columns_.size(), field_, context_, in_turn ? 1 : Reduction::kLanes);
    constexpr std::size_t piece = 256;  // columns that a thread takes at a time
    reduction.run(
        "loops", in_turn ? std::max<std::size_t>(columns_.size(), 1) : piece,
        [&] { return Chain(cells_, joins_, field_, context_); },
        [&](Chain& chain, std::uint32_t i) { chain.assign_boundary(code_of(i)); },
        [&](const EdgeName& pivot) -> const Column*& { return owners_[pivot.edge]; },
        [&](const EdgeName& pivot) { __builtin_prefetch(&owners_[pivot.edge]); },
        [&](std::span<std::uint32_t> round) { sort_in_space(round); });
    report(bars);
  }

 private:
  std::uint32_t code_of(std::uint32_t column) const { return cells_.facets[columns_[column]].code; }
  void sort_in_space(std::span<std::uint32_t> round) const {
    if (round.size() < columns_.size()) {
      std::ranges::sort(round, {}, [&](std::uint32_t column) { return columns_[column]; });
      return;
    }
    std::size_t next = 0;
    for (const std::uint32_t column : column_of_)
      if (column != kNone) round[next++] = column;
  }
  void report(AlphaBars& bars) {
    std::optional<EdgeForest<K>> forest;
    std::pmr::vector<EdgeTerm<K>> cycle(&context_.memory);
    Ticker ticker(context_, {}, edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      ticker.tick();
      if (edge_joins_[i]) continue;
      const std::uint32_t e = edges_[i].number;
      const Column* const column = owners_[e];
      if (column == nullptr) continue;
      const CriticalFacet& killer = cells_.facets[columns_[column->number()]];
      if (!bars.pair(1, edges_[i].value, killer.value, edge_simplex(cells_, e),
                     facet_simplex(cells_, killer.code)))
        continue;
      if (!forest) forest.emplace(cells_, joins_, field_, context_);
      cycle.clear();
      const auto scale = field_.inverse(column->pivot().coefficient());
      cycle.push_back({e, field_.from_int(1)});
      for (const auto& term : column->below())
        cycle.push_back({term.cell.edge, field_.multiply(scale, term.coefficient())});
      forest->close(cycle);
      for (const EdgeTerm<K>& term : cycle)
        bars.add_term(edge_simplex(cells_, term.edge), field_.to_int(term.coefficient));
      bars.finish_cycle(field_.is_zero(field_.from_int(2)));
    }
  }

  const AlphaCells& cells_;
  const RankedSimplices& edges_;
  const SimplexSet& edge_joins_;
  const K& field_;
  const RunContext& context_;
  SimplexSet joins_;                           // by edge
  std::pmr::vector<std::uint32_t> columns_;    // from old to young: their facets
  std::pmr::vector<std::uint32_t> column_of_;  // by critical facet
  std::pmr::vector<const Column*> owners_;     // by edge: the column with that pivot
};

}  // namespace ph::alpha
