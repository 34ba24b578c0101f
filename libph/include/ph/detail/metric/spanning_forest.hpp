// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <numeric>
#include <span>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

// The minimum spanning forest of a finite set with distances: among all pairs at finite distance <=
// limit, the pairs that Kruskal's algorithm takes in the order (distance, larger end, smaller end).
// The order is total, which makes the forest unique. The forest has the same components as the
// entire graph up to any distance, and therefore the same H0 pairs, cell by cell; see
// docs/explanation/engines/spanning-forest.md.
//
// The functions return edges with u > v, in any order. There must be fewer than 2^32 - 1 points.

/// Uses Prim's algorithm (1957): each pair is examined once, and only edges of the forest are kept.
/// O(n^2) time, O(n) memory.
/// @param distance_of(i, j) for i > j: >= 0 or infinite.
template <class DistanceOf>
FlagEdges spanning_forest(Index size, DistanceOf&& distance_of, double limit,
                          const RunContext& context) {
  // A vertex that is not in the forest yet, with its first edge to the growing tree.
  struct Outside {
    FlagEdge edge;
    std::uint32_t vertex;
  };
  constexpr double never = std::numeric_limits<double>::infinity();
  FlagEdges forest(&context.memory);
  std::pmr::vector<Outside> outside(static_cast<std::size_t>(size), &context.memory);
  for (std::uint32_t v = 0; v < outside.size(); ++v) outside[v] = {{never, 0, 0}, v};
  Ticker ticker(context, "spanning forest", outside.size());
  std::size_t left = outside.size(), next = 0;  // `next` is the vertex that enters the tree
  while (left > 0) {
    const FlagEdge& first = outside[next].edge;  // if it is too long, another tree begins
    // mutant: forest-threshold
    if (first.value <= limit && first.value < never) forest.push_back(first);
    const std::uint32_t entered = outside[next].vertex;
    // The other vertices keep their order, which is the order of a matrix in memory.
    std::size_t kept = 0, nearest = 0;
    for (std::size_t i = 0; i < left; ++i) {
      Outside w = outside[i];
      if (w.vertex == entered) continue;
      const auto [v, u] = std::minmax(w.vertex, entered);
      const FlagEdge edge{distance_of(Index{u}, Index{v}), u, v};
      if (precedes(edge, w.edge)) w.edge = edge;
      outside[kept] = w;
      if (precedes(w.edge, outside[nearest].edge)) nearest = kept;
      ++kept;
    }
    ticker.tick();
    ticker.work(left);
    left = kept;
    next = nearest;
  }
  return forest;
}

/// True if `spanning_forest` of points is faster than examining each pair.
bool has_fast_spanning_forest(PointsView points, PointDistance distance);

/// For points: Borůvka's algorithm (1926) with a k-d tree that finds the nearest point of another
/// component (March, Ram, Gray, "Fast Euclidean minimum spanning tree", 2010). Usually O(n log n)
/// in a space of few dimensions, never more than O(n^2 log n). O(n) memory.
/// With births, the value of an edge is the largest of its length and the births of its two ends;
/// the nodes of the tree also store their least birth. If the births are core distances, this is
/// the forest of HDBSCAN* (Campello, Moulavi, Sander 2013; McInnes, Healy 2017).
/// @param points one point per row. @param p exponent of PointDistance::minkowski.
/// @param births one per point, finite, >= 0; if empty, all births are 0. With births, points need
/// at least one coordinate.
/// @param largest as for PointMetric, if the points are a part of a cloud. Precondition:
/// has_fast_spanning_forest(points, distance).
/// @throws Error (bad_data) as PointMetric.
FlagEdges spanning_forest(PointsView points, PointDistance distance, double p,
                          std::span<const double> births, double limit, const RunContext& context,
                          double largest = 0);

struct ForestWithBirths {
  FlagEdges edges;
  std::pmr::vector<double> births;  // one per point
};
/// The forest with core distances as births. One search finds the core distances and the first
/// edges of each point.
/// @param k 1 to the number of points - 1. @param distance, p, limit as in spanning_forest.
ForestWithBirths core_forest(PointsView points, Index k, PointDistance distance, double p,
                             double limit, const RunContext& context);

}  // namespace ph
