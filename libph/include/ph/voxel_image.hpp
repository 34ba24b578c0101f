// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/core/names.hpp"
#include "ph/image.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// An image of a point cloud.
struct PointImage {
  Image image;
  /// Centre of the voxel at (0, …, 0), in the coordinates of the points.
  std::vector<double> first;
  double voxel = 0;  ///< edge length of a voxel
};

/// The meaning of the values of voxels that are made from a point cloud. Low values enter first.
enum class VoxelValue {
  /// The distance from the voxel's centre to the centre of the nearest voxel that contains a point.
  /// Sublevel sets are growing balls around the points, as in the alpha filtration, but the time is
  /// proportional to the numbers of points and voxels. With `Cubical`, they show how many pieces,
  /// loops and hollows the cloud has, and how wide these are. This value differs from the distance
  /// to the points by at
  /// most voxel * sqrt(d), which bounds the error of every bar (Cohen-Steiner, Edelsbrunner &
  /// Harer, Stability of persistence diagrams, 2007).
  distance,
  occupancy,  ///< 0 if the voxel contains a point; otherwise absent, see Image::masked
  density,    ///< the negated number of points in the voxel; absent if there are none
};

template <>
inline constexpr std::array names_of<VoxelValue>{
    Named{VoxelValue::distance, "distance"},
    Named{VoxelValue::occupancy, "occupancy"},
    Named{VoxelValue::density, "density"},
};

/// The voxels of a grid around a point cloud, as an image.
///
/// O(points + d * voxels) (distances: Felzenszwalb & Huttenlocher, Distance transforms of sampled
/// functions, 2012). Takes 8 bytes per voxel and, while it computes distances, 24 bytes per voxel
/// along the longest axis. Axis k of the image is coordinate k.
/// @param points finite, one per row, 1 to 8 columns. @param voxel edge length of a voxel, > 0, in
/// the unit of the points. @param margin voxels around the bounding box, >= 0.
/// @throws Error (bad_data) without points or with coordinates that are not finite; Error (usage)
///         on an invalid voxel, margin or number of columns; Error (resource) if the image is too
///         large, or beyond the memory limit; Error (cancelled) on a stop request.
PointImage voxel_image(PointsView points, double voxel, VoxelValue value = VoxelValue::distance,
                       Index margin = 1, const RunContext& context = default_context());

}  // namespace ph
