// SPDX-License-Identifier: MIT
#include "ph/detail/diagram/point_tree.hpp"

#include <numeric>
#include <vector>

namespace ph::diagram {
namespace {

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

}  // namespace

PointTree::PointTree(std::span<const Point> points, const RunContext& context)
    : tree_({points.front().data(), static_cast<Index>(points.size()), 2},
            first_numbers(points.size()), context),
      points_(points.size(), &context.memory) {
  for (std::size_t q = 0; q < points.size(); ++q) points_[q] = points[tree_.rows()[q]];
}

}  // namespace ph::diagram
