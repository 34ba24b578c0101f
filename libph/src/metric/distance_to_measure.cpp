// SPDX-License-Identifier: MIT
#include "ph/distance_to_measure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "libph/src/metric/neighbour_search.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/error.hpp"

namespace ph {

void detail::check_neighbours(Index neighbours, Index size) {
  if (neighbours < 1 || neighbours > size) {
    throw Error(ErrorKind::usage, fmt::format("neighbours: found {}, expected 1 to the number of "
                                              "points, {}",
                                              neighbours, size));
  }
}

double detail::root_mean_square(std::span<const double> distances) {
  const double largest = distances.empty() ? 0 : std::ranges::max(distances);
  if (largest == 0 || std::isinf(largest)) return largest;
  double sum = 0;  // the sum is scaled, because squares may leave the range of double
  for (const double d : distances) sum += (d / largest) * (d / largest);
  return largest * std::sqrt(sum / static_cast<double>(distances.size() + 1));
}

std::vector<double> distance_to_measure(PointsView points, Index neighbours, PointDistance distance,
                                        double p, const RunContext& context) {
  const PointMetric checked(points, distance, p);
  points = checked.points();  // now the rows are contiguous
  detail::check_neighbours(neighbours, points.rows());
  const auto others = static_cast<std::size_t>(neighbours - 1);
  // A list of neighbours is kept sorted while it grows. If the lists are longer than this,
  // computing all distances is faster.
  constexpr std::size_t most_others = 512;
  if (others == 0 || others > most_others || points.cols() == 0 ||
      !has_fast_spanning_forest(points, distance))
    return distance_to_measure(checked, neighbours, context);

  std::pmr::vector<std::uint32_t> rows(static_cast<std::size_t>(points.rows()), &context.memory);
  std::iota(rows.begin(), rows.end(), 0U);
  const KdTree tree(points, rows, context);
  const PointMetric metric(tree.points(), distance, p);
  const auto search = NeighbourSearch::make(tree, metric, distance, p);
  std::vector<double> result(rows.size());
  const auto measure = [&](std::size_t begin, std::size_t end) {
    using Neighbour = NeighbourSearch::Neighbour;
    std::vector<Neighbour> found(KdTree::kLeafSize * others);
    std::vector<double> distances(others);
    for (std::size_t i = begin; i < end; ++i) {
      const auto leaf = static_cast<KdTree::Node>(tree.first_leaf() + i);
      search->nearest(leaf, others, std::numeric_limits<double>::infinity(),
                      NeighbourSearch::Ties::any, found);
      for (KdTree::Position q = tree.begin(leaf); q < tree.end(leaf); ++q) {
        const Neighbour* const list = &found[(q - tree.begin(leaf)) * others];
        for (std::size_t k = 0; k < others; ++k) distances[k] = list[k].distance;
        result[tree.rows()[q]] = detail::root_mean_square(distances);
      }
    }
  };
  for_each_piece("distance to measure", tree.first_leaf(), 128, context, measure);
  return result;
}

}  // namespace ph
