// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/boards.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsegment/src/plane/outline.hpp"

namespace ph::segment {
namespace {

/// The area of the convex hull, in square metres, of the points of a sample that are on a plane.
double area_of_hull(const Plane& plane, const Sample& sample) {
  const Eigen::Matrix3d turn = upright(plane.normal);
  Outline on;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Eigen::Vector3d p = sample[i];
    if (std::abs(plane.signed_distance(p.x(), p.y(), p.z())) <= sample.limits[i])
      on.emplace_back((turn * p).head<2>());
  }
  return area_of(hull_of(std::move(on)));
}

}  // namespace

Board board_of(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
               const PlaneMargin& margin, double range) {
  constexpr double side = 0.015;  // of a square, in metres; beyond one metre, per metre
  Board board{plane, margin, Extent(plane, side * std::max(1.0, range))};
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    board.extent.add({p[0], p[1], p[2]}, margin(cloud, p));
  }
  return board;
}

bool is_lowest(const Plane& plane, const CloudView& cloud) {
  return share_behind(cloud, plane, {kThickestBoard}) <= kMostBehind;
}

std::vector<Board> find_boards(const CloudView& cloud, const std::vector<Index>& points,
                               const Sample& sample, const Plane& support,
                               const PlaneMargin& margin, std::size_t most) {
  constexpr int most_times = 8;
  constexpr double least_step = 0.12;  // metres between parallel boards
  std::vector<double> offsets{support.offset};
  std::vector<Board> boards;
  Sample rest = points_off(support, kMarginsOfPlane, sample);
  rest.set_limits(SlantedMargin(margin, support, cloud.viewpoint));
  for (int times = 0; times < most_times && boards.size() < most; ++times) {
    const PlaneSearch search = find_parallel(support, rest, cloud.viewpoint);
    if (!search.plane) break;
    const Plane& plane = *search.plane;
    const double area = area_of_hull(plane, rest);
    rest = points_off(plane, kMarginsOfPlane, rest);
    const bool is_near = std::ranges::any_of(
        offsets, [&](double offset) { return std::abs(plane.offset - offset) <= least_step; });
    if (is_near || cosine_between(plane, support) < kLeastOfParallel) continue;
    // Of a floor, little may be seen beside the support.
    const bool is_floor = plane.offset > support.offset && is_lowest(plane, cloud);
    // All points of a small plane need not be looked at.
    if (!is_floor && area < kLeastTable / 2) continue;
    const double height =
        plane.signed_distance(cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]);
    Board board = board_of(cloud, points, plane,
                           {margin.distance, margin.noise * std::min(1.0, height / search.range)},
                           search.range);
    const bool is_large = board.extent.area_of_hull() >= kLeastTable;  // mutant: board-hull
    const bool is_box = board.extent.goes_on_beside();                 // mutant: board-beside
    if (!is_floor && (!is_large || is_box)) continue;
    offsets.push_back(plane.offset);
    boards.push_back(std::move(board));
  }
  return boards;
}

Cleared remove_board(const CloudView& cloud, const std::vector<Index>& points, const Board& board) {
  Cleared cleared;
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    const double height = board.plane.signed_distance(p[0], p[1], p[2]);
    const double limit = board.margin(cloud, p);
    // mutant: board-below
    if (height > limit || height < -std::max(limit, kThickestBoard) || !board.extent.is_over(p)) {
      cleared.beyond.push_back(i);
    } else {
      cleared.on.push_back(i);
      if (height > 0) cleared.strip.push_back(i);
    }
  }
  return cleared;
}

}  // namespace ph::segment
