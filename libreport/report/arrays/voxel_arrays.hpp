// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ph/barcode.hpp"
#include "report/report_file.hpp"

namespace ph::report {

/// Sets lie in each other, and together they may be far larger than the image.
struct VoxelBudget {
  std::size_t runs = 400'000;                 ///< in a page
  std::size_t voxels = std::size_t{1} << 25;  ///< of all sets that are looked at
};

/// The sets of voxels of bars, as runs of places in the image.
struct VoxelSets {
  std::vector<std::uint32_t> bars;
  std::vector<std::uint32_t> start{0};  ///< of set i: runs start[i] ... start[i + 1] - 1
  std::vector<std::uint32_t> runs;      ///< first place and length of each
  std::size_t left_out = 0;             ///< bars whose sets exceed what is left of the budget

  /// What a reader should know of sets that are not there; empty if all are.
  std::string note() const;
};

/// Of a barcode with Representatives::voxels: the sets of the most persistent bars that fit.
/// @throws Error (resource, cancelled).
VoxelSets voxel_sets(const Barcode& barcode, const RunContext& context, VoxelBudget budget = {});

/// Writes them as voxels/….
void add_voxel_sets(ReportFile& report, const VoxelSets& sets);

}  // namespace ph::report
