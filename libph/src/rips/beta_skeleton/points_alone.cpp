// SPDX-License-Identifier: MIT
#include "rips/beta_skeleton/points_alone.hpp"

#include "rips/beta_skeleton/pair_points.hpp"

namespace ph {

std::string_view obstacle_to_points_alone(PointsView points, const RipsOptions& options) {
  if (options.distance != PointDistance::euclidean) return "the Euclidean distance";
  if (points.cols() < 1 || points.cols() > kMostPointCoordinates)
    return "points of 1 to 4 coordinates";
  if (!options.births.empty()) return "vertices that all enter at 0";
  if (options.approximation) return "the whole filtration, no sparse one";
  if (options.only_components) return "to be asked for that alone";
  if (!has_plain_coordinates(points)) return "coordinates that are 0 or from 1e-120 to 1e150";
  return {};
}

}  // namespace ph
