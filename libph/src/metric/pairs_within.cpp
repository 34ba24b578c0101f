// SPDX-License-Identifier: MIT
#include "ph/metric/pairs_within.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "ph/core/error.hpp"
#include "ph/metric/point_metric.hpp"

namespace ph {
namespace {

// The view of the points that nanoflann asks for.
struct KdPoints {
  const Points& points;
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.rows()); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const {
    return points(static_cast<Index>(i), static_cast<Index>(k));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, KdPoints>, KdPoints>;

}  // namespace

void for_each_pair_within(const Points& points, double radius,
                          const std::function<void(Index, Index, double)>& visit) {
  if (!(radius >= 0)) {
    throw Error(ErrorKind::usage, fmt::format("radius: found {}, expected a number >= 0", radius));
  }
  const PointMetric metric(points);
  const Index n = points.rows();
  const double reach = points.size() == 0 ? 0 : points.cwiseAbs().maxCoeff();
  // Squares that overflow mislead the tree; all pairs do not.
  if (points.size() == 0 || reach > 1e150 || radius > 1e150) {
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j)
        if (const double d = metric(i, j); d <= radius) visit(i, j, d);
    return;
  }
  const KdPoints view{points};
  const KdTree tree(static_cast<int>(points.cols()), view, {16});
  // The tree compares squares, which lose digits to underflow: ask for a hair more and let the
  // metric decide.
  const double ask = std::max(radius * radius, 1e-280) * (1 + 1e-12);
  std::vector<std::pair<std::uint32_t, double>> found;
  for (Index i = 0; i < n; ++i) {
    tree.radiusSearch(points.row(i).data(), ask, found, nanoflann::SearchParams(0, 0, false));
    for (const auto& [j, squared] : found) {
      if (Index{j} <= i) continue;
      if (const double d = metric(i, j); d <= radius) visit(i, j, d);
    }
  }
}

}  // namespace ph
