// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/detail/core/engine.hpp"
#include "ph/detail/reduction/homology_reduction.hpp"

namespace ph {

/// Persistent homology: boundary columns from the highest dimension down, with clearing.
struct TwistEngine {
  static constexpr Engine id = Engine::twist;
  template <Filtration F>
  static bool can_run(const F&, const Task& task) {
    return task.representatives != Representatives::cocycles && task.wants_no_sets();
  }
  /// Chosen by measurement. If cells are numbered, columns are few and short in both directions,
  /// and reducing boundaries is faster. If cells are not numbered, listing the cells of the next
  /// dimension takes too much time.
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    if (SlottedFiltration<F>) return {3, "the complex numbers its cells"};
    return {1, "the complex lists facets only"};
  }
  static constexpr int listed_dim(int max_dim) { return max_dim + 1; }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    prepare_cells(f, context);
    HomologyReduction<F, K> reduction(f, field, bars, context);
    for (int dim = std::min(bars.max_dim() + 1, f.top_dim()); dim >= 0; --dim)
      reduction.reduce_dimension(dim);
  }
};

}  // namespace ph
