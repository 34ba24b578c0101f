// SPDX-License-Identifier: MIT
#include "cubical/graphs/top_graph.hpp"

namespace ph::cubical {

TopGraph::TopGraph(const StarGrid& grid) : grid_(grid) {
  for (int a = 2; a >= 0; --a) {
    // With a border around the voxels there is one more cell than voxels along an axis.
    border_[a] = grid.is_t_construction() && grid.has_axis(a) && !grid.is_periodic(a) ? 1 : 0;
    extent_[a] = grid.extent(a) + border_[a];
    stride_[a] = count_;
    by_extent_[a] = Divisor(extent_[a]);
    count_ *= extent_[a];
  }
}

std::uint32_t TopGraph::node(std::uint32_t v, const Direction& d) const {
  std::uint32_t result = 0;
  for (int a = 0; a < 3; ++a) {
    if (!grid_.has_axis(a)) continue;
    const std::uint32_t x = grid_.coordinate(v, a), last = grid_.extent(a) - 1;
    std::uint32_t low = x + border_[a];
    if (d[a] < 0) {
      if (low > 0)
        --low;
      else if (grid_.is_periodic(a))
        low = last;
      else
        return outside_beyond(d);
    } else if (x == last && border_[a] == 0 && !grid_.is_periodic(a)) {
      return outside_beyond(d);
    }
    result += low * stride_[a];
  }
  return result;
}

std::array<std::uint32_t, 2> TopGraph::ends(std::uint32_t v, std::uint32_t number) const {
  const Direction d = bridge_direction(number);
  const int n = static_cast<int>(number);
  const int normal = has_cubes() ? normal_of_square(n) : 3 - axis_of_edge(n);
  return {node(v, turned(d, normal, -1)), node(v, turned(d, normal, 1))};
}

std::uint32_t TopGraph::arrow(std::uint32_t node) const {
  const StarCell top = cell(node);
  const int number = number_of(top.direction);
  const int axis = exit_axis(top.voxel, number);
  return this->node(top.voxel, turned(top.direction, axis, -top.direction[axis]));
}

template <class Use>
void TopGraph::for_each_corner(std::uint32_t node, Use&& use) const {
  std::array<std::uint32_t, 3> low{};
  for (int a = 2; a >= 0; --a) {
    const std::uint32_t rest = by_extent_[a].divide(node);
    low[a] = node - rest * extent_[a];
    node = rest;
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    Direction d{};
    std::uint32_t v = 0;
    bool is_there = true;
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t upper = corner >> a & 1U, n = grid_.extent(a);
      if (!grid_.has_axis(a)) {
        is_there = is_there && upper == 0;
        continue;
      }
      d[a] = upper != 0 ? -1 : 1;
      std::uint32_t x = low[a] + upper;
      if (border_[a] != 0) {
        is_there = is_there && x >= 1 && x <= n;
        --x;
      } else if (x == n) {
        x = 0;  // the axis is periodic
      }
      v = v * n + x;
    }
    if (is_there && use(v, d)) return;
  }
}

StarCell TopGraph::cell(std::uint32_t node) const {
  StarCell found;
  for_each_corner(node, [&](std::uint32_t v, const Direction& d) {
    const std::uint32_t star = grid_.star(v);
    if (star == kAbsent || (star & star_bit(d)) == 0) return false;
    found = {v, d};
    return true;
  });
  return found;
}

std::array<std::uint32_t, 2> TopGraph::seam(bool after) const {
  const int axis = grid_.layer_axis();
  const std::uint32_t layer = border_[axis] + (after ? grid_.extent(axis) - 2 : 0);
  return {layer * stride_[axis], stride_[axis]};
}

bool TopGraph::is_cell(std::uint32_t node) const {
  for (int a = 2; a >= 0; --a) {
    const std::uint32_t rest = by_extent_[a].divide(node), low = node - rest * extent_[a];
    if (grid_.has_axis(a) && border_[a] == 0 && !grid_.is_periodic(a) && low + 1 == extent_[a])
      return false;
    node = rest;
  }
  return true;
}

std::optional<double> TopGraph::seam_value(std::uint32_t node) const {
  std::optional<double> youngest;
  if (!is_cell(node)) return youngest;
  for_each_corner(node, [&](std::uint32_t v, const Direction&) {
    // In the T-construction what never enters has always been there.
    if (grid_.enters(v) || !grid_.is_t_construction())
      youngest = std::max(youngest.value_or(grid_.value(v)), grid_.value(v));
    return false;
  });
  return youngest;
}

std::uint32_t TopGraph::outside_beyond(const Direction& d) const {
  if (grid_.open_axes() == 1)
    for (int a = 0; a < 3; ++a)
      if (grid_.has_ends(a) && d[a] > 0) return outside(1);
  return outside(0);
}

}  // namespace ph::cubical
