// SPDX-License-Identifier: MIT
#include "ph/greedy_permutation.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "libph/src/metric/plain_squares.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

// The squared Euclidean distances of all points to the chosen points, computed axis by axis. The
// compiler can vectorise the loops, because they contain neither branches nor sums across points. A
// compiler must not reorder such sums.
class Squares {
 public:
  Squares(PointsView points, const RunContext& context)
      : axes_(points.cols()),
        size_(static_cast<std::size_t>(points.rows())),
        coordinates_(size_ * static_cast<std::size_t>(axes_), &context.memory),
        nearest_(size_, std::numeric_limits<double>::infinity(), &context.memory) {
    for (Index k = 0; k < axes_; ++k)
      for (std::size_t i = 0; i < size_; ++i) axis(k)[i] = points(static_cast<Index>(i), k);
  }

  void add(std::size_t chosen) {
    std::array<double, kBlock> sum;
    for (std::size_t begin = 0; begin < size_; begin += kBlock) {
      const std::size_t count = std::min(kBlock, size_ - begin);
      sum.fill(0);
      for (Index k = 0; k < axes_; ++k) {
        const double* const x = axis(k) + begin;
        const double at = axis(k)[chosen];
        for (std::size_t i = 0; i < count; ++i) sum[i] += (x[i] - at) * (x[i] - at);
      }
      double* const nearest = nearest_.data() + begin;
      for (std::size_t i = 0; i < count; ++i) nearest[i] = std::min(nearest[i], sum[i]);
    }
  }

  struct Farthest {
    std::size_t point;
    double square;
  };
  Farthest farthest() const {
    std::array<double, 8> lanes{};  // one maximum per lane
    const std::size_t whole = size_ - size_ % lanes.size();
    for (std::size_t i = 0; i < whole; i += lanes.size())
      for (std::size_t l = 0; l < lanes.size(); ++l) lanes[l] = std::max(lanes[l], nearest_[i + l]);
    double largest = *std::ranges::max_element(lanes);
    for (std::size_t i = whole; i < size_; ++i) largest = std::max(largest, nearest_[i]);
    // Squares may differ although their rounded roots, the distances, are equal.
    const double root = std::sqrt(largest), almost = largest * (1 - 1e-15);
    for (std::size_t i = 0; i < size_; ++i)
      // mutant: greedy-root
      if (nearest_[i] >= almost && std::sqrt(nearest_[i]) == root) return {i, largest};
    return {0, largest};
  }

 private:
  static constexpr std::size_t kBlock = 512;
  double* axis(Index k) { return coordinates_.data() + static_cast<std::size_t>(k) * size_; }

  Index axes_;
  std::size_t size_;
  std::pmr::vector<double> coordinates_;  // axis by axis
  std::pmr::vector<double> nearest_;
};

/// The permutation, found by comparing squared distances. Returns nothing if squares would lose
/// digits.
std::optional<GreedyPermutation> by_squares(PointsView points, const GreedyLimits& limits,
                                            const RunContext& context) {
  const double reach = largest_coordinate(points);
  if (!(kSmallestPlain < reach && reach < kLargestPlain)) return std::nullopt;
  const Index count = std::min(points.rows(), limits.points);
  Squares squares(points, context);
  GreedyPermutation result;
  result.covering_radius = std::numeric_limits<double>::infinity();
  Ticker ticker(context, "greedy permutation", static_cast<std::uint64_t>(count));
  for (std::size_t next = 0; static_cast<Index>(result.points.size()) < count;) {
    result.points.push_back(static_cast<std::uint32_t>(next));
    result.radii.push_back(result.covering_radius);
    squares.add(next);
    const auto [farthest, square] = squares.farthest();
    if (square > 0 && square < PointMetric::kLeastPlainSquare) return std::nullopt;
    ticker.tick();
    ticker.work(static_cast<std::uint64_t>(points.size()));
    next = farthest;
    result.covering_radius = std::sqrt(square);
    if (result.covering_radius <= limits.radius) break;
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> GreedyPermutation::ascending() const {
  std::vector<std::uint32_t> sorted = points;
  std::ranges::sort(sorted);
  return sorted;
}

void detail::check(const GreedyLimits& limits, Index size) {
  if (size >= Index{UINT32_MAX}) {
    throw Error(
        ErrorKind::resource,
        fmt::format("greedy permutation: found {} points, expected fewer than 2^32 - 1", size));
  }
  if (limits.points < 1 || !(limits.radius >= 0)) {
    throw Error(ErrorKind::usage, fmt::format("greedy permutation: found {} points and radius {}, "
                                              "expected at least 1 point and a radius >= 0",
                                              limits.points, limits.radius));
  }
}

GreedyPermutation greedy_permutation(PointsView points, const GreedyLimits& limits,
                                     PointDistance distance, double p, const RunContext& context) {
  PointMetric metric(points, distance, p);
  detail::check(limits, points.rows());
  if (distance == PointDistance::euclidean) {
    if (auto result = by_squares(points, limits, context)) return *std::move(result);
  }
  metric.keep_directions(context);
  return greedy_permutation(metric, limits, context);
}

}  // namespace ph
