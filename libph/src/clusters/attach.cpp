// SPDX-License-Identifier: MIT
// Finds the places of new points in a hierarchy.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "libph/src/metric/neighbour_search.hpp"
#include "ph/cluster_tree.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using Neighbour = NeighbourSearch::Neighbour;

Points stacked(PointsView points, PointsView added) {
  if (points.cols() != added.cols() && points.rows() > 0 && added.rows() > 0)
    throw Error(ErrorKind::usage, fmt::format("added points: found {} coordinates, expected {}",
                                              added.cols(), points.cols()));
  Points all(points.rows() + added.rows(), std::max(points.cols(), added.cols()));
  for (Index i = 0; i < all.rows(); ++i) {
    const bool is_added = i >= points.rows();
    const PointsView& from = is_added ? added : points;
    for (Index k = 0; k < all.cols(); ++k) all(i, k) = from(is_added ? i - points.rows() : i, k);
  }
  return all;
}

/// The points of a hierarchy, followed by the added points.
class JointPoints {
 public:
  JointPoints(PointsView points, PointsView added, PointDistance distance, double p,
              const RunContext& context)
      : first_(points.rows()),
        all_(stacked(points, added)),
        metric_(all_, distance, p),
        distance_(distance),
        p_(p) {
    metric_.keep_directions(context);
  }

  Index first() const { return first_; }
  Index added() const { return all_.rows() - first_; }

  /// Calls `use` for each added point with its `count` nearest points of the hierarchy, nearest
  /// first; their positions are row numbers. Several threads may call it at once.
  /// @param births one per row, or empty.
  void for_each_added(std::size_t count, std::span<const double> births, std::string_view stage,
                      const std::function<void(Index, std::span<const Neighbour>)>& use,
                      const RunContext& context) const {
    if (first_ == 0 || added() == 0 || all_.cols() == 0 ||
        !has_fast_spanning_forest(all_, distance_))
      compare_all(count, births, stage, use, context);
    else
      search_tree(count, births, stage, use, context);
  }

 private:
  void search_tree(std::size_t count, std::span<const double> births, std::string_view stage,
                   const std::function<void(Index, std::span<const Neighbour>)>& use,
                   const RunContext& context) const {
    std::pmr::vector<std::uint32_t> rows(static_cast<std::size_t>(all_.rows()), &context.memory);
    std::iota(rows.begin(), rows.end(), 0U);
    const KdTree tree(all_, rows, context);
    const PointMetric metric(tree.points(), distance_, p_);
    std::optional<PointBirths> of_tree;
    if (!births.empty()) of_tree.emplace(tree, births, context);
    const auto search =
        NeighbourSearch::make(tree, metric, distance_, p_, of_tree ? &*of_tree : nullptr, context);
    // The added points are one part, so that only points of the hierarchy are found.
    std::pmr::vector<std::uint32_t> of_point(tree.size(), &context.memory),
        of_node(tree.node_count(), &context.memory);
    for (std::size_t q = 0; q < tree.size(); ++q) of_point[q] = tree.rows()[q] >= first_;
    NeighbourSearch::Parts::find_nodes(tree, of_point, of_node);
    const NeighbourSearch::Parts parts{of_point, of_node};
    for_each_piece(stage, tree.first_leaf(), 16, context, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbour> found(KdTree::kLeafSize * count);
      NeighbourSearch::Query query{.k = count, .parts = &parts};
      for (std::size_t i = begin; i < end; ++i) {
        query.leaf = tree.first_leaf() + static_cast<KdTree::Node>(i);
        const KdTree::Position first = tree.begin(query.leaf), last = tree.end(query.leaf);
        for (KdTree::Position q = first; q < last; ++q)
          query.limits[q - first] = of_point[q] == 0 ? -1 : kInfinity;
        search->nearest(query, found);
        for (KdTree::Position q = first; q < last; ++q) {
          if (of_point[q] == 0) continue;
          const std::span<Neighbour> of_q = std::span(found).subspan((q - first) * count, count);
          for (Neighbour& n : of_q)
            if (n.position != NeighbourSearch::kNone) n.position = tree.rows()[n.position];
          use(Index{tree.rows()[q]} - first_, of_q);
        }
      }
    });
  }
  void compare_all(std::size_t count, std::span<const double> births, std::string_view stage,
                   const std::function<void(Index, std::span<const Neighbour>)>& use,
                   const RunContext& context) const {
    const auto work = [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbour> all(static_cast<std::size_t>(first_));
      std::vector<Neighbour> found(count);
      const std::size_t kept = std::min(count, all.size());
      for (std::size_t i = begin; i < end; ++i) {
        const Index row = first_ + static_cast<Index>(i);
        for (std::uint32_t j = 0; j < all.size(); ++j) {
          all[j] = {metric_(row, Index{j}), j};
          if (!births.empty())
            all[j].distance =
                std::max({all[j].distance, births[j], births[static_cast<std::size_t>(row)]});
        }
        const auto precedes = [](const Neighbour& a, const Neighbour& b) {
          return a.distance != b.distance ? a.distance < b.distance : a.position < b.position;
        };
        std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(),
                          precedes);
        std::fill(found.begin(), found.end(), Neighbour{});
        std::copy_n(all.begin(), kept, found.begin());
        use(static_cast<Index>(i), found);
      }
    };
    for_each_piece(stage, static_cast<std::size_t>(added()), 16, context, work);
  }

  const Index first_;
  const Points all_;
  PointMetric metric_;
  const PointDistance distance_;
  const double p_;
};

}  // namespace

std::vector<Attachment> attachments(PointsView points, std::span<const double> births,
                                    PointsView added, std::span<const double> added_births,
                                    PointDistance distance, double p, const RunContext& context) {
  const JointPoints joint(points, added, distance, p, context);
  if (static_cast<Index>(births.size()) != joint.first() ||
      static_cast<Index>(added_births.size()) != joint.added())
    throw Error(ErrorKind::usage,
                fmt::format("births: found {} and {}, expected one per point, {} and {}",
                            births.size(), added_births.size(), joint.first(), joint.added()));
  std::vector<double> all(births.begin(), births.end());
  all.insert(all.end(), added_births.begin(), added_births.end());
  std::vector<Attachment> result(added_births.size());
  joint.for_each_added(
      1, all, "attachments",
      [&](Index i, std::span<const Neighbour> found) {
        const Neighbour& first = found.front();
        if (first.position != NeighbourSearch::kNone && first.distance < kInfinity)
          result[static_cast<std::size_t>(i)] = {Index{first.position}, first.distance};
      },
      context);
  return result;
}

std::vector<double> core_distances_among(PointsView points, PointsView added, Index neighbours,
                                         PointDistance distance, double p,
                                         const RunContext& context) {
  if (neighbours < 0)
    throw Error(ErrorKind::usage,
                fmt::format("core neighbours: found {}, expected at least 0", neighbours));
  const JointPoints joint(points, added, distance, p, context);
  std::vector<double> result(static_cast<std::size_t>(joint.added()),
                             neighbours == 0 ? 0 : kInfinity);
  if (neighbours == 0 || neighbours >= joint.first()) return result;
  joint.for_each_added(
      static_cast<std::size_t>(neighbours) + 1, {}, "core distances",
      [&](Index i, std::span<const Neighbour> found) {
        result[static_cast<std::size_t>(i)] = found.back().distance;
      },
      context);
  return result;
}

}  // namespace ph
