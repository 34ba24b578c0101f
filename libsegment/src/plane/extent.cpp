// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/extent.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "libsegment/src/plane/outline.hpp"
#include "libsegment/src/plane/plane.hpp"

namespace ph::segment {
namespace {

// How far from a plane a point may belong to something that stands on the plane or that the plane
// is a face of, in metres.
constexpr double kReach = 0.1;

using Square = std::array<double, 2>;

/// Calls `use` for a square and the eight squares next to it.
template <class Use>
void for_each_near(const Square& square, Use&& use) {
  for (const int x : {-1, 0, 1})
    for (const int y : {-1, 0, 1}) use(Square{square[0] + x, square[1] + y});
}

/// The first and the last square of each row or column in which the plane is seen.
class Ranges {
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

}  // namespace

std::uint64_t Extent::key_of(const Square& square) {
  const auto word = [](double number) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
  };
  return std::uint64_t{word(square[0])} << 32 | word(square[1]);
}

void Extent::add(const Eigen::Vector3d& p, double margin) {
  const double height = plane_.signed_distance(p.x(), p.y(), p.z());
  const double away = std::abs(height);
  const bool is_on = away <= margin;
  if (!is_on &&
      (away <= kMarginsOfPlane * margin || away >= std::max(kReach, 2 * kMarginsOfPlane * margin)))
    return;
  const Square square = squares_.of(p);
  const auto [count, is_new] = counts_.try_emplace(key_of(square));
  if (is_new) all_.push_back(square);
  if (is_on) {
    seen_ += count->on++ == 0 ? 1U : 0U;
  } else if (height > 0) {
    ++count->in_front;
  } else {
    ++count->behind;
    count->deep += away > kThickestBoard ? 1 : 0;
  }
}

bool Extent::goes_on_behind() const {
  // A share of the squares in which the plane is seen. Tables have at most 0.004, or 0.095 with an
  // apron of 10 cm below the board. The tops of boxes of 0.2 m² and more have at least 0.14.
  constexpr double most_behind = 0.1;
  const bool is_large = area() >= kLeastTable;
  const auto behind = std::ranges::count_if(all_, [&](const Square& square) {
    const Count& count = *find(square);
    return count.on > 0 && kLeastRatio * (is_large ? count.deep : count.behind) > count.on;
  });
  return static_cast<double>(behind) > most_behind * static_cast<double>(seen_);
}

bool Extent::goes_on_beside() const {
  constexpr double most_beside = 0.15;  // a share of the points on the plane
  Index on = 0, below = 0;
  for (const Square& square : all_) {
    const Count& count = *find(square);
    if (count.is_clear()) on += count.on;
    if (count.deep > 0 && is_clear_near(square)) below += count.deep;
  }
  return static_cast<double>(below) > most_beside * static_cast<double>(on);
}

bool Extent::has_things_on_it() const {
  Ranges rows, columns;
  for (const Square& square : all_) {
    if (find(square)->on == 0) continue;
    rows.add(square[1], square[0]);
    columns.add(square[0], square[1]);
  }
  return std::ranges::any_of(all_, [&](const Square& square) {
    return find(square)->in_front > 0 && rows.surround(square[1], square[0]) &&
           columns.surround(square[0], square[1]);
  });
}

bool Extent::is_clear_near(const Square& square) const {
  bool any = false;
  for_each_near(square, [&](const Square& near) {
    const Count* count = find(near);
    any |= count != nullptr && count->is_clear();
  });
  return any;
}

bool Extent::is_over(const float* p) const {
  return is_clear_near(squares_.of({p[0], p[1], p[2]}));
}

std::vector<Square> Extent::largest_group() const {
  FlatMap<bool> taken(std::pmr::get_default_resource());
  std::vector<Square> largest;
  for (const Square& first : all_) {
    if (!find(first)->is_clear() || !taken.try_emplace(key_of(first)).second) continue;
    std::vector<Square> group{first};
    for (std::size_t next = 0; next < group.size(); ++next)
      for_each_near(Square{group[next]}, [&](const Square& near) {
        const Count* count = find(near);
        if (count != nullptr && count->is_clear() && taken.try_emplace(key_of(near)).second)
          group.push_back(near);
      });
    if (group.size() > largest.size()) largest = std::move(group);
  }
  return largest;
}

double Extent::area_of_hull() const {
  Outline corners;
  for (const auto& [x, y] : largest_group())
    for (const int i : {0, 1})
      for (const int j : {0, 1}) corners.emplace_back((x + i) * side_, (y + j) * side_);
  return area_of(hull_of(std::move(corners)));
}

}  // namespace ph::segment
