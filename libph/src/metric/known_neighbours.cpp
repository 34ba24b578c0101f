// SPDX-License-Identifier: MIT
#include "libph/src/metric/known_neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

using Neighbour = NeighbourSearch::Neighbour;
using Query = NeighbourSearch::Query;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kLeaves = 16;  // of a piece of work, after which a stop is noticed

}  // namespace

KnownNeighbours known_neighbours(const KdTree& tree, const NeighbourSearch& search, double limit,
                                 const RunContext& context) {
  constexpr std::size_t count = KnownNeighbours::kCount;
  KnownNeighbours known{std::pmr::vector<KdTree::Position>(tree.size() * count, &context.memory),
                        std::pmr::vector<double>(&context.memory)};
  const KdTree::Node first = tree.first_leaf();
  const auto find = [&](std::size_t begin, std::size_t end) {
    std::array<Neighbour, KdTree::kLeafSize * count> found;
    for (auto leaf = static_cast<KdTree::Node>(first + begin); leaf < first + end; ++leaf) {
      Query query{.leaf = leaf, .k = count};
      query.limits.fill(limit);
      search.nearest(query, found);
      KdTree::Position* const out = &known.positions[tree.begin(leaf) * count];
      for (std::size_t i = 0; i < count * (tree.end(leaf) - tree.begin(leaf)); ++i)
        out[i] = found[i].position;
    }
  };
  for_each_piece("neighbours", first, kLeaves, context, find);
  return known;
}

NearestLists::NearestLists(const KdTree& tree, const NeighbourSearch& search, std::size_t k,
                           std::span<double> core, const RunContext& context)
    : tree_(tree),
      length_(k + KnownNeighbours::kCount),
      points_(tree.size() * length_, &context.memory),
      last_(tree.size(), &context.memory) {
  const KdTree::Node first = tree.first_leaf();
  const auto find = [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> found(KdTree::kLeafSize * length_);
    for (auto leaf = static_cast<KdTree::Node>(first + begin); leaf < first + end; ++leaf) {
      Query query{.leaf = leaf, .k = length_, .ties = NeighbourSearch::Ties::any};
      query.limits.fill(kNever);
      search.nearest(query, found);
      const Neighbour* list = found.data();
      for (KdTree::Position p = tree.begin(leaf); p < tree.end(leaf); ++p, list += length_) {
        for (std::size_t i = 0; i < length_; ++i) points_[p * length_ + i] = list[i].position;
        last_[p] = list[length_ - 1].distance;
        core[tree.rows()[p]] = list[k - 1].distance;
      }
    }
  };
  for_each_piece("core distances", first, kLeaves, context, find);
}

KnownNeighbours NearestLists::by_value(const NeighbourSearch& search, double limit,
                                       const RunContext& context) const {
  constexpr std::size_t count = KnownNeighbours::kCount;
  KnownNeighbours known{std::pmr::vector<KdTree::Position>(tree_.size() * count,
                                                           NeighbourSearch::kNone, &context.memory),
                        std::pmr::vector<double>(tree_.size(), &context.memory)};
  const auto comes_first = [&](const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance
                                    : tree_.rows()[a.position] < tree_.rows()[b.position];
  };
  const auto sort = [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> list;
    for (auto p = static_cast<KdTree::Position>(begin); p < end; ++p) {
      list.clear();
      for (const KdTree::Position q : std::span(points_).subspan(p * length_, length_)) {
        if (q == NeighbourSearch::kNone) break;
        const double value = search.distance(p, q);
        if (value < last_[p] && value <= limit) list.push_back({value, q});  // mutant: forest-lists
      }
      std::ranges::sort(list, comes_first);
      for (std::size_t i = 0; i < std::min(list.size(), count); ++i)
        known.positions[p * count + i] = list[i].position;
      // The points at the distance of the last point of a list need not be in the list.
      known.others_after[p] =
          last_[p] < kNever ? std::min(limit, std::nextafter(last_[p], 0.0)) : limit;
    }
  };
  for_each_piece("neighbours", tree_.size(), kLeaves * KdTree::kLeafSize, context, sort);
  return known;
}

}  // namespace ph
