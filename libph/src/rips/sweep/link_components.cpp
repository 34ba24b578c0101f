// SPDX-License-Identifier: MIT
#include "libph/src/rips/sweep/link_components.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace ph {
namespace {

void clear(bits::Word* row, std::uint32_t v) { row[v / 64] &= ~(bits::Word{1} << (v % 64)); }
void set(bits::Word* row, std::uint32_t v) { row[v / 64] |= bits::Word{1} << (v % 64); }

}  // namespace

void LinkComponents::find(const FlagEdge& e) {
  const std::size_t words = graph_.words();
  roots_.clear();
  sets_.clear();
  apex_ = kNone;
  Vertex start = kNone;
  for (const Vertex last : {last_apex_[e.u], last_apex_[e.v]}) {
    const Vertex guess = last == kNone ? kNone : graph_.local(last);
    if (guess == kNone) continue;
    if (is_apex(guess)) {
      set_apex(e, guess);
      roots_.push_back(guess);
      return;
    }
    start = guess;
  }
  const bool is_guess = start != kNone;  // a guess that turned out not to be an apex
  if (!is_guess) start = graph_.first();
  rest_.assign(graph_.link(), graph_.link() + words);
  if (!take_component(start)) {
    roots_.push_back(start);
    if (!is_guess && is_apex(start)) set_apex(e, start);
    return;
  }
  for (bool is_left = true;; is_left = take_component(start)) {
    const Word* component = sets_.data() + sets_.size() - words;
    roots_.push_back(static_cast<Vertex>(bits::first_common(component, component, words)));
    if (!is_left) break;
    start = static_cast<Vertex>(bits::first_common(rest_.data(), rest_.data(), words));
  }
  sort_components();
}

void LinkComponents::find_roots(const FlagEdge& e) {
  constexpr std::size_t few = 16;
  std::array<Vertex, few> vertices;
  std::size_t count = 0;
  for (std::size_t k = 0; k < graph_.words(); ++k)
    for (Word rest = graph_.link()[k]; rest != 0; rest &= rest - 1) {
      if (count == few) return find(e);
      vertices[count++] =
          static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  roots_.clear();
  sets_.clear();
  apex_ = kNone;
  // Bits mark vertices that have been reached, and vertices whose neighbours have not been visited
  // yet.
  for (std::uint32_t met = 0, left = 0, i = 0; i < count; ++i) {
    if ((met >> i & 1) != 0) continue;  // mutant: formal-components
    roots_.push_back(vertices[i]);
    for (left = 1U << i; left != 0;) {
      const Word* row = graph_.row(vertices[static_cast<std::size_t>(std::countr_zero(left))]);
      met |= left;
      left &= left - 1;
      for (std::size_t k = i + 1; k < count; ++k)
        left |=
            static_cast<std::uint32_t>(row[vertices[k] / 64] >> (vertices[k] % 64) & 1) << k & ~met;
    }
  }
}

bool LinkComponents::take_component(Vertex first) {
  const std::size_t words = graph_.words();
  sets_.resize(sets_.size() + words);
  Word* component = sets_.data() + sets_.size() - words;
  clear(rest_.data(), first);
  bool is_left = bits::split(rest_.data(), graph_.row(first), component, 0, words);
  set(component, first);
  // Usually only a few vertices are left, and they are joined to one another. If one of them is
  // joined to the component, its neighbours are also joined to the component.
  for (bool grew = true; is_left && grew;) {
    grew = is_left = false;
    for (std::size_t k = 0; k < words; ++k) {
      for (Word rest = rest_[k]; rest != 0;) {
        const auto w =
            static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
        rest &= rest - 1;
        const Word* row = graph_.row(w);
        if (!bits::any_common(row, component, words)) continue;
        clear(rest_.data(), w);
        set(component, w);
        if (!bits::split(rest_.data(), row, component, k, words) && !is_left) return false;
        rest &= rest_[k];
        grew = true;
      }
      is_left |= rest_[k] != 0;
    }
  }
  return is_left;
}

void LinkComponents::sort_components() {
  // All roots are in ascending order, except the root of the component that began with a guess.
  const std::size_t words = graph_.words();
  for (std::size_t i = 1; i < count() && roots_[i] < roots_[i - 1]; ++i) {
    std::swap(roots_[i], roots_[i - 1]);
    std::swap_ranges(sets_.begin() + static_cast<std::ptrdiff_t>((i - 1) * words),
                     sets_.begin() + static_cast<std::ptrdiff_t>(i * words),
                     sets_.begin() + static_cast<std::ptrdiff_t>(i * words));
  }
}

bool LinkComponents::find_apex(const FlagEdge& e) {
  // An apex is joined to every other vertex. If a candidate is not joined to some vertex, any apex
  // is therefore a neighbour of this vertex.
  const std::size_t words = graph_.words();
  const auto has = [&](std::size_t w) { return (rest_[w / 64] >> (w % 64) & 1) != 0; };
  rest_.assign(graph_.link(), graph_.link() + words);
  for (;;) {
    const std::size_t candidate = bits::first_common(rest_.data(), rest_.data(), words);
    if (candidate == bits::kNone) return false;
    const auto v = static_cast<Vertex>(candidate);
    const std::size_t missed = bits::first_missing(graph_.link(), graph_.row(v), v, words);
    if (missed == bits::kNone) {  // mutant: surface-apex
      set_apex(e, v);
      return true;
    }
    const bool itself = has(missed);
    const Word* row = graph_.row(static_cast<Vertex>(missed));
    for (std::size_t k = 0; k < words; ++k) rest_[k] &= row[k];
    if (itself) set(rest_.data(), static_cast<Vertex>(missed));
  }
}

}  // namespace ph
