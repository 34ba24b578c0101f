// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "alpha/sites/vector.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph::alpha {

inline constexpr std::uint32_t kNone = UINT32_MAX;

/// The distinct points in the order of a Hilbert curve, so that neighbours in space are neighbours
/// in memory. The order depends on where the points are and not on how they came. Coordinates are
/// scaled by a power of two, which keeps squares and products in range and is exact.
struct Sites {
  explicit Sites(std::pmr::memory_resource* memory)
      : points(memory), weights(memory), input(memory), copies(memory), path(memory) {}

  bool is_weighted() const { return !weights.empty(); }
  double weight(std::uint32_t site) const { return is_weighted() ? weights[site] : 0.0; }
  std::size_t size() const { return points.size(); }

  int coordinates = 0;                    ///< of a point: 1, 2 or 3; those missing are 0
  int exponent = 0;                       ///< a point of the input is 2^exponent times its site
  RawVector<Vector<double>> points;       ///< by site
  std::pmr::vector<double> weights;       ///< by site, or empty: no point has one
  std::pmr::vector<std::uint32_t> input;  ///< by site: the point of the input, of copies the first
  /// The other copies: the point of the input, and the site.
  std::pmr::vector<std::array<std::uint32_t, 2>> copies;
  /// All sites, so that neighbours in this list are neighbours in space; empty: by number.
  std::pmr::vector<std::uint32_t> path;
};

/// @param points of R¹, R² or R³. @param weights one a point, or none; of copies that differ in
/// their weights the heaviest is a site, the others count as copies.
/// @throws Error (usage) on points of another space and weights that are not one a point; Error
///         (bad_data) on what is not finite, and on coordinates that differ too much in magnitude;
///         Error (resource, cancelled).
/// @param largest a magnitude that has to be in range as well.
Sites sites_of(PointsView points, std::span<const double> weights, const RunContext& context,
               double largest = 0);

/// Orders the path along a curve, for sites that are numbered in another way.
void order_path(Sites& sites, const RunContext& context);

}  // namespace ph::alpha
