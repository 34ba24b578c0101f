// SPDX-License-Identifier: MIT
#include "ph/sparse_distances.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ph/detail/metric/pairs_within.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

void check(const WeightedEdge& e, Index size) {
  if (e.u < 0 || e.v < 0 || e.u >= size || e.v >= size || e.u == e.v) {
    throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}): expected two different vertices "
                                                 ">= 0 and below {}",
                                                 e.u, e.v, size));
  }
  if (!(e.value >= 0)) {
    throw Error(ErrorKind::bad_data,
                fmt::format("edge ({}, {}): found distance {}, expected >= 0", e.u, e.v, e.value));
  }
}

}  // namespace

SparseDistances::SparseDistances(Index size, std::vector<WeightedEdge> edges) : size_(size) {
  if (size < 0)
    throw Error(ErrorKind::bad_data,
                fmt::format("sparse distances: found {} points, expected 0 or more", size));
  for (WeightedEdge& e : edges) {
    check(e, size_);
    if (e.u > e.v) std::swap(e.u, e.v);
    e.value += 0.0;  // the sum turns -0.0 into +0.0
  }
  std::sort(edges.begin(), edges.end(), [](const WeightedEdge& a, const WeightedEdge& b) {
    return a.u != b.u ? a.u < b.u : a.v < b.v;
  });
  const auto twice = std::adjacent_find(
      edges.begin(), edges.end(),
      [](const WeightedEdge& a, const WeightedEdge& b) { return a.u == b.u && a.v == b.v; });
  if (twice != edges.end()) {
    throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}) occurs twice", twice->u, twice->v));
  }
  edges_ = std::make_shared<const std::vector<WeightedEdge>>(std::move(edges));
}

SparseDistances SparseDistances::within(PointsView points, double radius) {
  std::vector<WeightedEdge> edges;
  for_each_pair_within(points, radius, [&](Index i, Index j, double d) {
    edges.push_back({i, j, d});
  });
  return SparseDistances(points.rows(), std::move(edges));
}

}  // namespace ph
