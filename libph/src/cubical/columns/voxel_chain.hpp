// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <tuple>
#include <vector>

#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// A chain of cells under construction. A cell may occur several times until `combine` is called.
template <Field K>
using VoxelChain = std::vector<Entry<StarCell, K>>;

template <Field K>
typename K::Element signed_one(const K& field, bool is_positive) {
  return field.from_int(is_positive ? 1 : -1);
}

/// Keeps each cell once, with the sum of its coefficients, and drops cells whose sum is zero.
/// Precondition: equal cells are given by the same voxel and direction.
template <Field K>
void combine(VoxelChain<K>& chain, const K& field) {
  const auto name = [](const auto& term) { return std::tie(term.cell.voxel, term.cell.direction); };
  std::ranges::sort(chain, {}, name);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chain.size();) {
    const StarCell cell = chain[i].cell;
    auto sum = chain[i].coefficient();
    for (++i; i < chain.size() && name(chain[i]) == std::tie(cell.voxel, cell.direction); ++i)
      sum = field.add(sum, chain[i].coefficient());
    if (!field.is_zero(sum)) chain[kept++] = {cell, sum};
  }
  chain.resize(kept);
}

}  // namespace ph::cubical
