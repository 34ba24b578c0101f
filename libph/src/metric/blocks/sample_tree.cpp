// SPDX-License-Identifier: MIT
#include "libph/src/metric/blocks/sample_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "libph/src/core/random.hpp"
#include "libph/src/metric/blocks/cell_boxes.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

bool precedes_from(Index axis, Index axes, const double* x, const double* y) {
  for (Index i = 0; i < axes; ++i) {
    const Index k = axis + i < axes ? axis + i : axis + i - axes;
    if (x[k] != y[k]) return x[k] < y[k];
  }
  return false;
}

}  // namespace

bool SampleTree::precedes(const double* x, const Split& split) const {
  return precedes_from(split.axis, points_.cols(), x, points_.row(Index{split.point}).data());
}

SampleTree::SampleTree(PointsView points, std::size_t sample, std::uint32_t blocks,
                       const RunContext& context)
    : splits_(&context.memory),
      cells_(&context.memory),
      blocks_(&context.memory),
      block_nodes_(blocks, kNone) {
  draw(points, sample, context);
  const auto size = static_cast<std::uint32_t>(numbers_.size());
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0U);
  context.poll();
  split({0, size}, {0, blocks}, order);
  context.poll();

  // Maps the order in which points were drawn to the order of the cells.
  std::vector<std::uint32_t> cell(size);
  for (std::uint32_t c = 0; c < size; ++c) cell[order[c]] = c;
  Points in_order(points_.rows(), points_.cols());
  std::vector<Index> numbers(size);
  for (std::uint32_t c = 0; c < size; ++c) {
    std::ranges::copy(points_.row(Index{order[c]}), in_order.row(Index{c}).begin());
    numbers[c] = numbers_[order[c]];
  }
  points_ = std::move(in_order);
  numbers_ = std::move(numbers);
  for (Split& s : splits_)
    if (s.right != 0 && size > 0) s.point = cell[s.point];
}

// Draws one point from each of `sample` equally long ranges of points, because consecutive points
// in a file are usually close together. If several drawn points are equal, the first of them is
// kept.
void SampleTree::draw(PointsView points, std::size_t sample, const RunContext& context) {
  const auto n = static_cast<std::uint64_t>(points.rows());
  const Index axes = points.cols();
  std::vector<Index> drawn;
  drawn.reserve(sample);
  Random random(1);
  const auto begin_of = [&](std::uint64_t i) { return n / sample * i + std::min(i, n % sample); };
  for (std::uint64_t i = 0; i < sample; ++i) {
    const std::uint64_t begin = begin_of(i);
    drawn.push_back(static_cast<Index>(begin + random.below(begin_of(i + 1) - begin)));
  }
  Points all(static_cast<Index>(drawn.size()), axes);
  for (Index i = 0; i < all.rows(); ++i)
    for (Index k = 0; k < axes; ++k) {
      const Index number = drawn[static_cast<std::size_t>(i)];
      all(i, k) = points(number, k);
      if (!std::isfinite(all(i, k))) throw not_finite(number, k, all(i, k));
    }
  context.poll();
  std::vector<std::uint32_t> order(drawn.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto row = [&](std::uint32_t i) { return all.row(Index{i}); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    if (precedes_from(0, axes, row(i).data(), row(j).data())) return true;
    if (precedes_from(0, axes, row(j).data(), row(i).data())) return false;
    return i < j;
  });
  const auto copies = std::ranges::unique(
      order, [&](std::uint32_t i, std::uint32_t j) { return std::ranges::equal(row(i), row(j)); });
  order.erase(copies.begin(), copies.end());
  points_ = Points(static_cast<Index>(order.size()), axes);
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::ranges::copy(row(order[i]), points_.row(static_cast<Index>(i)).begin());
    numbers_.push_back(drawn[order[i]]);
  }
}

/// Splits a node. @param order the numbers of the drawn points. The entries for the node's cells
/// are rearranged.
void SampleTree::split(Range cells, Range blocks, std::span<std::uint32_t> order) {
  const auto node = static_cast<Node>(splits_.size());
  splits_.push_back({0, 0, 0, 0});
  cells_.push_back(cells);
  blocks_.push_back(blocks);
  if (blocks.size() == 1) {
    if (block_nodes_[blocks.begin] == kNone) block_nodes_[blocks.begin] = node;
    if (cells.size() <= 1) return;
  }
  const auto share = [&](std::uint32_t count) {
    return static_cast<std::uint32_t>(std::uint64_t{cells.size()} * count / blocks.size());
  };
  const std::uint32_t blocks_left = blocks.size() / 2;
  const std::uint32_t middle =
      cells.begin + (blocks.size() == 1 ? cells.size() / 2 : share(blocks_left));
  const std::uint32_t middle_block = blocks.begin + blocks_left;
  Split split{-std::numeric_limits<double>::infinity(), 0, 0, 0};
  if (cells.begin < middle) {
    const std::span<std::uint32_t> mine = order.subspan(cells.begin, cells.size());
    double widest = -1;
    for (Index k = 0; k < points_.cols(); ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const std::uint32_t i : mine) {
        low = std::min(low, points_(Index{i}, k));
        high = std::max(high, points_(Index{i}, k));
      }
      if (high - low > widest) {
        widest = high - low;
        split.axis = static_cast<std::uint32_t>(k);
      }
    }
    std::ranges::nth_element(
        mine, mine.begin() + (middle - cells.begin), [&](std::uint32_t i, std::uint32_t j) {
          return precedes_from(split.axis, points_.cols(), points_.row(Index{i}).data(),
                               points_.row(Index{j}).data());
        });
    split.point = order[middle];
    split.value = points_(Index{split.point}, Index{split.axis});
  }
  const bool is_block = blocks.size() == 1;
  this->split({cells.begin, middle}, {blocks.begin, is_block ? blocks.end : middle_block}, order);
  split.right = static_cast<Node>(splits_.size());
  splits_[node] = split;
  this->split({middle, cells.end}, {is_block ? blocks.begin : middle_block, blocks.end}, order);
}

NearSample nearest_sample(const SampleTree& tree, std::uint32_t block, const double* x,
                          NearSample known) {
  struct Entry {
    SampleTree::Node node;
    double gap;  // a lower bound for the squared distance to the node
  };
  // The stack has one entry per level. A set of points cannot be halved more than 64 times.
  std::array<Entry, 64> stack;
  std::size_t height = 0;
  stack[height++] = {tree.node_of_block(block), 0};
  while (height > 0) {
    auto [node, gap] = stack[--height];
    if (gap >= known.square) continue;
    while (!tree.is_leaf(node)) {
      const double to_split = x[tree.axis(node)] - tree.value(node);
      const SampleTree::Node child = tree.child(node, x);
      const bool is_left = child == tree.left(node);
      stack[height++] = {is_left ? tree.right(node) : tree.left(node),
                         std::max(gap, to_split * to_split)};
      node = child;
    }
    if (tree.cells(node).size() == 0) continue;
    const SampleTree::Cell cell = tree.cells(node).begin;
    const double square = squared_distance(x, tree.points().row(Index{cell}), tree.points().cols());
    if (square < known.square) known = {cell, square};  // mutant: cloud-nearer
  }
  return known;
}

Bottlenecks::Bottlenecks(const SampleTree& tree, double largest, const RunContext& context)
    : parent_(tree.cell_count(), &context.memory),
      length_(tree.cell_count(), std::numeric_limits<double>::infinity(), &context.memory),
      first_(length_, &context.memory),
      within_(tree.node_count(), 0.0, &context.memory),
      edges_(&context.memory) {
  FlagEdges forest = spanning_forest(tree.points(), PointDistance::euclidean, 2, {},
                                     std::numeric_limits<double>::infinity(), context, largest);
  std::ranges::sort(forest, precedes);
  std::iota(parent_.begin(), parent_.end(), 0U);
  std::pmr::vector<std::uint32_t> size(parent_.size(), 1, &context.memory);
  const auto root = [&](std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v];
    return v;
  };
  edges_.reserve(forest.size());
  // Links sets by size, which keeps paths to roots short without path compression.
  for (const FlagEdge& e : forest) {
    edges_.push_back({e.value, e.u, e.v});
    for (const SampleTree::Cell cell : {e.u, e.v}) first_[cell] = std::min(first_[cell], e.value);
    std::uint32_t small = root(e.u), large = root(e.v);
    if (size[small] > size[large]) std::swap(small, large);
    parent_[small] = large;
    length_[small] = e.value;
    size[large] += size[small];
  }
  for (SampleTree::Node node = tree.node_count(); node-- > 0;) {
    if (tree.is_leaf(node)) continue;
    const SampleTree::Node left = tree.left(node), right = tree.right(node);
    within_[node] = std::max(within_[left], within_[right]);
    if (tree.cells(left).size() > 0 && tree.cells(right).size() > 0)
      within_[node] =
          std::max(within_[node], between(tree.cells(left).begin, tree.cells(right).begin));
  }
}

}  // namespace ph
