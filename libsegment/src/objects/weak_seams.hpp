// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/run_context.hpp"

namespace ph::segment {

/// Joins basins that a seam separates too weakly. Persistence judges a seam by its lowest place,
/// where noise and a true seam may look alike. Over their whole length, noise and a true seam
/// differ. The strength of a seam is therefore the lower quartile of the filtration along it. The
/// two basins at the weakest seam are joined first, and count as one basin from then on.
/// @param basin_of for each voxel, one of the voxels of its basin. @param births the births of the
/// voxels.
/// @param pairs pairs of voxels. A pair with a distance below `radius` has an edge, whose value is
/// the later of the two births.
/// @param least the strength below which a seam is removed.
/// @return for each voxel, one of the voxels of its final basin.
/// @throws Error (cancelled) as `context` asks.
std::vector<Index> join_over_weak_seams(const std::vector<Index>& basin_of,
                                        const std::vector<double>& births,
                                        std::span<const VoxelPair> pairs, double radius,
                                        double least,
                                        const RunContext& context = default_context());

}  // namespace ph::segment
