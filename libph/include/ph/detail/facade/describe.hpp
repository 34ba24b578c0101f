// SPDX-License-Identifier: MIT
#pragma once
#include "ph/persistence.hpp"

namespace ph::detail {

/// The origin of bars that an engine computed, as far as the task states it.
/// @param max_dim the highest dimension that was computed. @param engine the engine that ran.
BarcodeInfo info_of_task(const Options& options, int max_dim, Engine engine);

// Adds the facts about a complex.
void describe(const CubicalImage& image, BarcodeInfo& info);
void describe(const Cubical& cubical, BarcodeInfo& info);
void describe(const ExplicitComplex& complex, BarcodeInfo& info);
void describe(const Alpha& alpha, BarcodeInfo& info);
void describe(const FilteredGraph& graph, BarcodeInfo& info);
/// Also states the threshold and the subsample, which are known only once the form is made.
/// @throws as `facts`.
void describe(const Rips& rips, const RunPlan& plan, BarcodeInfo& info, const RunContext& context);
/// A complex of the user.
template <class F>
void describe(const F&, BarcodeInfo& info) {
  info.complex = "custom";
}

}  // namespace ph::detail
