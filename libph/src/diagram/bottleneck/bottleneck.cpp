// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "libph/src/diagram/bottleneck/joined_matchings.hpp"
#include "libph/src/diagram/bottleneck/one_sided_matching.hpp"
#include "libph/src/diagram/diagram_parts.hpp"
#include "ph/distances.hpp"

namespace ph {
namespace {

using diagram::DiagramParts;

/// The bottleneck distance between the infinite bars alone.
double distance_of_infinite(const DiagramParts& a, const DiagramParts& b) {
  if (!diagram::have_as_many_infinite(a, b)) return kInfinity;
  double result = 0;
  for (const std::size_t k : {0U, 1U})
    for (std::size_t i = 0; i < a.rays[k].size(); ++i)
      result = std::max(result, std::abs(a.rays[k][i].value - b.rays[k][i].value));
  return result;
}

/// The finite bars of two diagrams, and a one-sided matching in each direction.
class TwoSides {
 public:
  TwoSides(const DiagramParts& a, const DiagramParts& b, const RunContext& context)
      : there_(a.finite, b.finite, context), back_(b.finite, a.finite, context) {}

  /// Computes bounds for the distance. @param least a lower bound that is already known.
  DistanceBounds bounds(double least, const DistanceLimits& limits) {
    const double lower = back_.lower_bound(there_.lower_bound(least));
    DistanceBounds bounds = there_.narrow({lower, lower}, limits);
    const DistanceBounds second = back_.narrow(bounds, limits);
    return {std::max(bounds.value, second.value), second.lower};
  }
  /// For each bar of the first diagram, its partner in the second diagram, or kNone. @param
  /// distance the value that `bounds` has returned.
  std::vector<std::uint32_t> partners(double distance) {
    there_.match_at(distance);
    back_.match_at(distance);
    return diagram::JoinedMatchings(there_.partners_of_from(), there_.partners_of_to(),
                                    back_.partners_of_to(), back_.partners_of_from())
        .join();
  }

 private:
  diagram::OneSidedMatching there_, back_;
};

// The number of bytes per bar. It does not include the trees and the sets of their remaining
// points, which count their own memory.
constexpr std::size_t kBytesABar = 160;

}  // namespace

DistanceBounds bottleneck_bounds(std::span<const Bar> a, std::span<const Bar> b,
                                 const DistanceLimits& limits, const RunContext& context) {
  diagram::check(limits, "bottleneck_bounds");
  const MemoryClaim claim(context.memory, (a.size() + b.size()) * kBytesABar);
  const DiagramParts first(a, "bottleneck_distance"), second(b, "bottleneck_distance");
  const double infinite = distance_of_infinite(first, second);
  if (infinite == kInfinity) return {infinite, infinite};
  return TwoSides(first, second, context).bounds(infinite, limits);
}

double bottleneck_distance(std::span<const Bar> a, std::span<const Bar> b,
                           const RunContext& context) {
  return bottleneck_bounds(a, b, {}, context).value;
}

BottleneckMatching bottleneck_matching(std::span<const Bar> a, std::span<const Bar> b,
                                       const RunContext& context) {
  const MemoryClaim claim(context.memory, (a.size() + b.size()) * kBytesABar);
  const DiagramParts first(a, "bottleneck_matching"), second(b, "bottleneck_matching");
  BottleneckMatching result{distance_of_infinite(first, second), {}};
  if (result.distance == kInfinity) return result;
  TwoSides finite(first, second, context);
  result.distance = finite.bounds(result.distance, {}).value;
  const std::vector<std::uint32_t> partners = finite.partners(result.distance);
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i] != diagram::kNone)
      result.pairs.emplace_back(first.places[i], second.places[partners[i]]);
  diagram::pair_infinite(first, second, result.pairs);
  std::ranges::sort(result.pairs);
  return result;
}

}  // namespace ph
