// SPDX-License-Identifier: MIT
#include "skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "near_pairs.hpp"
#include "ph/core/error.hpp"
#include "ph/engine/elder_rule.hpp"

namespace ph::segment {
namespace {

/// The positions of `values` in ascending order, equal ones in their order.
std::pmr::vector<std::uint32_t> stable_order(const std::pmr::vector<double>& values,
                                             std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> order(values.size(), memory);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  return order;
}

/// The same where there are few values: counts each level, then deals the positions out.
std::pmr::vector<std::uint32_t> stable_order_of_levels(const std::pmr::vector<double>& values,
                                                       double distance, int steps,
                                                       std::pmr::memory_resource* memory) {
  const auto level_of = [&](double value) {
    return static_cast<std::size_t>(std::lround(value / distance * steps));
  };
  std::vector<std::size_t> next(static_cast<std::size_t>(steps) + 2);
  for (const double value : values) ++next[level_of(value) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::pmr::vector<std::uint32_t> order(values.size(), memory);
  for (std::uint32_t i = 0; i < values.size(); ++i) order[next[level_of(values[i])]++] = i;
  return order;
}

}  // namespace

Skeleton::Skeleton(const Points& points, double distance, int steps, const RunContext& context)
    : size_(static_cast<std::uint32_t>(points.rows())),
      edges_(&context.memory),
      values_(&context.memory) {
  std::pmr::vector<GraphEdge> pairs(&context.memory);
  std::pmr::vector<double> values(&context.memory);
  Ticker ticker(context, "complex");
  for_each_near_pair(points, distance, [&](std::uint32_t i, std::uint32_t j, double length) {
    pairs.push_back({std::min(i, j), std::max(i, j)});
    values.push_back(filtration_value(length, distance, steps));
    ticker.tick();
  });
  if (size_ + pairs.size() >= UINT32_MAX) {
    throw Error(ErrorKind::resource,
                fmt::format("found {} vertices and {} edges, expected fewer than 2^32 - 1 of both; "
                            "lower the distance or enlarge the voxels",
                            size_, pairs.size()));
  }
  constexpr int kFewSteps = 4096;
  const bool few = steps > 0 && steps <= kFewSteps && distance > 0;
  const auto order = few ? stable_order_of_levels(values, distance, steps, &context.memory)
                         : stable_order(values, &context.memory);
  edges_.reserve(order.size());
  values_.reserve(order.size());
  for (const std::uint32_t i : order) {
    edges_.push_back(pairs[i]);
    values_.push_back(values[i]);
  }
}

void Skeleton::append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const {
  if (dim == 0) {
    numbers.push_back(cell);
  } else {
    numbers.insert(numbers.end(), {edges_[cell - size_].u, edges_[cell - size_].v});
  }
}

double filtration_value(double length, double distance, int steps) {
  if (steps == 0 || length == 0) return length;
  const auto level = [&](double k) { return k == steps ? distance : k * distance / steps; };
  // The division may round to the wrong side of a level: look at the neighbours, too.
  double k = std::clamp(std::ceil(length / distance * steps), 1.0, static_cast<double>(steps));
  while (k > 1 && level(k - 1) >= length) --k;
  while (k < steps && level(k) < length) ++k;
  return level(k);
}

MergeTree merge_tree(const Skeleton& skeleton, const RunContext& context) {
  MergeTree tree;
  const auto size = static_cast<std::size_t>(skeleton.size());
  tree.births.assign(size, 0.0);
  std::vector<std::uint32_t> age(size);
  std::iota(age.begin(), age.end(), 0U);
  std::vector<Index> sizes(size, 1);
  join_by_elder_rule(age, skeleton.edges(), context,
                     [&](std::size_t edge, std::uint32_t elder, std::uint32_t younger) {
                       const GraphEdge& e = skeleton.edges()[edge];
                       tree.merges.push_back({skeleton.edge_value(edge), e.u, e.v, elder, younger,
                                              sizes[elder], sizes[younger], 0.0, 0.0});
                       sizes[elder] += sizes[younger];
                     });
  return tree;
}

}  // namespace ph::segment
