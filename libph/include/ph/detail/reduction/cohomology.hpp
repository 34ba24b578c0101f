// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/detail/components/union_find.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/reduction/cohomology_reduction.hpp"
#include "ph/detail/reduction/homology_reduction.hpp"

namespace ph {

/// Persistent cohomology: coboundary columns from dimension 0 up, with clearing, apparent and
/// emergent pairs (Bauer, Ripser: efficient computation of Vietoris-Rips persistence barcodes).
/// Lists cells of dimension max_dim + 1 only as cofacets. Without representatives, computes H0 by
/// union-find where that is valid.
struct CohomologyEngine {
  static constexpr Engine id = Engine::cohomology;
  template <Filtration F>
  static bool can_run(const F&, const Task& task) {
    return CofacetFiltration<F> && task.wants_no_sets();
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return {2, "cells of the highest dimension are too many to list"};
  }
  static constexpr int listed_dim(int max_dim) { return max_dim; }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (CofacetFiltration<F>) {
      prepare_cells(f, context);
      if (bars.representatives() == Representatives::cycles) {
        find_cycles(f, field, bars, context);
        return;
      }
      CohomologyReduction<F, K> reduction(f, field, bars, context);
      int dim = 0;
      if constexpr (GraphFiltration<F>) {
        if (bars.representatives() == Representatives::none && is_graph_like(f)) {
          CellMap<F> death_cells(f, &context.memory);
          join_components(f, field, bars, context,
                          [&](const auto& edge) { death_cells.insert(edge, 0); });
          reduction.set_cleared(std::move(death_cells));
          dim = 1;
        }
      }
      for (; dim <= std::min(bars.max_dim(), f.top_dim()); ++dim) reduction.reduce_dimension(dim);
    }
  }

 private:
  // Involuted homology (Čufar & Virk, Fast computation of persistent homology representatives with
  // involuted persistent homology): cohomology finds the cells that kill a class and the cells that
  // give birth to an essential class; only their boundaries are reduced.
  template <Filtration F, Field K>
  static void find_cycles(const F& f, const K& field, BarcodeBuilder<F>& bars,
                          const RunContext& context) {
    BarcodeBuilder<F> no_bars(f, -1, bars.wants_zero_length() ? -1 : 0);
    CohomologyReduction<F, K> cohomology(f, field, no_bars, context);
    HomologyReduction<F, K> homology(f, field, bars, context);
    std::pmr::vector<typename F::Cell> columns(&context.memory);
    const int top = std::min(bars.max_dim(), f.top_dim());
    for (int dim = 0; dim <= top; ++dim) {
      cohomology.reduce_dimension(dim);
      columns.insert(columns.end(), cohomology.essential().begin(), cohomology.essential().end());
      homology.reduce_columns(dim, columns);
      columns.assign(cohomology.death_cells().begin(), cohomology.death_cells().end());
    }
    homology.reduce_columns(top + 1, columns);
  }
};

}  // namespace ph
