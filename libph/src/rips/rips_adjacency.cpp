// SPDX-License-Identifier: MIT
#include "ph/detail/rips/rips_adjacency.hpp"

#include <numeric>

namespace ph {

RipsAdjacency::RipsAdjacency(std::size_t vertices, std::span<const FlagEdge> edges,
                             std::pmr::memory_resource* memory)
    : size_(vertices), matrix_(memory), offsets_(memory), neighbours_(memory) {
  if (is_dense(vertices, edges.size()))
    lay_out_dense(edges);
  else
    lay_out_sparse(edges);
  clique_bound_ = degeneracy_bound(edges);
}

bool RipsAdjacency::is_dense(std::size_t vertices, std::size_t edges) {
  // A matrix takes 4 n^2 bytes, and lists take 16 bytes per edge. The matrix is chosen if it is at
  // most about twice as large as the lists.
  const double n = static_cast<double>(vertices);
  return vertices > 0 && static_cast<double>(edges) >= n * (n - 1) / 8;
}

void RipsAdjacency::lay_out_dense(std::span<const FlagEdge> edges) {
  const std::size_t n = size_;
  matrix_.assign(n * n, kNever);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [value, u, v] = edges[i];
    matrix_[u * n + v] = matrix_[v * n + u] = static_cast<Key>(i + 1);
  }
}

void RipsAdjacency::lay_out_sparse(std::span<const FlagEdge> edges) {
  offsets_.assign(size_ + 1, 0);
  for (const auto& [value, u, v] : edges) {
    ++offsets_[u + 1];
    ++offsets_[v + 1];
  }
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  neighbours_.resize(2 * edges.size());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [value, u, v] = edges[i];
    neighbours_[next[u]++] = {v, static_cast<Key>(i + 1)};
    neighbours_[next[v]++] = {u, static_cast<Key>(i + 1)};
  }
  for (std::size_t v = 0; v + 1 < offsets_.size(); ++v) {
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(offsets_[v]),
              neighbours_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]),
              [](const Neighbour& a, const Neighbour& b) { return a.vertex < b.vertex; });
  }
}

// Uses the algorithm of Matula & Beck (1983), which repeatedly removes a vertex of least degree.
// The largest degree at removal is the degeneracy. The vertices that are left are kept in a list
// sorted by degree, together with the first place of each degree.
Index RipsAdjacency::degeneracy_bound(std::span<const FlagEdge> edges) const {
  const std::size_t n = size_;
  if (n == 0) return 0;
  std::vector<std::uint32_t> degree(n, 0);
  for (const auto& [value, u, v] : edges) {
    ++degree[u];
    ++degree[v];
  }
  std::vector<std::uint32_t> bin(n + 1, 0), order(n), place(n);
  for (const std::uint32_t d : degree) ++bin[d + 1];
  std::partial_sum(bin.begin(), bin.end(), bin.begin());
  std::vector<std::uint32_t> next(bin.begin(), bin.end() - 1);
  for (std::uint32_t v = 0; v < n; ++v) {
    place[v] = next[degree[v]]++;
    order[place[v]] = v;
  }
  std::uint32_t degeneracy = 0;
  const auto lower_degree = [&](std::uint32_t w, std::uint32_t floor) {
    // The vertex has already been removed, or its degree cannot fall below the current least
    // degree.
    if (degree[w] <= floor) return;
    const std::uint32_t first = bin[degree[w]], other = order[first];
    std::swap(order[place[w]], order[first]);
    std::swap(place[w], place[other]);
    ++bin[degree[w]--];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t v = order[i], least = degree[v];
    degeneracy = std::max(degeneracy, least);
    if (!matrix_.empty()) {
      for (std::uint32_t w = 0; w < n; ++w)
        if (row(v)[w] != kNever) lower_degree(w, least);
    } else {
      for (const Neighbour& w : neighbours(v)) lower_degree(w.vertex, least);
    }
  }
  return Index{degeneracy} + 1;
}

}  // namespace ph
