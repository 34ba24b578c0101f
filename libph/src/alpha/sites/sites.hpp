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

  int coordinates = 0;               ///< coordinates per point: 1, 2 or 3; missing ones are 0
  int exponent = 0;                  ///< a point of the input is 2^exponent times its site
  RawVector<Vector<double>> points;  ///< by site
  std::pmr::vector<double> weights;  ///< by site, or empty if no point has a weight
  /// By site: the point of the input, the first one if there are copies.
  std::pmr::vector<std::uint32_t> input;
  /// The other copies: the point of the input, and the site.
  std::pmr::vector<std::array<std::uint32_t, 2>> copies;
  /// All sites in an order that keeps neighbours in space close together; if empty, the order of
  /// their numbers.
  std::pmr::vector<std::uint32_t> path;
};

/// @param points of R¹, R² or R³. @param weights one per point, or none; if copies have different
/// weights, the heaviest is the site and the others count as copies.
/// @throws Error (usage) on points of another space, and if there is not one weight per point;
///         Error (bad_data) on numbers that are not finite, and on coordinates that differ too much
///         in magnitude; Error (resource, cancelled).
/// @param largest a magnitude that must be in range as well.
Sites sites_of(PointsView points, std::span<const double> weights, const RunContext& context,
               double largest = 0);

/// Orders the path along a curve, for sites that are numbered differently.
void order_path(Sites& sites, const RunContext& context);

}  // namespace ph::alpha
