// SPDX-License-Identifier: MIT
#include "libsegment/src/vessels/upper_end.hpp"

#include <algorithm>
#include <functional>

namespace ph::segment {

UpperEnd upper_end_of(const std::vector<Eigen::Vector3d>& points, double depth) {
  // One point in this many may be higher than the upper end.
  constexpr std::size_t outliers = 50;
  std::vector<double> heights;
  for (const auto& p : points) heights.push_back(p.z());
  const auto top = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / outliers);
  std::ranges::nth_element(heights, top, std::greater<>());
  UpperEnd end{*top, {}};
  for (const auto& p : points)
    if (p.z() > end.top - depth) end.points.emplace_back(p.head<2>());
  return end;
}

}  // namespace ph::segment
