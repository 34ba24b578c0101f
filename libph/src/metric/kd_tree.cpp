// SPDX-License-Identifier: MIT
#include "ph/detail/metric/kd_tree.hpp"

#include <algorithm>

#include "ph/detail/core/parallel.hpp"

namespace ph {

KdTree::KdTree(PointsView points, std::span<const std::uint32_t> rows, const RunContext& context)
    : levels_(static_cast<int>(std::bit_width((rows.size() - 1) / kLeafSize))),
      claim_(context.memory,
             rows.size() * static_cast<std::size_t>(points.cols()) * sizeof(double)),
      points_(static_cast<Index>(rows.size()), points.cols()),
      rows_(rows.begin(), rows.end(), &context.memory),
      boxes_(node_count() * box_size(), &context.memory) {
  std::pmr::vector<Item> items(rows.size(), &context.memory);
  for (std::size_t i = 0; i < items.size(); ++i) items[i].row = rows[i];
  const auto put = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      rows_[i] = items[i].row;
      std::copy_n(points.row(items[i].row), points.cols(),
                  points_.row(static_cast<Index>(i)).data());
    }
  };
  if (items.size() < 1 << 15) {  // so few points do not justify a thread
    split_below(1, points, items);
    put(0, items.size());
    return;
  }
  // Splits the first levels one by one, then the subtrees below them in parallel.
  constexpr int top = 6;
  for (int level = 0; level <= top; ++level) {
    const Node first = Node{1} << level;
    for_each_piece("k-d tree", first, 1, context, [&](std::size_t i, std::size_t) {
      const Node node = first + static_cast<Node>(i);
      if (level < top)
        split(node, points, items);
      else
        split_below(node, points, items);
    });
  }
  for_each_piece("k-d tree", items.size(), 1 << 16, context, put);
}

void KdTree::split_below(Node node, PointsView points, std::span<Item> items) {
  split(node, points, items);
  if (is_leaf(node)) return;
  split_below(2 * node, points, items);
  split_below(2 * node + 1, points, items);
}

void KdTree::split(Node node, PointsView points, std::span<Item> items) {
  const std::span<Item> mine = items.subspan(begin(node), end(node) - begin(node));
  double* const box = boxes_.data() + node * box_size();
  const Index axes = points.cols();
  const auto coordinates = [&](const Item& item) { return points.row(item.row); };
  for (Index k = 0; k < axes; ++k) {
    double low = coordinates(mine.front())[k], high = low;
    for (const Item& item : mine) {
      const double x = coordinates(item)[k];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    box[2 * k] = low;
    box[2 * k + 1] = high;
  }
  if (is_leaf(node)) return;
  Index widest = 0;
  for (Index k = 1; k < axes; ++k)
    if (box[2 * k + 1] - box[2 * k] > box[2 * widest + 1] - box[2 * widest]) widest = k;
  for (Item& item : mine) item.key = coordinates(item)[widest];
  std::nth_element(
      mine.begin(), mine.begin() + (begin(2 * node + 1) - begin(node)), mine.end(),
      [](const Item& a, const Item& b) { return a.key != b.key ? a.key < b.key : a.row < b.row; });
}

}  // namespace ph
