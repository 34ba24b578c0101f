// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "libph/src/diagram/diagram_parts.hpp"
#include "libph/src/diagram/wasserstein/assignment.hpp"
#include "libph/src/diagram/wasserstein/auction.hpp"
#include "ph/distances.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using diagram::Assignment;
using diagram::DiagramParts;
using diagram::Point;

// A matching this close to the optimum, relative to its cost, counts as optimal, because sums of
// many costs have this rounding error.
constexpr double kRounding = 1e-13;

// If a matching may exceed the optimum by more than this fraction of its cost, the search is
// repeated.
constexpr double kUnsure = 1e-9;

// The search is repeated in a smaller unit of length only if the power of the new unit is smaller
// by at least this factor.
constexpr double kFiner = 16;

// The largest number of bids per bar in a round. Auctions without bidding wars over equal bars need
// about 2 to 20 bids per bar.
constexpr std::uint64_t kMostBids = 400;

// The number of bytes per bar. It does not include the trees and their weights, which count their
// own memory.
constexpr std::size_t kBytesAPricedBar = 200;

void check(const WassersteinOptions& options, std::string_view function) {
  if (!(options.order >= 1 && options.order < kInfinity))
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: order: found {}, expected a finite number >= 1{}", function, options.order,
                    options.order == kInfinity ? "; for infinity, use bottleneck_distance" : ""));
  if (!(options.ground >= 1))
    throw Error(ErrorKind::usage, fmt::format("{}: ground: found {}, expected a number >= 1",
                                              function, options.ground));
  diagram::check(options.limits, function);
}

/// Computes (Σ x^order)^(1/order) for numbers of any size.
double norm_of(std::span<const double> lengths, double order) {
  const double largest = lengths.empty() ? 0 : std::ranges::max(lengths);
  if (largest == 0 || largest == kInfinity) return largest;
  // Division by a power of two loses no digits. For orders above 2, the code divides by the largest
  // number instead, so that the base of each power is at most 1.
  const double unit = order <= 2 ? std::ldexp(1, std::ilogb(largest)) : largest;
  double sum = 0;
  for (const double length : lengths)
    sum += order == 1 ? length / unit : std::pow(length / unit, order);
  return unit * (order == 1 ? sum : std::pow(sum, 1 / order));
}

/// A unit of length in which powers of lengths up to `largest` never overflow. Numbers are scaled
/// by a power of two. Powers of order 1 and 2 are exact where possible. For other orders, the base
/// of each power is at most 1.
struct Unit {
  double largest;
  int exponent;
  diagram::GroundCost cost;

  Unit(double length, const WassersteinOptions& options)
      : largest(length),
        exponent(length > 0 ? std::ilogb(length) : 0),
        cost(options.order, options.ground, length > 0 ? std::ldexp(length, -exponent) : 1) {}

  double in_unit(double x) const { return std::ldexp(x, -exponent); }
  double root(double power) const { return std::ldexp(cost.root(power), exponent); }
  std::vector<Point> in_unit(const DiagramParts& parts) const {
    std::vector<Point> points;
    points.reserve(parts.finite.size());
    for (const Point& p : parts.finite) points.push_back({in_unit(p[0]), in_unit(p[1])});
    return points;
  }
};

/// Two diagrams, their distance, and an optimal matching.
class Comparison {
 public:
  Comparison(std::span<const Bar> a, std::span<const Bar> b, const WassersteinOptions& options,
             std::string_view function, const RunContext& context)
      : options_(options),
        context_(context),
        claim_(context.memory, (a.size() + b.size()) * kBytesAPricedBar),
        first_(a, function),
        second_(b, function) {}

  DistanceBounds distance() {
    if (!diagram::have_as_many_infinite(first_, second_)) return {kInfinity, kInfinity};
    for (const std::size_t k : {0U, 1U})
      for (std::size_t i = 0; i < first_.rays[k].size(); ++i)
        rays_.push_back(std::abs(first_.rays[k][i].value - second_.rays[k][i].value));
    const Unit unit(largest(), options_);
    double rays = 0;
    for (const double ray : rays_) rays += unit.cost.power(unit.in_unit(ray));
    const auto bounds = [&](const Assignment::Costs& costs) {
      return DistanceBounds{unit.root(rays + costs.cost), unit.root(rays + costs.lower)};
    };
    // All bars are matched with the diagonal.
    if (first_.finite.empty() || second_.finite.empty()) {
      Assignment::Costs costs{0, 0};
      for (const DiagramParts* parts : {&first_, &second_})
        for (const Point& p : unit.in_unit(*parts)) costs.cost += unit.cost.alone(p);
      costs.lower = costs.cost;
      partners_.assign(first_.finite.size(), diagram::kNone);
      return bounds(costs);
    }
    const Assignment::Costs costs = match(unit, kInfinity, bounds);
    const DistanceBounds found = bounds(costs);
    const bool is_enough =
        has_digits(costs) && (is_sure(costs) || diagram::is_enough(found, options_.limits));
    return is_enough ? found : refined(unit.largest, found);  // mutant: wasserstein-refined
  }

  WassersteinMatching matching(std::size_t count_a, std::size_t count_b) {
    WassersteinMatching result{distance(), {}};
    if (result.distance.value == kInfinity && !diagram::have_as_many_infinite(first_, second_))
      return result;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t i = 0; i < partners_.size(); ++i)
      if (partners_[i] != diagram::kNone)
        pairs.emplace_back(first_.places[i], second_.places[partners_[i]]);
    diagram::pair_infinite(first_, second_, pairs);
    std::vector<std::int64_t> of_a(count_a, -1);
    std::vector<bool> is_paired(count_b, false);
    for (const auto& [i, j] : pairs) {
      of_a[i] = j;
      is_paired[j] = true;
    }
    for (std::size_t i = 0; i < count_a; ++i)
      result.pairs.emplace_back(static_cast<std::int64_t>(i), of_a[i]);
    for (std::size_t j = 0; j < count_b; ++j)
      if (!is_paired[j]) result.pairs.emplace_back(-1, static_cast<std::int64_t>(j));
    return result;
  }

 private:
  /// False if the total cost is so small that powers of lengths may have underflowed.
  static bool has_digits(const Assignment::Costs& costs) {
    return costs.cost >= std::numeric_limits<double>::min();  // mutant: wasserstein-vanishes
  }
  static bool is_sure(const Assignment::Costs& costs) {
    return costs.cost - costs.lower <= kUnsure * costs.cost;
  }

  /// Finds a matching and stores it in partners_.
  /// @param most as for Assignment. @param bounds computes bounds of the distance from costs.
  template <class Bounds>
  Assignment::Costs match(const Unit& unit, double most, Bounds&& bounds) {
    const std::vector<Point> a = unit.in_unit(first_), b = unit.in_unit(second_);
    Assignment assignment(a, b, unit.cost, context_, most);
    const auto is_enough = [&](const Assignment::Costs& costs) {
      return costs.cost - costs.lower <= kRounding * costs.cost ||
             diagram::is_enough(bounds(costs), options_.limits);
    };
    if (!diagram::Auction(assignment, context_).run(is_enough, kMostBids * (a.size() + b.size())))
      diagram::assign_by_shortest_paths(assignment, context_);
    partners_ = assignment.partners();
    return assignment.costs();
  }

  /// Prices are rounded relative to the cost of the most expensive bar. If a matching costs far
  /// less than that bar, these prices do not prove that the matching is optimal. The search is
  /// therefore repeated in a unit of about the size of the distance found, and only among matchings
  /// that cost about as much as this matching or less.
  DistanceBounds refined(double unit_length, DistanceBounds found) {
    const double rays = norm_of(rays_, options_.order);
    const auto with_rays = [&](double length) {
      return norm_of(std::array{length, rays}, options_.order);
    };
    const auto pays = [&](double length) {
      return length > 0 && std::pow(unit_length / length, options_.order) >= kFiner;
    };
    for (double length = length_of_matching(); pays(length);) {
      const Unit unit(std::max(length, smallest_unit()), options_);
      unit_length = unit.largest;
      std::vector<std::uint32_t> before = partners_;
      // mutant: wasserstein-most
      const double most = 2 * unit.cost.power(unit.in_unit(length));  // twice the cost found
      const Assignment::Costs costs = match(unit, most, [&](const Assignment::Costs& c) {
        return DistanceBounds{with_rays(unit.root(c.cost)), with_rays(unit.root(c.lower))};
      });
      found.lower = std::max(found.lower, with_rays(unit.root(costs.lower)));
      const double other = length_of_matching();
      if (!(other < length)) {
        partners_ = std::move(before);
        break;
      }
      length = other;
      if (has_digits(costs) && is_sure(costs)) break;
    }
    found.value = with_rays(length_of_matching());
    found.lower = std::min(found.lower, found.value);
    return found;
  }

  /// The root of the cost of the matching in partners_, without the infinite bars. It is computed
  /// from the distances of its pairs and the distances of all other bars from the diagonal.
  double length_of_matching() const {
    const diagram::GroundCost cost(1, options_.ground);
    std::vector<double> lengths;
    std::vector<bool> is_paired(second_.finite.size(), false);
    for (std::size_t i = 0; i < partners_.size(); ++i) {
      const std::uint32_t j = partners_[i];
      if (j != diagram::kNone) is_paired[j] = true;
      lengths.push_back(j == diagram::kNone ? cost.distance_alone(first_.finite[i])
                                            : cost.distance(first_.finite[i], second_.finite[j]));
    }
    for (std::size_t j = 0; j < is_paired.size(); ++j)
      if (!is_paired[j]) lengths.push_back(cost.distance_alone(second_.finite[j]));
    return norm_of(lengths, options_.order);
  }

  /// The smallest usable unit. In smaller units, coordinates would overflow.
  double smallest_unit() const {
    double most = 0;
    for (const DiagramParts* parts : {&first_, &second_})
      for (const Point& p : parts->finite) most = std::max({most, std::abs(p[0]), std::abs(p[1])});
    return std::ldexp(most, -1000);
  }

  /// The largest distance from a finite bar to the diagonal or between matched infinite bars.
  double largest() const {
    double largest = 0;
    for (const DiagramParts* parts : {&first_, &second_})
      if (!parts->finite.empty())
        largest = std::max(largest, diagram::to_diagonal(parts->finite.front()));
    largest *= diagram::GroundCost::to_diagonal(options_.ground);
    for (const double ray : rays_) largest = std::max(largest, ray);
    return std::min(largest, std::numeric_limits<double>::max());
  }

  const WassersteinOptions options_;
  const RunContext& context_;
  const MemoryClaim claim_;
  const DiagramParts first_, second_;
  std::vector<double> rays_;             // the distances between the ends of infinite bars
  std::vector<std::uint32_t> partners_;  // the partner of each bar of first_.finite
};

}  // namespace

DistanceBounds wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b,
                                    const WassersteinOptions& options, const RunContext& context) {
  check(options, "wasserstein_distance");
  return Comparison(a, b, options, "wasserstein_distance", context).distance();
}

WassersteinMatching wasserstein_matching(std::span<const Bar> a, std::span<const Bar> b,
                                         const WassersteinOptions& options,
                                         const RunContext& context) {
  check(options, "wasserstein_matching");
  return Comparison(a, b, options, "wasserstein_matching", context).matching(a.size(), b.size());
}

}  // namespace ph
