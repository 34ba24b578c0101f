// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libph/src/core/random.hpp"
#include "libph/src/metric/neighbour_search.hpp"
#include "libph/src/significance/quantile.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/error.hpp"
#include "ph/significance.hpp"

namespace ph {
namespace {

/// The points of one subsample and all other points, in the form that the search in a k-d tree
/// needs.
class Subsample {
 public:
  static constexpr std::uint32_t kOthers = 0, kChosen = 1;

  Subsample(const KdTree& tree, const RunContext& context)
      : tree_(tree),
        order_(tree.size(), &context.memory),
        of_point_(tree.size(), &context.memory),
        of_node_(tree.node_count(), &context.memory) {}

  void choose(std::size_t size, Random& random) {
    std::iota(order_.begin(), order_.end(), 0U);
    draw(order_, size, random);
    std::ranges::fill(of_point_, kOthers);
    for (std::size_t i = 0; i < size; ++i) of_point_[order_[i]] = kChosen;
    NeighbourSearch::Parts::find_nodes(tree_, of_point_, of_node_);
  }

  bool is_chosen(KdTree::Position p) const { return of_point_[p] == kChosen; }
  NeighbourSearch::Parts parts() const { return {of_point_, of_node_}; }

 private:
  const KdTree& tree_;
  std::pmr::vector<std::uint32_t> order_, of_point_, of_node_;
};

std::size_t usual_size(std::size_t n) {
  if (n < 3) return n;
  return static_cast<std::size_t>(std::lround(static_cast<double>(n) / std::log(n)));
}

void check(std::size_t n, const ConfidenceOptions& options) {
  significance::check_alpha(options.alpha, "confidence_radius");
  if (n == 0)
    throw Error(ErrorKind::usage, "confidence_radius: found no points, expected at least one");
  if (options.subsamples == 0)
    throw Error(ErrorKind::usage, "confidence_radius: subsamples: found 0, expected at least 1");
  if (options.size > n)
    throw Error(ErrorKind::usage,
                fmt::format("confidence_radius: size: found {}, expected 1 to the number of "
                            "points, {}, or 0 for n / ln n",
                            options.size, n));
}

}  // namespace

double confidence_radius(PointsView points, const ConfidenceOptions& options,
                         const RunContext& context) {
  const auto n = static_cast<std::size_t>(points.rows());
  check(n, options);
  const PointMetric checked(points, PointDistance::euclidean, 2);
  if (points.cols() == 0) return 0;  // all points are equal
  std::pmr::vector<std::uint32_t> rows(n, &context.memory);
  std::iota(rows.begin(), rows.end(), 0U);
  const KdTree tree(checked.points(), rows, context);
  const PointMetric metric(tree.points(), PointDistance::euclidean, 2);
  const auto search =
      NeighbourSearch::make(tree, metric, PointDistance::euclidean, 2, nullptr, context);
  const std::size_t size = options.size == 0 ? usual_size(n) : options.size;

  // The Hausdorff distance between each subsample and all points.
  std::vector<double> distances(options.subsamples);
  for_each_piece(
      "subsamples", options.subsamples, 1, context, [&](std::size_t begin, std::size_t end) {
        Subsample subsample(tree, context);
        for (std::size_t k = begin; k < end; ++k) {
          Random random(options.seed, k);
          subsample.choose(size, random);
          double farthest = 0;
          const NeighbourSearch::Parts parts = subsample.parts();
          NeighbourSearch::Query query{.ties = NeighbourSearch::Ties::any, .parts = &parts};
          for (query.leaf = tree.first_leaf(); query.leaf < tree.node_count(); ++query.leaf) {
            if (query.leaf % 128 == 0 && context.stop.stop_requested()) return;
            const KdTree::Position first = tree.begin(query.leaf), last = tree.end(query.leaf);
            for (KdTree::Position p = first; p < last; ++p)
              query.limits[p - first] =
                  subsample.is_chosen(p) ? -1 : std::numeric_limits<double>::infinity();
            std::array<NeighbourSearch::Neighbour, KdTree::kLeafSize> nearest;
            search->nearest(query, nearest);
            for (KdTree::Position p = first; p < last; ++p)
              if (!subsample.is_chosen(p))
                farthest = std::max(farthest, nearest[p - first].distance);
          }
          distances[k] = farthest;
        }
      });
  return 2 * significance::upper_quantile(distances, options.alpha);  // mutant: confidence-doubled
}

}  // namespace ph
