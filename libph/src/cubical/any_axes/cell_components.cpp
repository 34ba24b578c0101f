// SPDX-License-Identifier: MIT
#include "libph/src/cubical/any_axes/cell_components.hpp"

#include <algorithm>
#include <utility>

namespace ph::cubical {
namespace {

std::uint32_t node_extent(const CellGrid::Axis& axis, bool backwards) {
  return (axis.length + (backwards ? 0 : 1)) / 2;
}

std::uint32_t node_count(const CellGrid& grid, bool backwards) {
  std::uint32_t count = 1;
  for (int k = 0; k < grid.dim(); ++k) count *= node_extent(grid.axis(k), backwards);
  return count;
}

}  // namespace

CellComponents::CellComponents(const CellGrid& grid, Graph graph, const RunContext& context)
    : grid_(grid),
      backwards_(graph == Graph::of_top_cells),
      context_(context),
      count_(node_count(grid, backwards_)),
      sets_(std::size_t{count_} + 2, &context.memory) {
  for (int k = 0; k < grid.dim(); ++k) open_axes_ += grid.axis(k).periodic ? 0 : 1;
  if (backwards_ && !grid.all_enter()) join_what_never_enters();
  follow_arrows();
}

std::uint32_t CellComponents::number(const CellGrid::Coordinates& x) const {
  std::uint32_t result = 0;
  for (int k = 0; k < grid_.dim(); ++k)
    result = result * node_extent(grid_.axis(k), backwards_) + x[static_cast<std::size_t>(k)] / 2;
  return result;
}

std::uint32_t CellComponents::cell_of(std::uint32_t number) const {
  std::uint32_t cell = 0;
  for (int k = grid_.dim() - 1; k >= 0; --k) {
    const std::uint32_t extent = node_extent(grid_.axis(k), backwards_);
    cell += (2 * (number % extent) + (backwards_ ? 1 : 0)) * grid_.axis(k).stride;
    number /= extent;
  }
  return cell;
}

std::uint32_t CellComponents::beyond(std::uint32_t cell, const CellGrid::Coordinates& x,
                                     int direction, int steps) const {
  CellGrid::Coordinates to = x;
  const auto k = static_cast<std::size_t>(direction / 2);
  for (int i = 0; i < steps; ++i) {
    cell = grid_.beside(cell, to[k], direction);
    if (cell == CellGrid::kNone)
      return count_ + static_cast<std::uint32_t>(open_axes_ == 1 ? direction % 2 : 0);
    to[k] = grid_.next(to[k], direction);
  }
  return number(to);
}

std::array<std::uint32_t, 2> CellComponents::ends(std::uint32_t bridge) const {
  const CellGrid::Coordinates x = grid_.coordinates(bridge);
  int axis = 0;
  while ((x[static_cast<std::size_t>(axis)] % 2 == 0) != backwards_) ++axis;
  return {beyond(bridge, x, 2 * axis, 1), beyond(bridge, x, 2 * axis + 1, 1)};
}

std::optional<CellGrid::Name> CellComponents::name_of(std::uint32_t node) const {
  if (node >= count_) return std::nullopt;
  const std::uint32_t cell = cell_of(node);
  if (!grid_.mark(cell).enters()) return std::nullopt;
  return grid_.name(cell);
}

void CellComponents::follow_arrows() {
  CellGrid::Coordinates parity{};
  if (backwards_) parity.fill(1);
  Ticker ticker(context_, "basins", count_);
  std::uint32_t node = 0;
  grid_.for_each_of_parity(parity, [&](std::uint32_t cell, const CellGrid::Coordinates& x) {
    ticker.tick();
    const CellMark mark = grid_.mark(cell);
    if (backwards_ ? mark.is_local_killer() : mark.is_killed())
      sets_.link(node, beyond(cell, x, mark.direction(), 2));
    ++node;
  });
}

void CellComponents::join_what_never_enters() {
  Ticker ticker(context_, "holes");
  for (int k = 0; k < grid_.dim(); ++k) {
    CellGrid::Coordinates parity{};
    parity.fill(1);
    parity[static_cast<std::size_t>(k)] = 0;
    grid_.for_each_of_parity(parity, [&](std::uint32_t cell, const CellGrid::Coordinates& x) {
      ticker.work();
      if (grid_.mark(cell).enters()) return;
      const std::uint32_t a = sets_.find(beyond(cell, x, 2 * k, 1)),
                          b = sets_.find(beyond(cell, x, 2 * k + 1, 1));
      if (a != b) sets_.link(a, b);
    });
  }
}

void CellComponents::join(std::pmr::vector<Name>& bridges,
                          const std::function<void(Name, std::optional<Name>)>& on_merge) {
  Ticker ticker(context_, "components", bridges.size());
  if (backwards_) std::ranges::reverse(bridges);
  std::size_t kept = 0;
  for (const Name bridge : bridges) {
    ticker.tick();
    const auto [u, v] = ends(CellGrid::cell(bridge));
    std::uint32_t dies = sets_.find(u), lives = sets_.find(v);
    if (dies == lives) {
      bridges[kept++] = bridge;
      continue;
    }
    std::optional<Name> younger = name_of(dies), elder = name_of(lives);
    // A node that was always there is older than all others. Top cells enter in reverse order, so
    // the later cell counts as older.
    if (!younger || (elder && (backwards_ ? *younger > *elder : *younger < *elder))) {
      std::swap(dies, lives);
      std::swap(younger, elder);
    }
    sets_.link(dies, lives);
    on_merge(bridge, younger);
  }
  bridges.resize(kept);
  if (backwards_) std::ranges::reverse(bridges);
}

bool CellComponents::survives(Name node) {
  const std::uint32_t own = number(grid_.coordinates(CellGrid::cell(node)));
  return sets_.find(own) == own;
}

}  // namespace ph::cubical
