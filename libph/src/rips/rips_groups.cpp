// SPDX-License-Identifier: MIT
#include "ph/detail/rips/rips_groups.hpp"

#include <algorithm>

namespace ph {

RipsGroups::RipsGroups(const RipsGraph& graph)
    : edges_(graph.edges()),
      key_(static_cast<Key>(graph.edge_count()) + 1),
      present_(static_cast<std::size_t>(graph.size()), static_cast<std::size_t>(graph.size()),
               graph.memory()),
      link_words_(graph.memory()),
      sets_(graph.memory()),
      chosen_(graph.memory()) {
  for (const FlagEdge& e : edges_) {
    present_.set(e.u, e.v);
    present_.set(e.v, e.u);
  }
}

bool RipsGroups::are_affordable(const RipsGraph& graph) {
  constexpr double always_affordable = 1 << 24;  // bytes
  const auto n = static_cast<double>(graph.size());
  return n * n / 8 <=
         std::max(always_affordable, sizeof(FlagEdge) * static_cast<double>(graph.edge_count()));
}

bool RipsGroups::go_to(Key key) {
  while (key_ > key) {
    const FlagEdge& e = edges_[--key_ - 1];
    present_.clear(e.u, e.v);
    present_.clear(e.v, e.u);
  }
  while (key_ < key) {
    const FlagEdge& e = edges_[key_++ - 1];
    present_.set(e.u, e.v);
    present_.set(e.v, e.u);
  }
  const FlagEdge& e = edges_[key - 1];
  const Word *u = present_.row(e.u), *v = present_.row(e.v);
  link_words_.clear();
  sets_.clear();
  for (std::size_t k = 0; k < present_.words(); ++k) {
    if (const Word common = u[k] & v[k]; common != 0) {
      link_words_.push_back(static_cast<std::uint32_t>(k));
      sets_.push_back(common);
    }
  }
  return link_words_.empty();
}

}  // namespace ph
