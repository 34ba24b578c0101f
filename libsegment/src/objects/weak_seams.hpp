// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "ph/run_context.hpp"
#include "voxels/voxel_pairs.hpp"

namespace ph::segment {

/// Joins basins that are kept apart by less than a seam. Persistence judges a seam by its lowest
/// place, where noise and a seam may look alike; over their whole lengths they do not. The strength
/// of a seam is the lower quartile of the filtration along it. The weakest one goes first, and what
/// it kept apart is one basin for all that come after it.
/// @param basin_of each voxel: one of the voxels of its basin. @param births of the voxels.
/// @param pairs those closer than `radius` have an edge, its value the later of the two births.
/// @param least strength of a seam that stays. @return the same for the basins that are left.
/// @throws Error (cancelled) as `context` asks.
std::vector<Index> join_over_weak_seams(const std::vector<Index>& basin_of,
                                        const std::vector<double>& births,
                                        std::span<const VoxelPair> pairs, double radius,
                                        double least,
                                        const RunContext& context = default_context());

}  // namespace ph::segment
