// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "libph/src/loops/early_graph.hpp"
#include "ph/detail/core/loop.hpp"

namespace ph::detail {

/// A sum of chains of edges.
class EdgeSum {
 public:
  explicit EdgeSum(std::int64_t field) : p_(field) {}
  /// Adds a closed walk, given by its vertices. The names of vertices must ascend with their
  /// numbers.
  void add(const EarlyGraph& graph, std::span<const std::uint32_t> walk, std::int64_t coefficient) {
    if (walk.size() < 2) return;  // the walk has become empty
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const std::uint32_t u = walk[i], v = walk[(i + 1) % walk.size()];
      terms_.push_back({graph.name(std::min(u, v)), graph.name(std::max(u, v)),
                        u < v ? coefficient : -coefficient});
    }
  }
  /// Splits the sum into closed walks.
  std::vector<Loop> loops(const RunContext& context) {
    std::ranges::sort(terms_, [](const Term& a, const Term& b) {
      return std::tie(a.u, a.v) < std::tie(b.u, b.v);
    });
    std::vector<Index> numbers;
    std::vector<std::int64_t> coefficients;
    for (std::size_t i = 0; i < terms_.size();) {
      const auto [u, v, first] = terms_[i];
      std::int64_t sum = 0;
      for (; i < terms_.size() && terms_[i].u == u && terms_[i].v == v; ++i)
        sum = (sum + terms_[i].coefficient) % p_;
      if (sum == 0) continue;
      numbers.insert(numbers.end(), {u, v});
      coefficients.push_back(sum);
    }
    return closed_walks(InputChain(CellKind::vertices, numbers, coefficients), p_, {}, context);
  }

 private:
  struct Term {
    Index u, v;
    std::int64_t coefficient;
  };
  std::int64_t p_;
  std::vector<Term> terms_;
};

/// Splits a closed walk wherever it returns to a vertex. No part passes a vertex twice, and all
/// parts together are no longer than the walk. The parts are in the same order as the loops of
/// EdgeSum.
inline std::vector<Loop> parts_of(std::span<const std::uint32_t> walk, const EarlyGraph& graph,
                                  std::int64_t coefficient, std::int64_t field,
                                  const RunContext& context) {
  // The key of a part is the list of its vertices, which starts at the smallest vertex and
  // continues with the smaller of that vertex's two neighbours.
  std::map<std::vector<std::uint32_t>, EdgeSum> parts;
  std::vector<std::uint32_t> open;
  const auto close = [&](auto first) {
    const std::vector<std::uint32_t> part(first, open.end());
    open.erase(first, open.end());
    std::vector<std::uint32_t> vertices = part;
    std::ranges::rotate(vertices, std::ranges::min_element(vertices));
    if (vertices.size() > 2 && vertices[1] > vertices.back())
      std::reverse(vertices.begin() + 1, vertices.end());
    parts.try_emplace(std::move(vertices), field).first->second.add(graph, part, coefficient);
  };
  for (const std::uint32_t vertex : walk) {
    if (const auto before = std::ranges::find(open, vertex); before != open.end()) close(before);
    open.push_back(vertex);
  }
  close(open.begin());
  std::vector<Loop> loops;
  for (auto& [vertices, sum] : parts)
    for (Loop& loop : sum.loops(context)) loops.push_back(std::move(loop));
  std::ranges::sort(loops, [](const Loop& a, const Loop& b) {
    return a.numbers.size() != b.numbers.size() ? a.numbers.size() > b.numbers.size()
                                                : a.numbers < b.numbers;
  });
  return loops;
}

}  // namespace ph::detail
