// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"
#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// For each voxel how far it is, along the surface, from the nearest of some seeds that are spread
/// evenly: a greedy permutation of the voxels, as far as it takes for each voxel to have a seed
/// within `spacing` (metres, > 0), and a seed for each connected piece without one. A step through
/// a seam counts for as many times its length as the seam is concave, so that where two objects
/// meet the distance has a ridge. Nowhere as slow as voxels times seeds: once the seeds are dense a
/// new one is compared only with what is near it.
/// @param edges between adjacent voxels, their values the lengths. @param concavity of each voxel.
std::vector<double> distance_to_seeds(const Points& centroids,
                                      const std::vector<WeightedEdge>& edges,
                                      const std::vector<double>& concavity, double spacing,
                                      const RunContext& context);

}  // namespace ph::segment
