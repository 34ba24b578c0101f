// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/alpha/sites/vector.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph::alpha {

inline constexpr std::uint32_t kNone = UINT32_MAX;

/// The distinct points in the order of a Hilbert curve, which keeps neighbours in space close
/// together in memory. The order depends on the positions of the points, not on their order in the
/// input. Coordinates are scaled by a power of two, which is exact and keeps squares and products
/// in range.
struct Sites {
  explicit Sites(std::pmr::memory_resource* memory)
      : points(memory), weights(memory), input(memory), copies(memory), path(memory) {}

  bool is_weighted() const { return !weights.empty(); }
  double weight(std::uint32_t site) const { return is_weighted() ? weights[site] : 0.0; }
  std::size_t size() const { return points.size(); }

  int coordinates = 0;  ///< coordinates per point: 1, 2 or 3; missing ones are 0
  /// Input coordinates are 2^exponent times the coordinates of sites.
  int exponent = 0;
  RawVector<Vector<double>> points;  ///< indexed by site
  std::pmr::vector<double> weights;  ///< indexed by site, or empty if no point has a weight
  /// For each site, the point of the input that became the site. It is the first point at this
  /// place or, with weights, the first of the heaviest points at this place.
  std::pmr::vector<std::uint32_t> input;
  /// The other points of the input at the same places. Each entry consists of such a point, which
  /// is a copy, and its site.
  std::pmr::vector<std::array<std::uint32_t, 2>> copies;
  /// All sites in an order that keeps neighbours in space close together; empty if the numbers of
  /// the sites already give such an order.
  std::pmr::vector<std::uint32_t> path;
};

/// Makes sites from the points. If points at the same place have different weights, the heaviest
/// point becomes the site, and the others are its copies. @param points points of R¹, R² or R³.
/// @param weights one weight for each point, or none.
/// @throws Error (usage) if the points are in another space, or if the number of weights is not the
/// number of points; Error (bad_data) if a number is not finite, or if coordinates differ too much
/// in magnitude; Error (resource, cancelled).
/// @param largest a magnitude for which the scaled numbers must also be within range.
Sites sites_of(PointsView points, std::span<const double> weights, const RunContext& context,
               double largest = 0);

/// Computes Sites::path, for sites whose numbers do not follow the curve.
void order_path(Sites& sites, const RunContext& context);

}  // namespace ph::alpha
