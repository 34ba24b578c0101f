// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/report/report_file.hpp"

namespace ph::report {

/// Limits for the sets of voxels in a page: the sets are nested, and together they may be far
/// larger than the image.
struct VoxelBudget {
  std::size_t runs = 400'000;                 ///< most runs in a page
  std::size_t voxels = std::size_t{1} << 25;  ///< most voxels of all sets that are considered
};

/// The sets of voxels of bars, as runs of voxel indices in the image.
struct VoxelSets {
  std::vector<std::uint32_t> bars;
  std::vector<std::uint32_t> start{0};  ///< set i has the runs start[i] ... start[i + 1] - 1
  std::vector<std::uint32_t> runs;      ///< first voxel and length of each run
  std::size_t left_out = 0;             ///< number of bars whose sets do not fit the budget

  /// A note for the reader about missing sets; empty if none is missing.
  std::string note() const;
};

/// For a barcode with Representatives::voxels: the sets of the most persistent bars, as far as the
/// budget allows. Empty for any other barcode.
/// @throws Error (resource, cancelled).
VoxelSets voxel_sets(const Barcode& barcode, const RunContext& context, VoxelBudget budget = {});

/// Writes these sets as voxels/….
void add_voxel_sets(ReportFile& report, const VoxelSets& sets);

}  // namespace ph::report
