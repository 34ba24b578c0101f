// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "libph/src/diagram/diagram_parts.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/distances.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using diagram::DiagramParts;
using diagram::Point;

/// The points of one diagram and, for each point of the other diagram, the nearest point of the
/// diagonal, all divided by 2^exponent.
std::vector<Point> with_diagonal(const DiagramParts& own, const DiagramParts& other, int exponent) {
  std::vector<Point> points;
  points.reserve(own.finite.size() + other.finite.size());
  for (const Point& p : own.finite)
    points.push_back({std::ldexp(p[0], -exponent), std::ldexp(p[1], -exponent)});
  for (const Point& p : other.finite) {
    const double middle = (std::ldexp(p[0], -exponent) + std::ldexp(p[1], -exponent)) / 2;
    points.push_back({middle, middle});  // mutant: sliced-other
  }
  return points;
}

std::vector<double> projections(const std::vector<Point>& points, double angle) {
  const double x = std::cos(angle), y = std::sin(angle);
  std::vector<double> numbers;
  numbers.reserve(points.size());
  for (const Point& p : points) numbers.push_back(x * p[0] + y * p[1]);
  std::ranges::sort(numbers);
  return numbers;
}

}  // namespace

double sliced_wasserstein_distance(std::span<const Bar> a, std::span<const Bar> b, int directions,
                                   const RunContext& context) {
  if (directions < 1)
    throw Error(ErrorKind::usage,
                fmt::format("sliced_wasserstein_distance: found {} directions, expected at least 1",
                            directions));
  const auto count = static_cast<std::size_t>(directions);
  // Memory for the parts of both diagrams, for the points that all threads share, for the
  // projections in each thread, and for one sum per direction.
  const MemoryClaim claim(
      context.memory,
      sizeof(double) * (count + (a.size() + b.size()) * (12 + 2 * thread_count(context))));
  const DiagramParts first(a, "sliced_wasserstein_distance"),
      second(b, "sliced_wasserstein_distance");
  if (!diagram::have_as_many_infinite(first, second)) return kInfinity;
  double largest = 0;
  for (const DiagramParts* parts : {&first, &second})
    for (const Point& p : parts->finite)
      largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
  const int exponent = largest > 0 ? std::ilogb(largest) + 1 : 0;
  const std::vector<Point> points[2] = {with_diagonal(first, second, exponent),
                                        with_diagonal(second, first, exponent)};
  std::vector<double> sums(count);
  for_each_piece("sliced Wasserstein distance", count, 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) {
                     // mutant: sliced-angle
                     const double angle =
                         std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
                     const std::vector<double> x = projections(points[0], angle),
                                               y = projections(points[1], angle);
                     for (std::size_t i = 0; i < x.size(); ++i) sums[k] += std::abs(x[i] - y[i]);
                   }
                 });
  double sum = 0;
  for (const double s : sums) sum += s;
  double result = std::ldexp(sum / directions, exponent);
  for (const std::size_t k : {0U, 1U})
    for (std::size_t i = 0; i < first.rays[k].size(); ++i)
      result += std::abs(first.rays[k][i].value - second.rays[k][i].value);
  return result;
}

}  // namespace ph
