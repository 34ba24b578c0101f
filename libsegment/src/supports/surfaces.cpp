// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/surfaces.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "libsegment/src/objects/oriented_box.hpp"
#include "libsegment/src/supports/boards.hpp"

namespace ph::segment {
namespace {

/// Marks and measures the points that were removed with a surface. @param number the number of the
/// surface, from 1.
void mark(const CloudView& cloud, const std::vector<Index>& points, std::size_t number,
          SceneTree& tree) {
  for (const Index i : points)
    tree.removed_with[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(number);
  SceneSurface& surface = tree.surfaces[number - 1];
  surface.oriented_box = box_on_plane(cloud, points, surface.plane.normal);
}

/// Removes the walls and the ceiling: planes behind which nothing is seen. They go before voxels
/// are made, because most points of a room are on them.
/// @return the points that are left.
std::vector<Index> clear_walls(std::vector<Index> points, const std::vector<Plane>& planes,
                               const Scene& scene, SceneTree& tree) {
  constexpr double thickness = 0.02;  // half of it, in metres
  for (const Plane& plane : planes) {
    const std::optional<Role> role = role_of_bound(plane, *scene.plane, scene.cloud);
    if (!role) continue;
    Cleared cleared = remove_plane(scene.cloud, points, plane, {thickness, scene.margin.noise});
    add_surface(*role, plane, scene.cloud, cleared.on, tree);
    points = std::move(cleared.beyond);
  }
  return points;
}

/// True if most of the points are above or below a board.
bool are_over(const Extent& board, const std::vector<Index>& points, const CloudView& cloud) {
  const auto over = std::ranges::count_if(
      points, [&](Index i) { return board.is_over(cloud.point(static_cast<std::size_t>(i))); });
  return 2 * over > std::ssize(points);
}

/// A support with the points that were removed with it.
struct Removed {
  Board board;
  std::vector<Index> points;
  std::size_t surface = 0;  ///< its index among the surfaces of the tree
};

/// Tells floors and shelves from other supports. @param lowest a support below which nothing is
/// seen, or null.
void set_roles(const std::vector<Removed>& supports, const Removed* lowest, const CloudView& cloud,
               SceneTree& tree) {
  const auto is_below_or_above_another = [&](const Removed& support, const Removed* except) {
    return std::ranges::any_of(supports, [&](const Removed& other) {
      return &other != &support && &other != except &&
             are_over(other.board.extent, support.points, cloud);
    });
  };
  constexpr double least_height = 0.3;  // of a table above the floor, in metres
  const Removed* floor = nullptr;
  const auto is_above = [&](const Removed& other) {
    // mutant: role-floor
    return lowest->board.plane.offset - other.board.plane.offset > least_height;
  };
  const bool is_low = lowest != nullptr && std::ranges::any_of(supports, is_above);
  if (is_low && !is_below_or_above_another(*lowest, nullptr)) {
    floor = lowest;
    tree.surfaces[floor->surface].role = Role::floor;
  }
  for (const Removed& support : supports)
    if (&support != floor && is_below_or_above_another(support, floor))
      tree.surfaces[support.surface].role = Role::shelf;
}

}  // namespace

void add_surface(Role role, const Plane& plane, const CloudView& cloud,
                 const std::vector<Index>& points, SceneTree& tree) {
  tree.surfaces.push_back({role, plane});
  mark(cloud, points, tree.surfaces.size(), tree);
}

void clear_surfaces(const std::vector<Index>& in_range, const std::vector<Plane>& planes,
                    const Sample& sample, const PlaneSight& sight, Index most_supports,
                    Scene& scene, SceneTree& tree) {
  // A share; in scenes in their sensor's frame, it is at most 0.03.
  constexpr double much_hidden = 0.1;
  const CloudView& cloud = scene.cloud;
  const Plane& plane = *scene.plane;
  add_surface(Role::support, plane, cloud, {}, tree);
  std::vector<Index> points = clear_walls(in_range, planes, scene, tree);
  const bool has_walls = tree.surfaces.size() > 1;
  std::vector<Board> boards =
      find_boards(cloud, points, has_walls ? draw_sample(cloud, points, scene.margin) : sample,
                  plane, scene.margin, static_cast<std::size_t>(most_supports) - 1);
  std::ranges::sort(boards, {}, [](const Board& board) { return -board.plane.offset; });
  // Nothing may be seen below the lowest support. Otherwise, the scene ends at the plane.
  const bool has_lower = !boards.empty() && boards.front().plane.offset > plane.offset &&
                         sight.hidden < much_hidden && is_lowest(boards.front().plane, cloud);
  if (!has_lower)
    std::erase_if(boards, [&](const Board& b) { return b.plane.offset > plane.offset; });
  if (boards.empty()) {
    scene.points = remove_plane(cloud, points, plane, scene.margin);
    mark(cloud, scene.points.on, 1, tree);
  } else {
    std::vector<Removed> supports;
    Board main = board_of(cloud, points, plane, scene.margin, scene.range);
    scene.points = has_lower ? remove_board(cloud, points, main)
                             : remove_plane(cloud, points, plane, scene.margin);
    mark(cloud, scene.points.on, 1, tree);
    supports.push_back({std::move(main), scene.points.on, 0});
    for (Board& board : boards) {
      const bool is_lowest = has_lower && &board == boards.data();
      std::vector<Index>& rest = scene.points.beyond;
      Cleared cleared = is_lowest ? remove_plane(cloud, rest, board.plane, board.margin)
                                  : remove_board(cloud, rest, board);
      rest = std::move(cleared.beyond);
      scene.others.push_back({board.plane, board.margin, std::move(cleared.strip)});
      add_surface(Role::support, board.plane, cloud, cleared.on, tree);
      supports.push_back({std::move(board), std::move(cleared.on), tree.surfaces.size() - 1});
    }
    const Removed* lowest = has_lower                 ? &supports[1]
                            : is_lowest(plane, cloud) ? supports.data()
                                                      : nullptr;
    set_roles(supports, lowest, cloud, tree);
  }
  if (tree.surfaces.size() > 1)
    scene.before = remove_plane(cloud, in_range, plane, scene.margin).beyond;
}

}  // namespace ph::segment
