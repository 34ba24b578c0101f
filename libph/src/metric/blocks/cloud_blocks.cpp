// SPDX-License-Identifier: MIT
#include "libph/src/metric/blocks/cloud_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// Gives access to the points one by one. The coordinates of each point are contiguous in memory.
class Rows {
 public:
  explicit Rows(PointsView points)
      : points_(points), row_(static_cast<std::size_t>(std::max<Index>(points.cols(), 1))) {}
  const double* operator()(Index i) {
    if (points_.has_whole_rows() && points_.cols() > 0) return points_.row(i);
    for (Index k = 0; k < points_.cols(); ++k) row_[static_cast<std::size_t>(k)] = points_(i, k);
    return row_.data();
  }

 private:
  PointsView points_;
  std::vector<double> row_;
};

/// Adds a coordinate. The two zeros count as equal, because all distances from them are.
void add(Fingerprint& fingerprint, double x) {
  fingerprint.add(std::bit_cast<std::uint64_t>(x + 0.0));
}

std::uint32_t cell_count(const SampleTree& tree, SampleTree::Range blocks) {
  std::uint32_t count = 0;
  for (std::uint32_t b = blocks.begin; b < blocks.end; ++b)
    count += tree.cells(tree.node_of_block(b)).size();
  return count;
}

}  // namespace

CloudBlocks::CloudBlocks(PointsView points, std::size_t sample, std::uint32_t blocks,
                         SampleTree::Range mine, const RunContext& context)
    : points_(points),
      tree_(points, sample, blocks, context),
      first_cell_(cells_of(mine.begin).begin),
      boxes_(2 * std::size_t{cell_count(tree_, mine)}, points.cols(), context),
      sizes_(mine.size()),
      first_block_(mine.begin) {
  if (tree_.cell_count() == 0) return;
  // The last bit of a distance depends on the entire cloud, because it depends on whether the
  // squares of the cloud's coordinate differences stay in range.
  bottlenecks_.emplace(tree_, 0, context);
  scan(mine, context);
  const auto is_plain = [&](double largest) {
    return PointMetric(tree_.points(), PointDistance::euclidean, 2, largest).is_plain_euclidean();
  };
  if (is_plain(0) != is_plain(largest_)) bottlenecks_.emplace(tree_, largest_, context);
  regions_.emplace(tree_, box_, context);
}

std::uint64_t CloudBlocks::fingerprint_of(PointsView points) {
  Fingerprint fingerprint;
  Rows rows(points);
  for (Index i = 0; i < points.rows(); ++i) {
    const double* const x = rows(i);
    for (Index k = 0; k < points.cols(); ++k) add(fingerprint, x[k]);
  }
  return fingerprint.value();
}

// Collects the properties of the entire cloud that affect distances, and data about the points in
// the blocks of this object.
void CloudBlocks::scan(SampleTree::Range mine, const RunContext& context) {
  const Index axes = points_.cols();
  const auto d = static_cast<std::size_t>(axes);
  for (std::size_t k = 0; k < d; ++k) {
    box_.push_back(std::numeric_limits<double>::infinity());
    box_.push_back(-std::numeric_limits<double>::infinity());
  }
  Rows rows(points_);
  Ticker ticker(context, "cloud", static_cast<std::uint64_t>(points_.rows()));
  for (Index i = 0; i < points_.rows(); ++i) {
    ticker.tick();
    const double* const x = rows(i);
    for (std::size_t k = 0; k < d; ++k) {
      if (!std::isfinite(x[k])) throw not_finite(i, static_cast<Index>(k), x[k]);
      box_[2 * k] = std::min(box_[2 * k], x[k]);
      box_[2 * k + 1] = std::max(box_[2 * k + 1], x[k]);
      add(fingerprint_, x[k]);
    }
    SampleTree::Node node = SampleTree::kRoot;
    const auto is_mine = [&] {
      const SampleTree::Range blocks = tree_.blocks(node);
      return blocks.begin < mine.end && mine.begin < blocks.end;
    };
    while (!tree_.is_leaf(node) && is_mine()) node = tree_.child(node, x);
    if (!is_mine()) continue;
    const SampleTree::Cell cell = tree_.cells(node).begin;
    const std::uint32_t block = tree_.blocks(node).begin;
    NearSample sample{cell, squared_distance(x, tree_.points().row(Index{cell}), axes)};
    const auto is_far = [&] { return sample.square > bottlenecks_->square_around(sample.cell); };
    if (is_far()) sample = nearest_sample(tree_, block, x, sample);
    boxes_.add_point(2 * std::size_t{sample.cell - first_cell_} + (is_far() ? 1 : 0), x,
                     sample.square);
    ++sizes_[block - first_block_];
    ++size_;
  }
  for (const double x : box_) largest_ = std::max(largest_, std::abs(x));
}

struct CloudBlocks::Members {
  explicit Members(const RunContext& context)
      : numbers(&context.memory), coordinates(&context.memory), is_inside(&context.memory) {}
  std::pmr::vector<Index> numbers;
  std::pmr::vector<double> coordinates;
  std::pmr::vector<bool> is_inside;
};

NumberedForest CloudBlocks::forest(std::uint32_t block, double limit,
                                   const RunContext& context) const {
  NumberedForest result(context);
  const SampleTree::Range cells = cells_of(block);
  if (cells.size() == 0) return result;
  const auto axes = static_cast<std::size_t>(points_.cols());

  Members members(context);
  {
    const NearPoints near(tree_, *bottlenecks_, *regions_, boxes_, cells.begin - first_cell_, block,
                          limit, context);
    const auto room = static_cast<std::size_t>(sizes_[block - first_block_]) / 4 * 5;
    members.numbers.reserve(room);
    members.coordinates.reserve(room * axes);
    Rows rows(points_);
    Ticker ticker(context, "points of a block", static_cast<std::uint64_t>(points_.rows()));
    for (Index i = 0; i < points_.rows(); ++i) {
      ticker.tick();
      const double* const x = rows(i);
      const NearPoints::Place place = near.place(x);
      if (place == NearPoints::Place::elsewhere) continue;
      members.numbers.push_back(i);
      members.coordinates.insert(members.coordinates.end(), x, x + axes);
      members.is_inside.push_back(place == NearPoints::Place::inside);
    }
  }
  const std::size_t size = members.numbers.size();
  if (size >= UINT32_MAX)
    throw Error(ErrorKind::resource,
                fmt::format("block of a cloud: found {} points in it and near it, expected fewer "
                            "than 2^32 - 1; use more blocks, which are smaller",
                            size));
  // mutant: cloud-largest
  result.edges = spanning_forest(
      PointsView(members.coordinates.data(), static_cast<Index>(size), points_.cols()),
      PointDistance::euclidean, 2, {}, limit, context, largest_);
  members.coordinates = std::pmr::vector<double>(&context.memory);

  // Only points that have an edge are listed in the forest.
  std::pmr::vector<bool> occurs(size, false, &context.memory);
  for (const FlagEdge& e : result.edges) occurs[e.u] = occurs[e.v] = true;
  std::pmr::vector<std::uint32_t> place(size, &context.memory);
  for (std::size_t i = 0; i < size; ++i) {
    place[i] = static_cast<std::uint32_t>(result.numbers.size());
    if (occurs[i]) result.numbers.push_back(members.numbers[i]);
  }
  // An edge between two points outside the block is left to another part. The search assumed that
  // its ends are joined, so the edge becomes a claim.
  std::size_t kept = 0;
  for (const FlagEdge& e : result.edges) {
    const FlagEdge renumbered{e.value, place[e.u], place[e.v]};
    if (members.is_inside[e.u] || members.is_inside[e.v])
      result.edges[kept++] = renumbered;
    else
      result.claims.push_back(renumbered);
  }
  result.edges.resize(kept);
  sort_edges(result.edges, context);
  sort_edges(result.claims, context);
  result.join(sample_claims(block, limit, context), context);
  return result;
}

/// Returns claims for the edges of the sample's spanning tree that begin in the block.
NumberedForest CloudBlocks::sample_claims(std::uint32_t block, double limit,
                                          const RunContext& context) const {
  NumberedForest claims(context);
  const SampleTree::Range cells = cells_of(block);
  std::vector<Bottlenecks::Edge> edges;
  for (const Bottlenecks::Edge& e : bottlenecks_->edges())
    if (cells.begin <= e.a && e.a < cells.end && e.length <= limit) edges.push_back(e);
  for (const Bottlenecks::Edge& e : edges)
    for (const SampleTree::Cell c : {e.a, e.b}) claims.numbers.push_back(tree_.number(c));
  std::ranges::sort(claims.numbers);
  claims.numbers.erase(std::ranges::unique(claims.numbers).begin(), claims.numbers.end());
  const auto place = [&](SampleTree::Cell c) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(claims.numbers, tree_.number(c)) -
                                      claims.numbers.begin());
  };
  for (const Bottlenecks::Edge& e : edges) {
    const auto [v, u] = std::minmax({place(e.a), place(e.b)});
    claims.claims.push_back({e.length, u, v});
  }
  sort_edges(claims.claims, context);
  return claims;
}

}  // namespace ph
