// SPDX-License-Identifier: MIT
#include "libph/src/cubical/layers/top_star.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace ph::cubical {

TopStar::TopStar(const LayerGrid& grid, const Nodes& nodes, std::pmr::memory_resource* memory)
    : grid_(grid),
      nodes_(nodes),
      axes_(grid.axis_count()),
      shapes_(axes_, memory),
      codes_(memory),
      cells_(memory),
      is_in_(shapes_.shapes.size(), 0, memory),
      facets_(memory),
      tops_(memory),
      same_(std::size_t{1} << axes_, 0, memory),
      age_(same_.size(), 0, memory),
      is_new_(same_.size(), 0, memory) {
  for (std::uint32_t sides = 0; sides < same_.size(); ++sides) {
    std::uint32_t code = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(axes_); ++a)
      code += ((sides >> a & 1U) + 1) * shapes_.digit[a];
    codes_.push_back(static_cast<std::uint16_t>(code));
  }
}

void TopStar::look_at(std::uint32_t v, FoundLinks& found) {
  const LayerGrid::Steps steps(grid_, v);
  find_cells(v, steps);
  if (!facets_.empty()) {
    for (const auto& [at, sides] : tops_) {
      is_new_[sides] = 1;
      age_[sides] = at;
    }
    std::iota(same_.begin(), same_.end(), 0U);
    join_by_younger_facets();
    std::ranges::sort(facets_, std::greater<>());
    const auto first = static_cast<std::ptrdiff_t>(found.bridges.size());
    for (const auto& [at, code] : facets_) join_by_facet(v, code, found);
    std::reverse(found.bridges.begin() + first, found.bridges.end());
    std::ranges::sort(tops_);
    for (const auto& [at, sides] : tops_) {
      if (same_[sides] != sides) continue;
      const std::uint32_t own = node(v, sides);
      found.arrows[own] = own;
      found.roots.push_back({v, own, code_of(sides)});
    }
    for (const auto& [at, sides] : tops_) is_new_[sides] = 0;
  }
  for (const Cell& cell : cells_) is_in_[cell.code] = 0;
}

std::uint32_t TopStar::place(std::uint32_t code, const LayerGrid::Steps& steps) const {
  std::uint32_t place = 0;
  for (int a = 0; a < axes_; ++a, code /= 3) place = place << 2U | steps.order(a, code % 3);
  return place;
}

std::uint32_t TopStar::node(std::uint32_t v, std::uint32_t sides) const {
  return nodes_.node(v, direction_of_code(code_of(sides), axes_));
}

void TopStar::find_cells(std::uint32_t v, const LayerGrid::Steps& steps) {
  cells_.assign(1, {0, v});
  is_in_[0] = 1;
  facets_.clear();
  tops_.clear();
  for (int a = 0; a < axes_; ++a) {
    const std::size_t before = cells_.size();
    for (const bool up : {false, true})
      for (std::size_t i = 0; i < before; ++i) {
        const auto code = static_cast<std::uint16_t>(
            cells_[i].code + (up ? 2 : 1) * shapes_.digit[static_cast<std::size_t>(a)]);
        const StarShapes::Shape& shape = shapes_.shapes[code];
        bool is_in = true;
        for (std::size_t j = 0; j < shape.steps; ++j)
          is_in = is_in && is_in_[shape.without[j]] != 0;
        if (!is_in) continue;  // mutant: many-axes-faces
        const std::uint32_t far = steps.from(cells_[i].far, a, up);
        if (!grid_.is_older(far, v)) continue;
        is_in_[code] = 1;
        cells_.push_back({code, far});
        if (shape.steps + 1 == axes_) facets_.push_back({place(code, steps), code});
        if (shape.steps == axes_) {
          const std::uint32_t sides = ~unsigned{shape.down} & ((1U << axes_) - 1);
          tops_.push_back({place(code, steps), sides});
        }
      }
  }
}

void TopStar::join_by_younger_facets() {
  for (int a = 0; a < axes_; ++a)
    for (std::uint32_t low = 0; low < same_.size(); ++low) {
      const std::uint32_t high = low | 1U << a;
      // Beyond the end of an axis, this facet does not exist, because both sides are outside.
      if (low != high && is_in_[code_of_facet(low, a)] == 0) same_[find(low)] = find(high);
    }
}

void TopStar::join_by_facet(std::uint32_t v, std::uint32_t code, FoundLinks& found) {
  std::uint32_t low = 0, normal = 0, rest = code;
  for (std::uint32_t a = 0; a < static_cast<std::uint32_t>(axes_); ++a, rest /= 3) {
    if (rest % 3 == 0) normal = a;
    if (rest % 3 == 2) low |= 1U << a;
  }
  std::uint32_t side = low, other = low | 1U << normal;
  std::uint32_t dies = find(side), stays = find(other);
  if (dies == stays) return;
  // mutant: many-axes-stays
  if (is_new_[dies] == 0 || (is_new_[stays] != 0 && age_[dies] > age_[stays])) {
    std::swap(dies, stays);
    std::swap(side, other);
  }
  same_[dies] = stays;
  if (is_new_[dies] == 0)
    found.bridges.push_back({v, code});
  else
    found.arrows[node(v, dies)] = node(v, other);
}

}  // namespace ph::cubical
