// SPDX-License-Identifier: MIT
#include "libph/src/cubical/layers/layer_grid.hpp"

#include <atomic>

#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {

LayerGrid::LayerGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab)
    : SlabFrame(grid, slab), values_(size(), &context.memory) {
  constexpr std::size_t piece = 1 << 16;
  std::atomic<bool> all_enter = true;
  for_each_piece("voxels", values_.size(), piece, context, [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      values_[v] = GridFrame::value(v);
      all = all && enters(v);
    }
    if (!all) all_enter = false;
  });
  all_enter_ = all_enter;
}

LayerGrid::Steps::Steps(const LayerGrid& grid, std::uint32_t v) {
  for (int a = 0; a < grid.axis_count(); ++a) {
    const std::uint32_t x = grid.coordinate(v, a), n = grid.extent(a), stride = grid.stride(a);
    const std::uint32_t around = (n - 1) * stride;
    const auto down = static_cast<std::size_t>(2 * a), up = down + 1;
    by_[down] = x > 0 ? 0 - stride : around;
    by_[up] = x + 1 < n ? stride : 0 - around;
    if (!grid.is_periodic(a)) leaves_ |= (x == 0 ? 1U : 0U) << down | (x + 1 == n ? 1U : 0U) << up;
    if (grid.is_wrapped(a, x)) wrapped_ |= 1U << a;
  }
}

}  // namespace ph::cubical
