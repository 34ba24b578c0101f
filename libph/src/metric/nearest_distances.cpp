// SPDX-License-Identifier: MIT
#include "ph/detail/metric/nearest_distances.hpp"

#include <limits>
#include <numeric>

#include "libph/src/metric/neighbour_search.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/metric/row_distances.hpp"
#include "ph/detail/metric/spanning_forest.hpp"

namespace ph::detail {
namespace {

/// Computes each distance once, in rows, and keeps a sorted list of k distances per point.
void compare_rows(const PointMetric& metric, Index k, std::string_view stage, const UseNearest& use,
                  const RunContext& context) {
  const auto n = static_cast<std::size_t>(metric.size()), count = static_cast<std::size_t>(k);
  constexpr double never = std::numeric_limits<double>::infinity();
  std::pmr::vector<double> lists(n * count, never, &context.memory);
  std::pmr::vector<double> last(n, never, &context.memory);  // of each list
  const auto insert = [&](std::size_t point, double distance) {
    double* const list = &lists[point * count];
    std::size_t place = count - 1;
    for (; place > 0 && distance < list[place - 1]; --place) list[place] = list[place - 1];
    list[place] = distance;
    last[point] = list[count - 1];
  };
  const RowDistances<PointMetric> rows(metric, &context.memory);
  std::pmr::vector<double> row(static_cast<std::size_t>(rows.row_capacity()), &context.memory);
  Ticker ticker(context, stage, n);
  for (std::size_t i = 0; i < n; ++i) {
    rows(static_cast<Index>(i), row.data());
    for (std::size_t j = 0; j < i; ++j) {
      if (row[j] < last[j]) insert(j, row[j]);
      if (row[j] < last[i]) insert(i, row[j]);
    }
    ticker.tick();
    ticker.work(i);
  }
  for (std::size_t i = 0; i < n; ++i)
    use(static_cast<Index>(i), std::span(lists).subspan(i * count, count));
}

}  // namespace

void for_each_nearest(PointsView points, Index k, PointDistance distance, double p,
                      std::string_view stage, const UseNearest& use, const RunContext& context) {
  PointMetric checked(points, distance, p);
  points = checked.points();  // now the rows are contiguous
  // A list of neighbours is kept sorted while it grows. If the lists are longer than this,
  // computing all distances is faster.
  constexpr Index most_neighbours = 512;
  if (k == 0 || k > most_neighbours || points.cols() == 0 ||
      !has_fast_spanning_forest(points, distance)) {
    checked.keep_directions(context);
    constexpr Index longest_list = 64;  // insertions into longer lists cost more than they save
    if (0 < k && k <= longest_list)
      compare_rows(checked, k, stage, use, context);
    else
      for_each_nearest(checked, k, stage, use, context);
    return;
  }
  std::pmr::vector<std::uint32_t> rows(static_cast<std::size_t>(points.rows()), &context.memory);
  std::iota(rows.begin(), rows.end(), 0U);
  const KdTree tree(points, rows, context);
  const PointMetric metric(tree.points(), distance, p);
  const auto search = NeighbourSearch::make(tree, metric, distance, p, nullptr, context);
  const auto count = static_cast<std::size_t>(k);
  const auto find = [&](std::size_t begin, std::size_t end) {
    std::vector<NeighbourSearch::Neighbour> found(KdTree::kLeafSize * count);
    std::vector<double> distances(count);
    for (std::size_t i = begin; i < end; ++i) {
      const auto leaf = static_cast<KdTree::Node>(tree.first_leaf() + i);
      NeighbourSearch::Query query{.leaf = leaf, .k = count, .ties = NeighbourSearch::Ties::any};
      query.limits.fill(std::numeric_limits<double>::infinity());
      search->nearest(query, found);
      for (KdTree::Position q = tree.begin(leaf); q < tree.end(leaf); ++q) {
        const auto* const list = &found[(q - tree.begin(leaf)) * count];
        for (std::size_t j = 0; j < count; ++j) distances[j] = list[j].distance;
        use(Index{tree.rows()[q]}, distances);
      }
    }
  };
  for_each_piece(stage, tree.first_leaf(), 16, context, find);
}

}  // namespace ph::detail
