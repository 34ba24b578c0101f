// SPDX-License-Identifier: MIT
#include "rips/sweep/link_cover.hpp"

#include <algorithm>

namespace ph {

void LinkCover::find(const LinkComponents& components) {
  steps_.clear();
  sets_.clear();
  if (components.has_apex()) return cover(graph_.link(), components.apex());
  for (std::size_t i = 0; i < components.count(); ++i) {
    const Word* component = components.count() == 1 ? graph_.link() : components.vertices(i);
    cover(component, find_hub(component, components.root(i)));
  }
}

void LinkCover::cover(const Word* component, Vertex hub) {
  const std::size_t words = graph_.words();
  const Word* around = add_step({hub, true}, component);
  rest_.resize(words);
  reached_.assign(around, around + words);
  reached_[hub / 64] |= Word{1} << (hub % 64);
  Word left = 0;
  for (std::size_t k = 0; k < words; ++k) left |= rest_[k] = component[k] & ~reached_[k];
  while (left != 0) {
    left = 0;
    for (std::size_t k = 0; k < words; ++k) {
      for (Word rest = rest_[k]; rest != 0; rest &= rest - 1) {
        const auto w =
            static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
        if (bits::first_common(graph_.row(w), reached_.data(), words) == bits::kNone) continue;
        add_step({w, false}, reached_.data());
        reached_[k] |= rest & -rest;
        rest_[k] ^= rest & -rest;
      }
      left |= rest_[k];
    }
  }
}

LinkCover::Vertex LinkCover::find_hub(const Word* component, Vertex first) {
  constexpr std::size_t samples = 12;
  const std::size_t words = graph_.words();
  const std::size_t step =
      std::max<std::size_t>(1, bits::count_common(component, component, words) / samples);
  Vertex best = first;
  std::size_t place = 0, most = bits::count_common(graph_.row(first), component, words);
  bits::for_each(component, 0, words, [&](std::size_t w) {
    if (place++ % step != step / 2) return;
    const std::size_t degree =
        bits::count_common(graph_.row(static_cast<Vertex>(w)), component, words);
    if (degree <= most) return;
    most = degree;
    best = static_cast<Vertex>(w);
  });
  return best;
}

bits::Word* LinkCover::add_step(const Step& step, const Word* set) {
  const std::size_t words = graph_.words();
  steps_.push_back(step);
  sets_.resize(steps_.size() * words);
  Word* row = sets_.data() + (steps_.size() - 1) * words;
  const Word* around = graph_.row(step.vertex);
  for (std::size_t k = 0; k < words; ++k) row[k] = around[k] & set[k];
  return row;
}

}  // namespace ph
