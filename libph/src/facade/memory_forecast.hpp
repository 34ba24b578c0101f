// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/estimate.hpp"

namespace ph::detail {

/// A lower and an upper bound, in bytes, for the expected peak memory of a computation.
struct MemoryForecast {
  double low = 0, high = 0;
};

/// The highest dimension in which an engine lists simplices of a Rips complex.
int listed_rips_dim(Engine engine, int max_dim);

/// Forecasts the memory that computing the homology of a Rips complex needs, including the edges.
/// The engine is run on three small parts of the complex. The memory that it needs for them, apart
/// from edges and bit rows or adjacency lists, is extrapolated to the entire complex. If the
/// complex is small, the engine is run on the entire complex instead. The engine is not run on a
/// forest.
/// @param cells the number of cells of each dimension, up to listed_rips_dim. @param options must
///        name an engine and a dimension, without a collapse.
MemoryForecast forecast_rips(const RipsGraph& graph, std::span<const double> cells,
                             const Options& options, const RunContext& context);

/// Forecasts the same memory as `forecast_rips` if there are too many edges to list them. The
/// forecast uses the approximate number of edges.
MemoryForecast forecast_edges(Index vertices, double edges, const Options& options);

/// Forecasts the memory of an engine that needs only the points. The engine is run on two samples
/// of the points, and the memory that it needs for them is extrapolated.
/// @param points must be enough for the engine. @param options must name an engine.
MemoryForecast forecast_points(PointsView points, std::optional<double> threshold,
                               const Options& options, const RunContext& context);

/// Forecasts the memory for an image that is paired voxel by voxel. The lower bound is for a smooth
/// image, which has almost no critical cells. The upper bound is for noise. @param stored the bytes
/// of the image and of the data kept per voxel.
MemoryForecast forecast_voxels(double stored, double voxels, double cells,
                               bool with_representatives);

/// Forecasts the memory for an alpha complex whose simplices are paired by intervals.
MemoryForecast forecast_intervals(double stored, bool with_representatives);

/// Forecasts the memory for any other complex that numbers or stores its cells, from the number of
/// cells alone.
MemoryForecast forecast_cells(double stored, std::span<const double> cells);

}  // namespace ph::detail
