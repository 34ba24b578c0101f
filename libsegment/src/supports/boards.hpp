// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/plane/extent.hpp"
#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/sample.hpp"

namespace ph::segment {

/// A flat surface of limited extent on which things may stand, such as a table, a board of a shelf
/// or a seat.
struct Board {
  Plane plane;
  PlaneMargin margin;
  Extent extent;
};

/// A plane as a board: the extent is where its points are. @param points the points of the scene.
/// @param range the distance of the plane's points from the viewpoint, in metres. The squares of
/// the extent grow with it.
Board board_of(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
               const PlaneMargin& margin, double range);

/// True if hardly any point of a cloud is below a support.
bool is_lowest(const Plane& plane, const CloudView& cloud);

/// Finds the boards that are parallel to a support, above it and below it. A board is as large as a
/// table, it is not the top of a box, and it is not near another board. A floor, below which
/// nothing is seen, may be smaller.
/// @param points the points in range, without holes. @param sample some of these points.
/// @param margin the margin of the support. @param most the largest number of boards.
std::vector<Board> find_boards(const CloudView& cloud, const std::vector<Index>& points,
                               const Sample& sample, const Plane& support,
                               const PlaneMargin& margin, std::size_t most);

/// Removes the points on a board, including its front edge. What is above, below or beside the
/// board stays in `beyond`.
Cleared remove_board(const CloudView& cloud, const std::vector<Index>& points, const Board& board);

}  // namespace ph::segment
