// SPDX-License-Identifier: MIT
#pragma once
// This file contains the functions of LinkPrimitives that search in the order of the filtration,
// for the classes that die.
#include "libph/src/rips/annotations/extend_potential.hpp"
#include "libph/src/rips/volumes/link_primitives.hpp"

namespace ph {

template <Field K>
bool LinkPrimitives<K>::extend_over_parts(Vertex z, Vertex y) {
  const std::size_t words = LinkForest::words_to(y);
  bool is_mismatched = false;
  for (Search* s : used_) {
    if (!s->is_active) continue;
    if (!find_asked(*s, z, y, parts_of_star_.neighbours(), words)) {
      if (s->is_flat) continue;
      std::fill_n(asked_.begin(), words * Function::kUnitsPerBlock, Unit{});
    }
    const PotentialStep step = extend_potential(rows_[s->potential], asked_.data(),
                                                rows_[s->mismatch], y, parts_of_star_, field_);
    if (step.mismatched) is_mismatched = s->is_mismatched = true;
    if (step.changed) s->is_flat = false;
  }
  return is_mismatched;
}

template <Field K>
void LinkPrimitives<K>::find_loops_over_parts() {
  const std::size_t words = graph_.words();
  for (const auto& meeting : parts_.meetings()) {
    bool is_first = true;
    for (std::size_t i = 0; i < parts_of_star_.part_count(); ++i) {
      const Word* part = parts_of_star_.part(i);
      if (!bits::any_common(part, parts_.part(meeting), words)) continue;
      // mutant: volume-ordered-loops
      if (!is_first) loop_vertices_.insert(loop_vertices_.end(), part, part + words);
      is_first = false;
    }
  }
}

template <Field K>
template <class OnObstruction, class OnAdd>
void LinkPrimitives<K>::search_in_order(OnObstruction&& on_obstruction, OnAdd&& on_add) {
  const std::size_t words = graph_.words();
  const auto settle = [&](Vertex z, Vertex y) {
    for (std::size_t from = 0, w; (w = first_mismatch(from)) != bits::kNone; from = w + 1) {
      const auto at = static_cast<Vertex>(w);
      Search* by = mismatched_loop(at);
      if (by == nullptr) {
        for (Search* s : used_)
          // mutant: volume-youngest
          if (!field_.is_zero(mismatch_of(*s, at)) &&
              (by == nullptr || by->generator < s->generator))
            by = s;
        by->is_obstructed = true;
        on_obstruction(*by, z, y, at);
      }
      correct_others(*by, at, on_add);
    }
    for (Search* s : used_) s->is_mismatched = false;
  };
  while (!used_.empty() && used_.back()->is_loop()) drop_last();
  for (Search* s : used_) {
    s->is_active = s->is_obstructed;
    s->is_obstructed = false;
    if (s->is_active) s->psi.clear();
  }
  parts_.clear();
  bits::for_each(graph_.link(), 0, words, [&](std::size_t vertex) {
    const auto z = static_cast<Vertex>(vertex);
    parts_.meet(z, graph_.link());
    before_.assign(words, 0);
    std::copy_n(parts_.neighbours(), LinkForest::words_to(z), before_.begin());
    begin_vertex();
    parts_of_star_.clear();
    bits::for_each(before_.data(), 0, words, [&](std::size_t neighbour) {
      const auto y = static_cast<Vertex>(neighbour);
      parts_of_star_.meet(y, before_.data());
      if (!parts_of_star_.meetings().empty() && extend_over_parts(z, y)) settle(z, y);
      parts_of_star_.join(y, [](auto&&...) {});
    });
    find_loops_over_parts();
    end_vertex(z);
    parts_.join(z, [](auto&&...) {});
  });
  finish();
}

}  // namespace ph
