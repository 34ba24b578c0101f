// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/stages.hpp"

#include <cmath>

namespace ph::segment {

std::vector<Index> range_filter(const CloudView& cloud, double max_range,
                                const std::optional<Box>& crop) {
  const auto size = cloud.size();
  const auto& [vx, vy, vz] = cloud.viewpoint;
  // A double can represent the square of the distance between any two floats. The distance from a
  // farther viewpoint may be infinite.
  const double limit = max_range * max_range;
  std::vector<Index> kept;
  kept.reserve(size);  // only the memory that is written is touched
  for (std::size_t i = 0; i < size; ++i) {
    const float* p = cloud.point(i);
    const double dx = p[0] - vx, dy = p[1] - vy, dz = p[2] - vz;
    const double square = dx * dx + dy * dy + dz * dz;
    // A coordinate that is not finite makes the sum NaN or infinite, so one test covers all three
    // coordinates.
    const bool is_finite = std::isfinite(double{p[0]} + p[1] + p[2]);
    if (is_finite && square <= limit) kept.push_back(static_cast<Index>(i));
  }
  if (crop) {
    std::erase_if(kept, [&](Index i) {
      const float* p = cloud.point(static_cast<std::size_t>(i));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] < crop->min[axis] || p[axis] > crop->max[axis]) return true;
      }
      return false;
    });
  }
  return kept;
}

}  // namespace ph::segment
