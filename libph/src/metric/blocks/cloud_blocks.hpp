// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "libph/src/metric/blocks/cell_boxes.hpp"
#include "libph/src/metric/blocks/near_points.hpp"
#include "libph/src/metric/blocks/numbered_forest.hpp"
#include "libph/src/metric/blocks/sample_tree.hpp"
#include "ph/detail/core/fingerprint.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Some of the blocks of a cloud. The class computes, block by block, the edges of the cloud's
/// minimum spanning forest that each block must find (see `forest`). It reads the entire cloud once
/// when it is constructed and once more for each block. It keeps only one block and the points near
/// it in memory.
class CloudBlocks {
 public:
  /// @param points must have at least one coordinate.
  /// @param sample, blocks as for SampleTree. @param mine the blocks of this object.
  /// @throws Error as SampleTree; (bad_data) on a coordinate that is not finite.
  CloudBlocks(PointsView points, std::size_t sample, std::uint32_t blocks, SampleTree::Range mine,
              const RunContext& context);

  /// A fingerprint of all coordinates of the cloud.
  std::uint64_t fingerprint() const { return fingerprint_.value(); }
  /// The fingerprint of a cloud, computed without making blocks, in O(coordinates).
  static std::uint64_t fingerprint_of(PointsView points);
  /// The number of points in the blocks of this object.
  Index size() const { return size_; }
  /// The forest of one block. It contains the edges that this block must find. They are the edges
  /// of the cloud's minimum spanning forest that lie within the block, or between the block and one
  /// of the blocks to which it looks for edges (see NearPoints::looks_for). The forest may also
  /// contain other edges. docs/explanation/engines/cloud-parts.md explains its claims.
  NumberedForest forest(std::uint32_t block, double limit, const RunContext& context) const;

 private:
  /// The points of a block, and the points near it.
  struct Members;
  void scan(SampleTree::Range mine, const RunContext& context);
  SampleTree::Range cells_of(std::uint32_t block) const {
    return tree_.cells(tree_.node_of_block(block));
  }
  NumberedForest sample_claims(std::uint32_t block, double limit, const RunContext& context) const;

  PointsView points_;
  SampleTree tree_;
  SampleTree::Cell first_cell_;
  // Two boxes per cell, for the cells since first_cell_ (see NearPoints).
  CellBoxes boxes_;
  std::vector<Index> sizes_;
  std::uint32_t first_block_;
  double largest_ = 0;
  std::vector<double> box_;
  Fingerprint fingerprint_;
  Index size_ = 0;
  std::optional<Bottlenecks> bottlenecks_;
  std::optional<CellRegions> regions_;
};

}  // namespace ph
