// SPDX-License-Identifier: MIT
// Converts loops to chains of edges, and chains to loops.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "ph/loops.hpp"

namespace ph::test {

/// The non-zero coefficients of edges. Each edge is identified by its two endpoints.
using EdgeChain = std::map<std::pair<std::vector<Index>, std::vector<Index>>, std::int64_t>;

inline std::int64_t modulo(std::int64_t a, std::int64_t p) { return (a % p + p) % p; }
inline std::int64_t inverse(std::int64_t a, std::int64_t p) {
  for (std::int64_t b = 1; b < p; ++b)
    if (modulo(a * b, p) == 1) return b;
  return 0;
}

inline void add(EdgeChain& chain, const std::vector<Index>& tail, const std::vector<Index>& head,
                std::int64_t a, std::int64_t p) {
  auto& sum = chain[{tail, head}];
  sum = modulo(sum + a, p);
  if (sum == 0) chain.erase({tail, head});
}

/// The vertices of a loop, one after another. @param arity the number of coordinates per vertex.
inline std::vector<std::vector<Index>> vertices_of(const Loop& loop, std::size_t arity) {
  std::vector<std::vector<Index>> vertices;
  for (auto it = loop.numbers.begin(); it != loop.numbers.end();
       it += static_cast<std::ptrdiff_t>(arity))
    vertices.emplace_back(it, it + static_cast<std::ptrdiff_t>(arity));
  return vertices;
}

/// The sum of loops of a simplicial complex, as a chain of edges. Each edge is directed from the
/// smaller to the larger vertex.
inline EdgeChain sum_of(const std::vector<Loop>& loops, std::int64_t p) {
  EdgeChain chain;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, 1);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& next = v[(i + 1) % v.size()];
      if (v[i] < next)
        add(chain, v[i], next, loop.coefficient, p);
      else
        add(chain, next, v[i], -loop.coefficient, p);
    }
  }
  return chain;
}

inline EdgeChain edges_of(const InputChain& chain, std::int64_t p) {
  EdgeChain edges;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto numbers = chain.cell(i).numbers;
    add(edges, {numbers[0]}, {numbers[1]}, chain.coefficient(i), p);
  }
  return edges;
}

/// Checks what closed_walks promises about the form of its walks.
inline void check_form(const std::vector<Loop>& loops, std::size_t arity, std::int64_t p) {
  std::size_t last = SIZE_MAX;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, arity);
    ASSERT_FALSE(v.empty());
    EXPECT_LE(v.size(), last);
    last = v.size();
    EXPECT_EQ(std::set(v.begin(), v.end()).size(), v.size()) << "a vertex comes twice";
    EXPECT_EQ(std::ranges::min(v), v.front());
    EXPECT_TRUE(loop.coefficient >= 1 && loop.coefficient <= p / 2) << loop.coefficient;
    if (p == 2 && v.size() > 2) {
      EXPECT_LT(v[1], v.back());
    }
  }
}

}  // namespace ph::test
