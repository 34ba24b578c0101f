// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/report/report_file.hpp"

namespace ph::report {

/// Limits for the sets of voxels in a page. The sets are nested, and together they may be far
/// larger than the image.
struct VoxelBudget {
  std::size_t runs = 400'000;  ///< the most runs in a page
  /// The most voxels of all sets that are considered.
  std::size_t voxels = std::size_t{1} << 25;
};

/// The sets of voxels of bars, as runs of voxel indices in the image.
struct VoxelSets {
  std::vector<std::uint32_t> bars;
  std::vector<std::uint32_t> start{0};  ///< set i has the runs start[i] ... start[i + 1] - 1
  std::vector<std::uint32_t> runs;      ///< the first voxel and the length of each run
  /// The number of bars whose sets do not fit the budget.
  std::size_t left_out = 0;

  /// A note for the reader about missing sets. Empty if no set is missing.
  std::string note() const;
};

/// The sets of the bars of a barcode with Representatives::voxels, most persistent first, as far as
/// the budget allows. If a set does not fit, smaller sets of less persistent bars may still follow.
/// Empty for any other barcode.
/// @throws Error (resource, cancelled).
VoxelSets voxel_sets(const Barcode& barcode, const RunContext& context, VoxelBudget budget = {});

/// Writes these sets as voxels/….
void add_voxel_sets(ReportFile& report, const VoxelSets& sets);

}  // namespace ph::report
