// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/run_context.hpp"

namespace ph::gpu {

/// The minimum spanning forest of fewer than 2^32 - 1 points, found on the first NVIDIA GPU that
/// CUDA lists. The edges are sorted, and equal to the edges of ph::spanning_forest bit for bit.
/// @throws Error (not_built_in) if libph was built without PH_WITH_CUDA, or there is no GPU; Error
///         (usage) unless the metric is plain Euclidean; Error (resource) if the GPU has too little
///         memory; Error (cancelled).
FlagEdges spanning_forest(const PointMetric& metric, double limit, const RunContext& context);

}  // namespace ph::gpu
