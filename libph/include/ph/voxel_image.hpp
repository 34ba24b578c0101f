// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/image.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// An image of a point cloud.
struct PointImage {
  Image image;
  std::vector<double>
      first;         ///< centre of the voxel at (0, …, 0), in the coordinates of the points
  double voxel = 0;  ///< edge of a voxel
};

/// What a voxel of a point cloud is worth. Low values enter first.
enum class VoxelValue {
  /// The distance of its centre from that of the nearest voxel with a point in it. Sublevel sets
  /// are balls around the points that grow together, as in the alpha filtration, at a cost that
  /// depends on the volume alone: with `Cubical` they tell how many pieces, loops and hollows the
  /// cloud has, and how wide these are. Within voxel * sqrt(d) of the distance to the points, which
  /// bounds the error of every bar (Cohen-Steiner, Edelsbrunner & Harer, Stability of persistence
  /// diagrams, 2007).
  distance,
  occupancy,  ///< 0 where a point is in it; elsewhere it is absent, see Image::masked
  density,    ///< minus the number of points in it; absent where there is none
};

/// The voxels of a grid around a point cloud, as an image.
///
/// O(points + d * voxels) (distances: Felzenszwalb & Huttenlocher, Distance transforms of sampled
/// functions, 2012), 8 bytes a voxel, and while it computes distances 24 bytes for each voxel along
/// the longest axis. Axis k of the image is coordinate k.
/// @param points finite, one a row, 1 to 8 columns. @param voxel edge of a voxel, > 0, in the unit
/// of the points. @param margin voxels around the bounding box, >= 0.
/// @throws Error (bad_data) without points or with coordinates that are not finite; Error (usage)
///         on another voxel, margin or number of columns; Error (resource) if the image is too
///         large, or beyond the memory limit; Error (cancelled) on a stop request.
PointImage voxel_image(PointsView points, double voxel, VoxelValue value = VoxelValue::distance,
                       Index margin = 1, const RunContext& context = default_context());

}  // namespace ph
