// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include "ph/filtration.hpp"

namespace ph {

/// Capability: the filtration lists the cofacets in a range of keys faster than all cofacets. A
/// column under reduction can then hold only a few cofacets that are younger than its pivot; see
/// CoboundaryColumn.
template <class F>
concept RangeFiltration = CofacetFiltration<F> &&
    requires(const F& f, int dim, const typename F::Cell& cell) {
  /// `for_each_cofacet`, but only for cofacets with keys first … last, in the same order.
  f.for_each_cofacet_within(dim, cell, f.key(cell), f.key(cell),
                            [](const typename F::Cell&, int) { return true; });
  /// A key >= `key`: the end of the first range to list when cofacets from `key` on are wanted. The
  /// largest number of the type, if all should be listed at once.
  { f.horizon(f.key(cell)) } -> std::same_as<decltype(f.key(cell))>;
};

}  // namespace ph
