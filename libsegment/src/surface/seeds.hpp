// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph::segment {

/// For each voxel, the distance along the surface from the nearest of some evenly spread seeds. The
/// seeds are a greedy permutation of the voxels, continued until each voxel has a seed within
/// `spacing` (metres, > 0). Each connected piece without a seed also gets one. A step through a
/// seam counts for more than its length, by a factor that grows with the concavity. The distance
/// therefore has a ridge where two objects meet. The cost is much less than voxels times seeds,
/// because once the seeds are dense, a new seed is compared only with voxels near it.
/// @param edges the edges between adjacent voxels, whose values are their lengths.
/// @param concavity the concavity at each voxel.
std::vector<double> distance_to_seeds(const Points& centroids,
                                      const std::vector<WeightedEdge>& edges,
                                      const std::vector<double>& concavity, double spacing,
                                      const RunContext& context);

}  // namespace ph::segment
