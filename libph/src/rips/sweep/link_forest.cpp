// SPDX-License-Identifier: MIT
#include "libph/src/rips/sweep/link_forest.hpp"

#include <algorithm>

namespace ph {

void LinkForest::meet(Vertex y, const Word* set) {
  const std::size_t words = words_to(y);
  const Word* row = graph_.row(y);
  before_.resize(graph_.words());
  for (std::size_t k = 0; k < words; ++k) before_[k] = set[k] & row[k];
  before_[y / 64] &= ~(~Word{0} << (y % 64));
  meetings_.clear();
  shared_.clear();
  for (std::size_t k = 0; k < words; ++k) {
    for (Word rest = before_[k]; rest != 0;) {
      const auto at =
          static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
      std::size_t part = 0;
      while (!(set_of(part)[k] >> (at % 64) & 1)) ++part;
      const bool is_new = std::ranges::find(meetings_, part, &Meeting::part) == meetings_.end();
      if (is_new) {
        meetings_.push_back({part, at});
        shared_.resize(meetings_.size() * graph_.words());
        Word* shared = shared_.data() + (meetings_.size() - 1) * graph_.words();
        for (std::size_t i = k; i < words; ++i) shared[i] = before_[i] & set_of(part)[i];
      }
      rest &= ~set_of(part)[k];
    }
  }
}

void LinkForest::start_part(Vertex y) {
  roots_.push_back(y);
  parts_.resize(roots_.size() * graph_.words());
  set_of(roots_.size() - 1)[y / 64] |= Word{1} << (y % 64);
}

void LinkForest::unite(std::size_t from, std::size_t to) {
  for (std::size_t k = 0; k < graph_.words(); ++k) {
    set_of(to)[k] |= set_of(from)[k];
    set_of(from)[k] = 0;
  }
  // The part to be removed is usually the single vertex that was added last. Removing that part
  // entirely leaves no empty part.
  if (from + 1 == roots_.size()) {
    roots_.pop_back();
    parts_.resize(roots_.size() * graph_.words());
  }
}

}  // namespace ph
