// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/detail/core/field.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// Apparent pairs (Bauer, Ripser, section 3.5): a cell and a cofacet of equal key, where the
/// cofacet is the oldest cofacet of the cell and the cell is the youngest facet of the cofacet.
/// Each apparent pair is a persistence pair, found by looking at neighbours alone: nothing is
/// reduced and nothing is stored. If a filtration cannot list cofacets, no pairs are found.
template <Filtration F, Field K>
class ApparentPairs {
 public:
  using Cell = typename F::Cell;

  ApparentPairs(const F& filtration, const K& field) : filtration_(filtration), field_(field) {}

  /// The cofacet that forms an apparent pair with `cell` (of dimension `dim`): the class of `cell`
  /// dies there.
  std::optional<Cell> death_cell_of(int dim, const Cell& cell) const {
    if constexpr (ApparentFiltration<F>) {
      return filtration_.apparent_cofacet(dim, cell);
    } else if constexpr (CofacetFiltration<F>) {
      const auto cofacet = oldest_equal_cofacet(dim, cell);
      if (!cofacet) return std::nullopt;
      const auto facet = youngest_equal_facet(dim + 1, *cofacet);
      if (facet && *facet == cell) return cofacet;  // mutant: apparent-both
    }
    return std::nullopt;
  }

  /// The facet that forms an apparent pair with `cell` (of dimension `dim`): the class that `cell`
  /// kills is born there.
  std::optional<Cell> birth_cell_of(int dim, const Cell& cell) const {
    if constexpr (ApparentFiltration<F>) {
      return filtration_.apparent_facet(dim, cell);
    } else if constexpr (CofacetFiltration<F>) {
      const auto facet = youngest_equal_facet(dim, cell);
      if (!facet) return std::nullopt;
      const auto cofacet = oldest_equal_cofacet(dim - 1, *facet);
      if (cofacet && *cofacet == cell) return facet;
    }
    return std::nullopt;
  }

 private:
  std::optional<Cell> oldest_equal_cofacet(int dim, const Cell& cell) const {
    std::optional<Cell> oldest;
    filtration_.for_each_cofacet(dim, cell, [&](const Cell& cofacet, int incidence) {
      if (filtration_.key(cofacet) != filtration_.key(cell)) return true;
      if (field_.is_zero(field_.from_int(incidence))) return true;
      if (!oldest || filtration_.precedes(cofacet, *oldest)) oldest = cofacet;
      return !F::first_equal_cofacet_is_oldest;
    });
    return oldest;
  }
  std::optional<Cell> youngest_equal_facet(int dim, const Cell& cell) const {
    std::optional<Cell> youngest;
    filtration_.for_each_facet(dim, cell, [&](const Cell& facet, int incidence) {
      if (filtration_.key(facet) != filtration_.key(cell)) return;
      if (field_.is_zero(field_.from_int(incidence))) return;
      if (!youngest || filtration_.precedes(*youngest, facet)) youngest = facet;
    });
    return youngest;
  }

  const F& filtration_;
  const K& field_;
};

}  // namespace ph
