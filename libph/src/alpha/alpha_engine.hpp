// SPDX-License-Identifier: MIT
#pragma once
#include "ph/alpha.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph::alpha {

/// Computes the bars of positive length of an alpha complex.
template <Field K>
void pair_simplices(const Alpha& alpha, const K& field, BarcodeBuilder<Alpha>& bars,
                    const RunContext& context);

extern template void pair_simplices(const Alpha&, const Z2&, BarcodeBuilder<Alpha>&,
                                    const RunContext&);
extern template void pair_simplices(const Alpha&, const Zp&, BarcodeBuilder<Alpha>&,
                                    const RunContext&);

}  // namespace ph::alpha

namespace ph {

/// Computes the bars of alpha complexes in all dimensions, except bars of length zero. Simplices
/// are first paired inside their intervals (see AlphaCells). The remaining simplices are paired by
/// union-find in the lowest and the highest dimension, and by matrix reduction in the dimensions
/// between them. The engine gives cycles, except in a periodic space. It gives no cocycles. See
/// docs/explanation/engines/alpha.md.
struct AlphaEngine {
  static constexpr Engine id = Engine::gradient;
  static bool can_run(const Alpha& alpha, const Task& task) {
    return alpha.value_kind() == AlphaOptions::Value::alpha && !task.zero_length &&
           (task.representatives == Representatives::none ||
            (task.representatives == Representatives::cycles && !alpha.is_periodic()));
  }
  static Suitability suitability(const Alpha&, const Task&) {
    return {6, "an alpha complex is paired interval by interval"};
  }
  static constexpr int listed_dim(int) { return -1; }

  template <Field K>
  static void run(const Alpha& alpha, const K& field, BarcodeBuilder<Alpha>& bars,
                  const RunContext& context) {
    alpha::pair_simplices(alpha, field, bars, context);
  }
};

}  // namespace ph
