// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "metric/blocks/cell_boxes.hpp"
#include "metric/blocks/near_points.hpp"
#include "metric/blocks/numbered_forest.hpp"
#include "metric/blocks/sample_tree.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Some of the blocks of a cloud: the edges of the cloud's minimum spanning forest that have an end
/// in them, block by block. Reads the cloud from its begin to its end, once as it is made and once
/// for each block; holds a block and what is near it.
class CloudBlocks {
 public:
  /// @param points at least one coordinate each, or all are equal.
  /// @param sample, blocks as for SampleTree. @param mine which of the blocks.
  /// @throws Error (bad_data) on a coordinate that is not finite; as SampleTree.
  CloudBlocks(PointsView points, std::size_t sample, std::uint32_t blocks, SampleTree::Range mine,
              const RunContext& context);

  /// Of all coordinates of the cloud.
  std::uint64_t fingerprint() const { return fingerprint_; }
  /// The same without blocks. O(coordinates).
  static std::uint64_t fingerprint_of(PointsView points);
  /// How many points the blocks have.
  Index size() const { return size_; }
  /// All edges of the minimum spanning forest of the cloud that have an end in the block, and that
  /// it has to look for, and perhaps others. Claims: see docs/explanation/engines/cloud-parts.md.
  NumberedForest forest(std::uint32_t block, double limit, const RunContext& context) const;

 private:
  /// The points of a block, and those near it.
  struct Members;
  void scan(SampleTree::Range mine, const RunContext& context);
  SampleTree::Range cells_of(std::uint32_t block) const {
    return tree_.cells(tree_.node_of_block(block));
  }
  NumberedForest sample_claims(std::uint32_t block, double limit, const RunContext& context) const;

  PointsView points_;
  SampleTree tree_;
  SampleTree::Cell first_cell_;
  CellBoxes boxes_;  // two by cell, from first_cell_ on, as NearPoints takes them
  std::vector<Index> sizes_;
  std::uint32_t first_block_;
  double largest_ = 0;
  std::vector<double> box_;
  std::uint64_t fingerprint_ = 0;
  Index size_ = 0;
  std::optional<Bottlenecks> bottlenecks_;
  std::optional<CellRegions> regions_;
};

}  // namespace ph
