// SPDX-License-Identifier: MIT
#include "libph/src/rips/sweep/link_cover.hpp"

#include <algorithm>

namespace ph {

void LinkCover::find(const LinkComponents& components) {
  steps_.clear();
  sets_.clear();
  if (components.has_apex()) {
    cover(graph_.link(), components.apex());
    return;
  }
  for (std::size_t i = 0; i < components.count(); ++i) {
    const Word* component = components.count() == 1 ? graph_.link() : components.vertices(i);
    cover(component, find_hub(component, components.root(i)));
  }
}

void LinkCover::find(const Word* set) {
  const std::size_t words = graph_.words();
  steps_.clear();
  sets_.clear();
  left_.assign(set, set + words);
  for (bool is_left = true; is_left; left_.assign(rest_.begin(), rest_.end())) {
    const auto first = static_cast<Vertex>(bits::first_common(left_.data(), left_.data(), words));
    is_left = cover(left_.data(), find_hub(left_.data(), first));
  }
}

bool LinkCover::cover(const Word* set, Vertex hub) {
  const std::size_t words = graph_.words();
  const Word* around = add_step({hub, true}, set);
  rest_.resize(words);
  reached_.assign(around, around + words);
  reached_[hub / 64] |= Word{1} << (hub % 64);
  Word left = 0;
  // mutant: surface-hub
  for (std::size_t k = 0; k < words; ++k) left |= rest_[k] = set[k] & ~reached_[k];
  for (bool grows = true; left != 0 && grows;) {
    left = 0;
    grows = false;
    for (std::size_t k = 0; k < words; ++k) {
      for (Word rest = rest_[k]; rest != 0; rest &= rest - 1) {
        const auto w =
            static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
        if (bits::first_common(graph_.row(w), reached_.data(), words) == bits::kNone) continue;
        add_step({w, false}, reached_.data());
        reached_[k] |= rest & -rest;
        rest_[k] ^= rest & -rest;
        grows = true;
      }
      left |= rest_[k];
    }
  }
  return left != 0;
}

LinkCover::Vertex LinkCover::find_hub(const Word* set, Vertex first) {
  constexpr std::size_t samples = 12;
  const std::size_t words = graph_.words();
  const std::size_t step = std::max<std::size_t>(1, bits::count_common(set, set, words) / samples);
  Vertex best = first;
  std::size_t place = 0, most = bits::count_common(graph_.row(first), set, words);
  bits::for_each(set, 0, words, [&](std::size_t w) {
    if (place++ % step != step / 2) return;
    const std::size_t degree = bits::count_common(graph_.row(static_cast<Vertex>(w)), set, words);
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
