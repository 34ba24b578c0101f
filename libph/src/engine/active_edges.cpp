// SPDX-License-Identifier: MIT
#include "ph/engine/active_edges.hpp"

#include "../core/for_each_target.hpp"

namespace ph {
namespace {

// Where a number is; `count` if it is absent.
PH_FOR_EACH_TARGET
std::size_t position_of(std::uint32_t number, const std::uint32_t* numbers, std::size_t count) {
  constexpr std::size_t block = 32;  // looked at without branches
  std::size_t k = 0;
  for (; k + block <= count; k += block) {
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < block; ++i) any |= numbers[k + i] == number ? 1U : 0U;
    if (any != 0) break;
  }
  while (k < count && numbers[k] != number) ++k;
  return k;
}

}  // namespace

ActiveEdges::Label* ActiveEdges::find(Vertex u, Vertex v) {
  Ends& ends = at_[u];
  const std::size_t k = position_of(v, ends.neighbours.data(), ends.neighbours.size());
  return k == ends.labels.size() ? nullptr : &ends.labels[k];
}

void ActiveEdges::insert(Vertex u, Vertex v, Label at_u, Label at_v) {
  at_[u].neighbours.push_back(v);
  at_[u].labels.push_back(at_u);
  at_[v].neighbours.push_back(u);
  at_[v].labels.push_back(at_v);
}

void ActiveEdges::erase(Vertex u, Vertex v) {
  erase_at(u, v);
  erase_at(v, u);
}

void ActiveEdges::erase_at(Vertex u, Vertex v) {
  Ends& ends = at_[u];
  const std::size_t k = position_of(v, ends.neighbours.data(), ends.neighbours.size());
  ends.neighbours[k] = ends.neighbours.back();
  ends.neighbours.pop_back();
  ends.labels[k] = ends.labels.back();
  ends.labels.pop_back();
}

}  // namespace ph
