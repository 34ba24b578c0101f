// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

#include "libph/src/rips/annotations/vertex_functions.hpp"
#include "libph/src/rips/sweep/link_forest.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

struct PotentialStep {
  bool changed = false;     ///< true if the potential is no longer the same function
  bool mismatched = false;  ///< true if an edge requires a different value
};

/// Extends a potential p to the next vertex y of a forest. An edge wy requires p(y) = p(w) +
/// asked(w). The first edge from y to each part determines a constant by which the potential is
/// shifted on that part.
/// @param mismatch receives p(w) + asked(w) - p(y) for the other edges.
template <Field K>
PotentialStep extend_potential(typename VertexFunction<K>::Unit* p,
                               const typename VertexFunction<K>::Unit* asked,
                               typename VertexFunction<K>::Unit* mismatch, std::uint32_t y,
                               const LinkForest& forest, const K& field) {
  using Function = VertexFunction<K>;
  using Element = typename K::Element;
  const std::size_t words = LinkForest::words_to(y);
  const auto& meetings = forest.meetings();
  const auto asked_at = [&](std::uint32_t w) {
    return field.add(Function::value(p, w), Function::value(asked, w));
  };
  PotentialStep step;
  const Element value = asked_at(meetings.front().at);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const Element here = asked_at(meetings[i].at);
    // mutant: surface-mismatch
    step.mismatched |=
        Function::difference(mismatch, p, asked, here, forest.neighbours(i), field, words);
    if (here == value) continue;  // mutant: surface-constant
    Function::shift(p, forest.part(meetings[i]), field.add(value, field.negate(here)), field,
                    words);
    step.changed = true;
  }
  if (!field.is_zero(value)) {
    Function::add_at(p, y, value, field);
    step.changed = true;
  }
  return step;
}

}  // namespace ph
