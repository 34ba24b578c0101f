// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "diagram/diagram_parts.hpp"
#include "diagram/wasserstein/auction.hpp"
#include "diagram/wasserstein/shortest_paths.hpp"
#include "ph/distances.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using diagram::Assignment;
using diagram::DiagramParts;
using diagram::Point;

// Near enough to the optimum to say that it is: this is what sums of many costs are rounded to.
constexpr double kRounding = 1e-13;

// Bids of a round and bar. Auctions that are not at war about equal bars need some 2 to 20.
constexpr std::uint64_t kMostBids = 400;

// Trees and their weights count themselves.
constexpr std::size_t kBytesAPricedBar = 200;

void check(const WassersteinOptions& options, std::string_view function) {
  if (!(options.order >= 1 && options.order < kInfinity))
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: order: found {}, expected a finite number >= 1{}", function, options.order,
                    options.order == kInfinity ? "; infinity is bottleneck_distance" : ""));
  if (!(options.ground >= 1))
    throw Error(ErrorKind::usage, fmt::format("{}: ground: found {}, expected a number >= 1",
                                              function, options.ground));
  diagram::check(options.limits, function);
}

/// Two diagrams in a unit of length, a power of two, in which powers of lengths overflow nowhere.
class Comparison {
 public:
  Comparison(std::span<const Bar> a, std::span<const Bar> b, const WassersteinOptions& options,
             std::string_view function, const RunContext& context)
      : options_(options),
        context_(context),
        claim_(context.memory, (a.size() + b.size()) * kBytesAPricedBar),
        first_(a, function),
        second_(b, function),
        largest_(largest()),
        exponent_(largest_ > 0 ? std::ilogb(largest_) : 0),
        // Powers of order 1 and 2 are exact where they can be; others are of numbers up to 1.
        cost_(options.order, options.ground, largest_ > 0 ? std::ldexp(largest_, -exponent_) : 1) {}

  DistanceBounds distance() {
    if (!diagram::have_as_many_infinite(first_, second_)) return {kInfinity, kInfinity};
    double rays = 0;
    for (const std::size_t k : {0U, 1U})
      for (std::size_t i = 0; i < first_.rays[k].size(); ++i)
        rays += cost_.power(std::ldexp(ray_difference(k, i), -exponent_));
    const auto bounds = [&](const Assignment::Costs& costs) {
      const auto root = [&](double cost) { return std::ldexp(cost_.root(cost), exponent_); };
      return DistanceBounds{root(rays + costs.cost), root(rays + costs.lower)};
    };
    const std::vector<Point> a = in_unit(first_), b = in_unit(second_);
    if (a.empty() || b.empty()) {  // all to the diagonal
      Assignment::Costs costs{0, 0};
      for (const std::vector<Point>* points : {&a, &b})
        for (const Point& p : *points) costs.cost += cost_.alone(p);
      costs.lower = costs.cost;
      partners_.assign(a.size(), diagram::kNone);
      return bounds(costs);
    }
    Assignment assignment(a, b, cost_, context_);
    const auto is_enough = [&](const Assignment::Costs& costs) {
      return costs.cost - costs.lower <= kRounding * costs.cost ||
             diagram::is_enough(bounds(costs), options_.limits);
    };
    if (!diagram::Auction(assignment, context_).run(is_enough, kMostBids * (a.size() + b.size())))
      diagram::assign_by_shortest_paths(assignment, context_);
    partners_ = assignment.partners();
    return bounds(assignment.costs());
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
  double ray_difference(std::size_t k, std::size_t i) const {
    return std::abs(first_.rays[k][i].value - second_.rays[k][i].value);
  }
  std::vector<Point> in_unit(const DiagramParts& parts) const {
    std::vector<Point> points;
    points.reserve(parts.finite.size());
    for (const Point& p : parts.finite)
      points.push_back({std::ldexp(p[0], -exponent_), std::ldexp(p[1], -exponent_)});
    return points;
  }

  /// What the dearest bar is apart from where it may go.
  double largest() const {
    double largest = 0;
    for (const DiagramParts* parts : {&first_, &second_})
      if (!parts->finite.empty())
        largest = std::max(largest, diagram::to_diagonal(parts->finite.front()));
    largest *= diagram::GroundCost::to_diagonal(options_.ground);
    for (const std::size_t k : {0U, 1U})
      for (std::size_t i = 0; i < std::min(first_.rays[k].size(), second_.rays[k].size()); ++i)
        largest = std::max(largest, ray_difference(k, i));
    return std::min(largest, std::numeric_limits<double>::max());
  }

  const WassersteinOptions options_;
  const RunContext& context_;
  const MemoryClaim claim_;
  const DiagramParts first_, second_;
  const double largest_;
  const int exponent_;
  const diagram::GroundCost cost_;
  std::vector<std::uint32_t> partners_;  // by place in first_.finite
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
