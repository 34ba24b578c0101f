// SPDX-License-Identifier: MIT
#include "libph/src/cubical/layers/layer_graphs.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "libph/src/cubical/layers/top_star.hpp"
#include "libph/src/cubical/layers/voxel_star.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {
namespace {

/// @tparam Star VoxelStar or TopStar.
template <class Star>
StarLinks find_links(const LayerGrid& grid, const typename Star::Nodes& nodes,
                     const RunContext& context) {
  constexpr std::size_t piece = 1 << 12;
  StarLinks links(nodes.size(), &context.memory);
  std::mutex mutex;
  // The links found in each piece of the grid, indexed by the first voxel of the piece.
  std::map<std::size_t, FoundLinks> pieces;
  for_each_piece("stars", grid.size(), piece, context, [&](std::size_t begin, std::size_t end) {
    FoundLinks found(links.arrows, &context.memory);
    Star star(grid, nodes, &context.memory);
    Ticker ticker(context, {});
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      ticker.work();
      if (!grid.is_ghost(v) && grid.enters(v)) star.look_at(v, found);
    }
    const std::lock_guard lock(mutex);
    pieces.emplace(begin, std::move(found));
  });
  std::size_t roots = 0, bridges = 0;
  for (const auto& [begin, found] : pieces) {
    roots += found.roots.size();
    bridges += found.bridges.size();
  }
  links.roots.reserve(roots);
  links.bridges.cells.reserve(bridges);
  for (auto& [begin, found] : pieces) {
    links.roots.insert(links.roots.end(), found.roots.begin(), found.roots.end());
    links.bridges.cells.insert(links.bridges.cells.end(), found.bridges.begin(),
                               found.bridges.end());
    found.roots = decltype(found.roots)(&context.memory);
    found.bridges = decltype(found.bridges)(&context.memory);
  }
  put_in_order(links.bridges, grid, context);
  return links;
}

}  // namespace

LayerVoxelGraph::LayerVoxelGraph(const LayerGrid& grid, const RunContext& context)
    : LayerVoxels(grid), links_(find_links<VoxelStar>(grid, *this, context)) {}

std::array<std::uint32_t, 2> LayerVoxelGraph::ends(std::uint32_t v, std::uint32_t number) const {
  const WideDirection direction = direction_of_code(number, grid_.axis_count());
  const auto axis = std::ranges::find_if(direction, [](int step) { return step != 0; });
  return {v, or_outside(grid_.step(v, static_cast<int>(axis - direction.begin()), *axis), *axis)};
}

LayerTopGraph::LayerTopGraph(const LayerGrid& grid, const RunContext& context)
    : LayerTops(grid), links_(find_links<TopStar>(grid, *this, context)) {}

std::array<std::uint32_t, 2> LayerTopGraph::ends(std::uint32_t v, std::uint32_t number) const {
  WideDirection low = direction_of_code(number, grid_.axis_count());
  const auto normal = std::ranges::find(low, 0) - low.begin();
  WideDirection high = low;
  low[static_cast<std::size_t>(normal)] = -1;
  high[static_cast<std::size_t>(normal)] = 1;
  return {node(v, low), node(v, high)};
}

}  // namespace ph::cubical
