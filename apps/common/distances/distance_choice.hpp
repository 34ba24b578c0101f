// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/distances.hpp"

namespace ph::app {

enum class DistanceKind { bottleneck, wasserstein, sliced };

}  // namespace ph::app

namespace ph {

template <>
inline constexpr std::array names_of<app::DistanceKind>{
    Named{app::DistanceKind::bottleneck, "bottleneck"},
    Named{app::DistanceKind::wasserstein, "wasserstein"},
    Named{app::DistanceKind::sliced, "sliced"},
};

}  // namespace ph

namespace ph::app {

/// The kind of distance to compute between barcodes, and the required accuracy.
struct DistanceChoice {
  DistanceKind kind = DistanceKind::bottleneck;
  double wasserstein_order = 1;
  double wasserstein_ground = kInfinity;
  int directions = 50;    ///< used by the sliced distance
  DistanceLimits limits;  ///< used by all distances except the sliced distance

  std::string_view name() const { return name_of(kind); }
  /// The order p of the Wasserstein distance. It is infinite for the bottleneck distance.
  double order() const;
  /// The norm that measures how far apart two paired bars are. The sliced distance has no such
  /// norm.
  std::optional<double> ground() const;
};

/// Returns words such as "Wasserstein distance (order 2, ground norm inf)".
std::string words_of(const DistanceChoice& choice);

/// The distance between two barcodes in one dimension. @throws Error like the functions of
/// ph/distances.hpp.
DistanceBounds distance_of(std::span<const Bar> a, std::span<const Bar> b,
                           const DistanceChoice& choice,
                           const RunContext& context = default_context());

/// A distance, and the bars that it pairs.
struct DiagramMatching {
  DistanceBounds distance;  ///< if it is infinite, there are no pairs
  /// Indices into `a` and into `b`, ascending. The index -1 means the diagonal and comes last. Each
  /// bar of either diagram is in exactly one pair.
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
};
/// @param choice any distance except the sliced distance, which pairs no bars. The bottleneck
/// distance is exact for any limits. @throws Error like the functions of ph/distances.hpp.
DiagramMatching matching_of(std::span<const Bar> a, std::span<const Bar> b,
                            const DistanceChoice& choice,
                            const RunContext& context = default_context());

/// The dimensions in which any of the barcodes has bars, ascending.
std::vector<int> dims_of(std::span<const Barcode> barcodes);

/// The reason why two diagrams are infinitely far apart, such as "1 and 2 bars that never die".
std::string why_infinite(std::span<const Bar> a, std::span<const Bar> b);

/// A distance with its bounds, as text. Examples are "0.5", "0.5 (at least 0.497)", "more than 0.2:
/// from 0.3 to 0.5", and "inf: 1 and 2 bars that never die".
std::string text_of(const DistanceBounds& distance, const DistanceChoice& choice,
                    std::span<const Bar> a, std::span<const Bar> b);

}  // namespace ph::app
