// SPDX-License-Identifier: MIT
#include "libreport/report/arrays/voxel_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "ph/detail/image/voxel_runs.hpp"

namespace ph::report {

VoxelSets voxel_sets(const Barcode& barcode, const RunContext& context, VoxelBudget budget) {
  VoxelSets sets;
  if (barcode.representatives() != Representatives::voxels) return sets;
  const MemoryClaim claim(context.memory, barcode.size() * 2 * sizeof(std::uint32_t) +
                                              budget.runs * 4 * sizeof(std::uint32_t) +
                                              budget.voxels / 8);
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < barcode.size(); ++i)
    if (!barcode.voxels(i).empty()) order.push_back(static_cast<std::uint32_t>(i));
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::uint32_t i) { return barcode[i].persistence(); });
  for (const std::uint32_t i : order) {
    context.poll();
    const auto places = barcode.voxels(i);
    const std::size_t before = sets.runs.size();
    bool fits = places.size() <= budget.voxels;
    if (fits) {
      budget.voxels -= places.size();
      std::size_t count = 0;
      for_each_voxel_run(places, [&](std::uint64_t first, std::uint64_t length) {
        if (++count > budget.runs) return;
        sets.runs.push_back(static_cast<std::uint32_t>(first));
        sets.runs.push_back(static_cast<std::uint32_t>(length));
      });
      fits = count <= budget.runs;
      if (fits) budget.runs -= count;
    }
    if (!fits) {
      sets.runs.resize(before);
      ++sets.left_out;
      continue;
    }
    sets.bars.push_back(i);
    sets.start.push_back(static_cast<std::uint32_t>(sets.runs.size() / 2));
  }
  return sets;
}

std::string VoxelSets::note() const {
  if (left_out == 0) return "";
  return fmt::format(
      "sets of the {} most persistent of {} bars: the sets of all bars would be too large",
      bars.size(), bars.size() + left_out);
}

void add_voxel_sets(ReportFile& report, const VoxelSets& sets) {
  if (sets.bars.empty()) return;
  report.add("voxels/bar", sets.bars);
  report.add("voxels/start", sets.start, {.delta = true});
  report.add("voxels/runs", sets.runs, {.shape = {sets.runs.size() / 2, 2}, .delta = true});
}

}  // namespace ph::report
