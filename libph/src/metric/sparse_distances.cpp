// SPDX-License-Identifier: MIT
#include "ph/metric/sparse_distances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

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

void check(const WeightedEdge& e, Index size) {
  if (e.u < 0 || e.v < 0 || e.u >= size || e.v >= size || e.u == e.v) {
    throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}): expected two different vertices "
                                                 "below {}", e.u, e.v, size));
  }
  if (!(e.value >= 0)) {
    throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}): found distance {}, expected >= 0",
                                                 e.u, e.v, e.value));
  }
}

}  // namespace

SparseDistances::SparseDistances(Index size, std::vector<WeightedEdge> edges)
    : size_(size), edges_(std::move(edges)) {
  for (WeightedEdge& e : edges_) {
    check(e, size_);
    if (e.u > e.v) std::swap(e.u, e.v);
    e.value += 0.0;  // -0.0 becomes +0.0
  }
  std::sort(edges_.begin(), edges_.end(), [](const WeightedEdge& a, const WeightedEdge& b) {
    return a.u != b.u ? a.u < b.u : a.v < b.v;
  });
  const auto twice = std::adjacent_find(
      edges_.begin(), edges_.end(),
      [](const WeightedEdge& a, const WeightedEdge& b) { return a.u == b.u && a.v == b.v; });
  if (twice != edges_.end()) {
    throw Error(ErrorKind::bad_data,
                fmt::format("edge ({}, {}) is there twice", twice->u, twice->v));
  }
}

SparseDistances SparseDistances::within(const Points& points, double radius) {
  if (!(radius >= 0)) {
    throw Error(ErrorKind::usage, fmt::format("radius: found {}, expected a number >= 0", radius));
  }
  const PointMetric metric(points);
  const Index n = points.rows();
  std::vector<WeightedEdge> edges;
  const double reach = points.size() == 0 ? 0 : points.cwiseAbs().maxCoeff();
  // Squares near the ends of the range of double mislead the tree; all pairs do not.
  const bool tree_is_safe = points.size() > 0 && reach < 1e150 && radius > 1e-140;
  if (!tree_is_safe || std::isinf(radius)) {
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j)
        if (const double d = metric(i, j); d <= radius) edges.push_back({i, j, d});
    return SparseDistances(n, std::move(edges));
  }
  const KdPoints view{points};
  const KdTree tree(static_cast<int>(points.cols()), view, {16});
  // The tree compares squares: ask for a hair more and let the metric decide.
  const double ask = radius * radius * (1 + 1e-12);
  std::vector<std::pair<std::uint32_t, double>> found;
  for (Index i = 0; i < n; ++i) {
    tree.radiusSearch(points.row(i).data(), ask, found, nanoflann::SearchParams(0, 0, false));
    for (const auto& [j, squared] : found) {
      if (Index{j} <= i) continue;
      if (const double d = metric(i, j); d <= radius) edges.push_back({i, j, d});
    }
  }
  return SparseDistances(n, std::move(edges));
}

}  // namespace ph
