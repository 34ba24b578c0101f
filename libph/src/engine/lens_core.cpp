// SPDX-License-Identifier: MIT
#include "ph/engine/lens_core.hpp"

#include <algorithm>

namespace ph {

void LensCore::keep_all() {
  rest_.assign(graph_.lens(), graph_.lens() + graph_.words());
  hubs_.clear();
  taken_.clear();
}

void LensCore::find(std::size_t size, Vertex first) {
  constexpr std::size_t most_failures = 3, worthwhile = 16;
  keep_all();
  std::size_t left = size, failures = 0;
  Vertex hub = first;
  for (std::size_t round = 0; left > 1 && failures < most_failures; ++round) {
    if (round > 0) hub = sampled_hub(left, round);
    const std::size_t count = take_dominated(hub);
    left -= count;
    if (count * worthwhile < left) ++failures;
  }
}

std::size_t LensCore::take_dominated(Vertex hub) {
  const std::size_t words = graph_.words();
  const Word* around = graph_.row(hub);
  taken_.resize(taken_.size() + words);
  Word* taken = taken_.data() + taken_.size() - words;
  std::size_t count = 0;
  for (std::size_t k = 0; k < words; ++k) {
    for (Word candidates = rest_[k] & around[k]; candidates != 0; candidates &= candidates - 1) {
      const std::size_t w = k * 64 + static_cast<std::size_t>(std::countr_zero(candidates));
      if (!bits::covers(around, graph_.row(static_cast<Vertex>(w)), rest_.data(), hub, words))
        continue;
      const Word bit = Word{1} << (w % 64);
      rest_[k] &= ~bit;
      taken[k] |= bit;
      ++count;
    }
  }
  if (count == 0)
    taken_.resize(taken_.size() - words);
  else
    hubs_.push_back(hub);
  return count;
}

LensCore::Vertex LensCore::sampled_hub(std::size_t left, std::size_t round) const {
  constexpr std::size_t samples = 12;
  const std::size_t step = std::max<std::size_t>(1, left / samples), words = graph_.words();
  std::size_t place = 0, most = 0;
  Vertex best = 0;
  bits::for_each(rest_.data(), 0, words, [&](std::size_t w) {
    if (place++ % step != round % step) return;
    const std::size_t degree =
        1 + bits::count_common(graph_.row(static_cast<Vertex>(w)), rest_.data(), words);
    if (degree <= most) return;
    most = degree;
    best = static_cast<Vertex>(w);
  });
  return best;
}

}  // namespace ph
