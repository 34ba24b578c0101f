// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "libph/src/metric/blocks/numbered_forest.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph {

/// Data that all parts of a cloud share.
struct WholeCloud {
  Index points, axes, sample;
  int parts, blocks;  // the number of parts, and the number of blocks in each part
  double limit;       // the threshold; infinite if there is none
  std::uint64_t fingerprint;

  friend bool operator==(const WholeCloud&, const WholeCloud&) = default;
};

struct CloudPart::State {
  State(const WholeCloud& whole_cloud, const RunContext& run_context)
      : whole(whole_cloud), context(run_context), forest(run_context) {}
  /// @throws Error (bad_data) unless this is the forest of the entire cloud.
  void check_joined() const;

  WholeCloud whole;
  const RunContext& context;
  std::vector<int> present;  // the numbers of the parts, ascending
  Index size = 0;            // the number of points of the parts that are present
  NumberedForest forest;
};

}  // namespace ph
