// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/run_context.hpp"

namespace ph::gpu {

/// The minimum spanning forest of fewer than 2^32 - 1 points, edge for edge and bit for bit that of
/// ph::spanning_forest, in the order of edges; found by a GPU of NVIDIA, the first that CUDA names.
/// @throws Error (not_built_in) if libph was built without PH_WITH_CUDA, or there is no GPU; Error
///         (usage) unless the metric is plain Euclidean; Error (resource) if the memory of the GPU
///         is too small; Error (cancelled).
FlagEdges spanning_forest(const PointMetric& metric, double limit, const RunContext& context);

}  // namespace ph::gpu
