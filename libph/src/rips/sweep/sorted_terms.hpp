// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <vector>

#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// Computes list += scale * terms. The list and the terms are in ascending order by cell, with each
/// cell once and no zeros.
/// @param terms must not be part of the list. @param merged scratch; its content is lost.
template <class Cell, Field K>
void add_sorted_terms(std::pmr::vector<Entry<Cell, K>>& list,
                      std::type_identity_t<std::span<const Entry<Cell, K>>> terms,
                      typename K::Element scale, const K& field,
                      std::pmr::vector<Entry<Cell, K>>& merged) {
  using Term = Entry<Cell, K>;
  using Element = typename K::Element;
  if (8 * terms.size() < list.size()) {  // most of the list stays in place
    auto at = list.begin();
    for (const Term& t : terms) {
      at = std::lower_bound(at, list.end(), t.cell,
                            [](const Term& a, Cell cell) { return a.cell < cell; });
      Element value = field.multiply(scale, t.coefficient());
      if (at == list.end() || at->cell != t.cell) {
        at = list.insert(at, Term(t.cell, value));
        continue;
      }
      value = field.add(value, at->coefficient());
      if (field.is_zero(value))
        at = list.erase(at);
      else
        *at = Term(t.cell, value);
    }
    return;
  }
  merged.resize(list.size() + terms.size());
  const Term *i = list.data(), *const end = i + list.size();
  const Term *j = terms.data(), *const last = j + terms.size();
  Term* out = merged.data();
  while (i != end && j != last) {
    // The merge has no branches, because a processor could not predict the order of the terms.
    if constexpr (std::same_as<K, Z2>) {
      const Cell a = i->cell, b = j->cell;
      *out = a < b ? *i : *j;
      out += a != b ? 1 : 0;
      i += a <= b ? 1 : 0;
      j += b <= a ? 1 : 0;
    } else if (i->cell < j->cell) {
      *out++ = *i++;
    } else {
      Element value = field.multiply(scale, j->coefficient());
      if (i->cell == j->cell) value = field.add(value, (i++)->coefficient());
      if (!field.is_zero(value)) *out++ = Term(j->cell, value);
      ++j;
    }
  }
  out = std::copy(i, end, out);
  for (; j != last; ++j) *out++ = Term(j->cell, field.multiply(scale, j->coefficient()));
  list.assign(merged.data(), out);
}

}  // namespace ph
