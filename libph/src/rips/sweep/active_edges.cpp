// SPDX-License-Identifier: MIT
#include "libph/src/rips/sweep/active_edges.hpp"

#include <algorithm>

#include "libph/src/core/for_each_target.hpp"

namespace ph {
namespace {

// The position of a number in a list where it occurs at most once. Returns `count` if the number is
// not in the list.
PH_FOR_EACH_TARGET
std::size_t position_of(std::uint32_t number, const std::uint32_t* numbers, std::size_t count) {
  constexpr std::size_t block = 64;  // a block is scanned without branches
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t size = std::min(block, count - begin);
    std::uint32_t place = 0;  // the place is counted from one
    for (std::uint32_t i = 0; i < size; ++i) place |= numbers[begin + i] == number ? i + 1 : 0;
    if (place != 0) return begin + place - 1;
  }
  return count;
}

}  // namespace

ActiveEdges::Label* ActiveEdges::find(Vertex u, Vertex v) {
  if (has_rows() && !rows_.test(u, v)) return nullptr;
  Ends& ends = at_[u];
  const std::size_t k = position_of(v, ends.neighbours.data(), ends.neighbours.size());
  return k == ends.labels.size() ? nullptr : &ends.labels[k];
}

void ActiveEdges::insert(Vertex u, Vertex v, Label at_u, Label at_v) {
  at_[u].neighbours.push_back(v);
  at_[u].labels.push_back(at_u);
  at_[v].neighbours.push_back(u);
  at_[v].labels.push_back(at_v);
  ++degrees_[u];
  ++degrees_[v];
  if (!has_rows()) return;
  rows_.set(u, v);
  rows_.set(v, u);
}

void ActiveEdges::clear() {
  for (Vertex u = 0; u < vertex_count(); ++u) {
    if (has_rows())
      for (const Vertex v : at_[u].neighbours) rows_.clear(u, v);
    at_[u].neighbours.clear();
    at_[u].labels.clear();
    degrees_[u] = 0;
  }
}

void ActiveEdges::erase(Vertex u, Vertex v) {
  erase_at(u, v);
  erase_at(v, u);
}

void ActiveEdges::erase_at(Vertex u, Vertex v) {
  Ends& ends = at_[u];
  const std::size_t degree = --degrees_[u];
  std::size_t kept = 0;
  const auto keep = [&](std::size_t k) {
    ends.neighbours[kept] = ends.neighbours[k];
    ends.labels[kept++] = ends.labels[k];
  };
  if (has_rows()) {
    constexpr std::size_t few = 16;
    rows_.clear(u, v);
    if (ends.neighbours.size() <= 2 * degree + few) return;
    for (std::size_t k = 0; k < ends.neighbours.size(); ++k)
      if (rows_.test(u, ends.neighbours[k])) keep(k);
  } else {
    kept = position_of(v, ends.neighbours.data(), ends.neighbours.size());
    keep(degree);
    kept = degree;
  }
  ends.neighbours.resize(kept);
  ends.labels.resize(kept);
}

}  // namespace ph
