// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/sample.hpp"
#include "libsegment/src/plane/squares.hpp"

namespace ph::segment {
namespace {

using Square = std::array<double, 2>;

constexpr double kSide = 0.05;  // the side of a square of a plane, in metres
// How far from a plane a point may belong to something that stands on the plane or that the plane
// is a face of, in metres.
constexpr double kReach = 0.1;
// Points nearer to the plane than this number of margins may belong to the plane itself.
constexpr double kMargins = 2;

/// The squares of a plane in which the points of a sample are.
struct Squared {
  std::set<Square> on;        ///< the squares in which the plane itself is seen
  std::size_t points_on = 0;  ///< the number of points there
  std::set<Square> in_front;  ///< the squares in which something is up to kReach in front
  /// For each point up to kReach behind the plane, its square and its distance from the plane.
  std::vector<std::pair<Square, double>> behind;

  double area() const { return static_cast<double>(on.size()) * kSide * kSide; }
};

Squared squared(const Plane& plane, const Sample& sample) {
  const Squares squares(plane, kSide);
  Squared result;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double height = plane.signed_distance(sample.x[i], sample.y[i], sample.z[i]);
    const double limit = sample.limits[i];
    if (std::abs(height) <= limit) {
      ++result.points_on;
      result.on.insert(squares.of(sample[i]));
    } else if (std::abs(height) > kMargins * limit && std::abs(height) < kReach) {
      if (height > 0)
        result.in_front.insert(squares.of(sample[i]));
      else
        result.behind.emplace_back(squares.of(sample[i]), -height);
    }
  }
  return result;
}

/// True if the plane is a face of something: the surface goes on just behind the plane, where the
/// plane itself is seen. Behind a table, only the edge of its board is seen.
bool goes_on_behind(const Squared& plane) {
  // A share of the points on the plane. Edges of books and of boards up to 3 cm have 0.05, faces of
  // boxes have 0.11 and more.
  constexpr double most = 0.08;
  constexpr double thickest_board = 0.05;  // metres
  const double least = plane.area() < kLeastTable ? 0 : thickest_board;
  const auto below = std::ranges::count_if(plane.behind, [&](const auto& point) {
    return point.second > least && plane.on.contains(point.first);
  });
  return static_cast<double>(below) > most * static_cast<double>(plane.points_on);
}

/// True if the plane is the visible side of a single object: it is smaller than a table, and
/// nothing is in front of it.
bool is_alone(const Squared& plane) { return plane.in_front.empty() && plane.area() < kLeastTable; }

/// The first and the last square of each row or column in which the plane is seen.
class Extents {
 public:
  void add(double line, double at) {
    const auto [known, is_new] = of_.try_emplace(line, at, at);
    known->second = {std::min(known->second.first, at), std::max(known->second.second, at)};
  }
  bool surround(double line, double at) const {
    constexpr double least = 2;  // squares of the plane on both sides
    const auto known = of_.find(line);
    return known != of_.end() && known->second.first + least <= at &&
           at <= known->second.second - least;
  }

 private:
  std::map<double, std::pair<double, double>> of_;
};

/// Removes a square and all squares that are connected with it. Squares are connected if at most
/// one square is between them, because a sample leaves gaps.
void remove_group(const Square& first, std::set<Square>& squares) {
  constexpr int reach = 2;
  std::vector<Square> open{first};
  squares.erase(first);
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        if (const Square near{column + x, row + y}; squares.erase(near) > 0) open.push_back(near);
  }
}

/// The number of things on a plane: groups of connected squares in which something is in front of
/// the plane, while the plane is seen on all four sides. In front of a wall, most things are at its
/// lower end.
std::size_t count_things(const Squared& plane) {
  Extents rows, columns;
  for (const auto& [column, row] : plane.on) {
    rows.add(row, column);
    columns.add(column, row);
  }
  std::set<Square> squares;
  for (const auto& [column, row] : plane.in_front)
    if (rows.surround(row, column) && columns.surround(column, row)) squares.insert({column, row});
  std::size_t things = 0;
  for (; !squares.empty(); ++things) remove_group(*squares.begin(), squares);
  return things;
}

}  // namespace

PlaneSearch find_support(const CloudView& cloud, const std::vector<Index>& points,
                         const PlaneMargin& margin, const std::optional<Plane>& guess) {
  constexpr int most_planes = 4;
  PlaneSearch largest = find_plane(cloud, points, margin, guess);
  if (!largest.plane) return largest;
  const Sample sample = draw_sample(cloud, points, margin);
  const Squared around = squared(*largest.plane, sample);
  if (goes_on_behind(around))  // mutant: support-face
    return {std::nullopt, "no plane: the surface goes on behind the largest candidate"};
  if (is_alone(around))  // mutant: support-alone
    return {std::nullopt,
            "no plane: the largest candidate is smaller than a table, and nothing is on it"};
  if (!bounds_the_view(*largest.plane, cloud)) return largest;  // mutant: support-wall
  PlaneSearch support = largest;
  std::size_t most_things = count_things(around);
  std::vector<Index> rest = points;
  for (int k = 1; k < most_planes; ++k) {
    std::erase_if(rest, [&](Index i) {
      const float* p = cloud.point(static_cast<std::size_t>(i));
      return std::abs(largest.plane->signed_distance(p[0], p[1], p[2])) <=
             kMargins * margin(cloud, p);
    });
    largest = find_plane(cloud, rest, margin);
    if (!largest.plane) break;
    largest.plane->share *= static_cast<double>(rest.size()) / static_cast<double>(points.size());
    const Squared seen = squared(*largest.plane, sample);
    if (largest.plane->share < kLeastShareOfSupport || goes_on_behind(seen)) break;
    if (const std::size_t things = count_things(seen); things > most_things) {
      most_things = things;
      support = largest;
    }
  }
  return support;
}

}  // namespace ph::segment
