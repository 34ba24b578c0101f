// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/engine/engine.hpp"
#include "ph/engine/reduction.hpp"
#include "ph/engine/union_find.hpp"

namespace ph {

/// Persistent cohomology: coboundary columns from dimension 0 up, with clearing, apparent and
/// emergent pairs (Bauer, Ripser: efficient computation of Vietoris-Rips persistence barcodes).
/// Never lists cells of dimension max_dim + 1 but as cofacets. H0 by union-find where that is right.
struct CohomologyEngine {
  static constexpr Engine id = Engine::cohomology;
  static constexpr const char* name = "cohomology";
  template <Filtration F>
  static bool can_run(const F&, int) {
    return CofacetFiltration<F>;
  }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (CofacetFiltration<F>) {
      Reduction<F, K, Direction::cohomology> reduction(f, field, bars, context);
      int dim = 0;
      if constexpr (GraphFiltration<F>) {
        if (is_graph_like(f)) {
          reduction.set_cleared(pair_components(f, bars, context));
          dim = 1;
        }
      }
      for (; dim <= std::min(bars.max_dim(), f.top_dim()); ++dim) reduction.reduce_dimension(dim);
    }
  }
};

}  // namespace ph
