// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/estimate.hpp"

namespace ph::detail {

/// Bytes between which the peak of a computation is expected to lie.
struct MemoryForecast {
  double low = 0, high = 0;
};

/// The highest dimension of which an engine lists simplices of a Rips complex.
int listed_rips_dim(Engine engine, int max_dim);

/// What the homology of a Rips complex takes beside its edges. The engine computes three small
/// parts of the complex; what it takes there beyond its bit rows or adjacency is extrapolated.
/// @param cells by dimension, up to listed_rips_dim. @param options with engine and dimension; no
/// collapse.
MemoryForecast forecast_rips(const RipsGraph& graph, std::span<const double> cells,
                             const Options& options, const RunContext& context);

/// The same with the edges, which are too many to be made, from about how many there are.
MemoryForecast forecast_edges(Index vertices, double edges, const Options& options);

/// The same for an engine that takes the points alone: it computes two samples of them.
/// @param points not too few of which the engine takes by name. @param options with engine.
MemoryForecast forecast_points(PointsView points, std::optional<double> threshold,
                               const Options& options, const RunContext& context);

/// The same for an image that is paired voxel by voxel: between a smooth one, with next to no
/// critical cells, and noise. @param stored with what is kept of each voxel.
MemoryForecast forecast_voxels(double stored, double voxels, double cells,
                               bool with_representatives);

/// The same for an alpha complex that is paired by its intervals.
MemoryForecast forecast_intervals(double stored, bool with_representatives);

/// The same for a complex that numbers or stores its cells, from the size of its parts alone.
MemoryForecast forecast_cells(double stored, std::span<const double> cells);

}  // namespace ph::detail
