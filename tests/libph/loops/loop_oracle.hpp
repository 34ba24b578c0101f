// SPDX-License-Identifier: MIT
// Computes loops by their definition. Boundaries and cocycles are found by elimination on dense
// rows. Shortest walks are found by Dijkstra's algorithm, whose nodes are pairs of a vertex and the
// values of the cocycles.
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/rips.hpp"
#include "tests/libph/loops/loop_chains.hpp"

namespace ph::test {

/// The coefficient of each edge of a complex.
using EdgeRow = std::vector<std::int64_t>;

/// A flag complex with a list of its edges, as the oracle needs it.
struct FlagComplex {
  struct Edge {
    std::array<Index, 2> ends;  // the two vertices, ascending
    double value;
  };
  std::vector<Edge> edges;  // in the order of the filtration
  std::int64_t p;

  FlagComplex(const RipsGraph& graph, std::int64_t field) : p(field) {
    for (std::uint32_t key = 1; key <= graph.edge_count(); ++key) {
      const FlagEdge& e = graph.edge(key);
      edges.push_back({{graph.name(e.v), graph.name(e.u)}, e.value});
    }
  }
  std::optional<std::size_t> place(Index a, Index b) const {
    const std::array<Index, 2> ends{std::min(a, b), std::max(a, b)};
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (edges[i].ends == ends) return i;
    return std::nullopt;
  }
  /// The boundaries of the triangles whose edges all satisfy `in`, as rows over all edges.
  template <class In>
  std::vector<EdgeRow> boundaries(In&& in) const {
    std::set<Index> vertices;
    for (const Edge& e : edges) vertices.insert(e.ends.begin(), e.ends.end());
    std::vector<EdgeRow> rows;
    for (const Index a : vertices)
      for (auto b = vertices.upper_bound(a); b != vertices.end(); ++b)
        for (auto c = std::next(b); c != vertices.end(); ++c) {
          const auto ab = place(a, *b), bc = place(*b, *c), ac = place(a, *c);
          if (!ab || !bc || !ac || !in(edges[*ab]) || !in(edges[*bc]) || !in(edges[*ac])) continue;
          EdgeRow row(edges.size(), 0);
          row[*ab] = row[*bc] = 1;
          row[*ac] = p - 1;
          rows.push_back(row);
        }
    return rows;
  }
  EdgeRow row_of(const EdgeChain& chain) const {
    EdgeRow row(edges.size(), 0);
    for (const auto& [ends, a] : chain) row[*place(ends.first[0], ends.second[0])] = a;
    return row;
  }
};

/// Reduces the rows to echelon form. @return the pivot of each row that remains.
inline std::vector<std::size_t> eliminate(std::vector<EdgeRow>& rows, std::int64_t p) {
  std::vector<std::size_t> pivots;
  const std::size_t columns = rows.empty() ? 0 : rows.front().size();
  for (std::size_t c = 0; c < columns && pivots.size() < rows.size(); ++c) {
    const std::size_t top = pivots.size();
    std::size_t r = top;
    while (r < rows.size() && rows[r][c] == 0) ++r;
    if (r == rows.size()) continue;
    std::swap(rows[top], rows[r]);
    const std::int64_t scale = inverse(rows[top][c], p);
    for (auto& a : rows[top]) a = a * scale % p;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == top || rows[i][c] == 0) continue;
      const std::int64_t factor = rows[i][c];
      for (std::size_t k = 0; k < columns; ++k)
        rows[i][k] = modulo(rows[i][k] - factor * rows[top][k], p);
    }
    pivots.push_back(c);
  }
  rows.resize(pivots.size());
  return pivots;
}

inline bool is_in_span(std::vector<EdgeRow> rows, const EdgeRow& row, std::int64_t p) {
  const std::size_t rank = eliminate(rows, p).size();
  rows.push_back(row);
  return eliminate(rows, p).size() == rank;
}

/// A basis of the cocycles on the edges that satisfy `in`. A cocycle vanishes on the boundary of
/// every triangle of these edges.
template <class In>
std::vector<EdgeRow> cocycles_of(const FlagComplex& complex, In&& in) {
  std::vector<EdgeRow> rows = complex.boundaries(in);
  const std::vector<std::size_t> pivots = eliminate(rows, complex.p);
  std::vector<EdgeRow> cocycles;
  for (std::size_t free = 0; free < complex.edges.size(); ++free) {
    if (!in(complex.edges[free]) || std::ranges::find(pivots, free) != pivots.end()) continue;
    EdgeRow cocycle(complex.edges.size(), 0);
    cocycle[free] = 1;
    for (std::size_t r = 0; r < rows.size(); ++r)
      cocycle[pivots[r]] = modulo(-rows[r][free], complex.p);
    cocycles.push_back(cocycle);
  }
  return cocycles;
}

/// The length of the shortest closed walk with the following properties. The walk passes edge
/// `birth` once, and its other edges satisfy `may_use`. Each cocycle has the same value on `chain`
/// as on the walk times the coefficient of `birth` in `chain`. Nothing if there is no such walk, or
/// if too many states would have to be examined.
inline std::optional<double> shortest_walk(const FlagComplex& complex, const EdgeRow& chain,
                                           std::size_t birth, const std::vector<bool>& may_use,
                                           const std::vector<EdgeRow>& cocycles, bool& gave_up) {
  const std::int64_t p = complex.p;
  const auto value_on = [&](const EdgeRow& cocycle, const EdgeRow& of) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < of.size(); ++i) sum = modulo(sum + cocycle[i] * of[i], p);
    return sum;
  };
  std::vector<std::int64_t> target;
  for (const EdgeRow& cocycle : cocycles)
    target.push_back(
        modulo(value_on(cocycle, chain) * inverse(chain[birth], p) - cocycle[birth], p));
  const auto [low, high] = complex.edges[birth].ends;
  using State = std::pair<Index, std::vector<std::int64_t>>;
  std::map<State, double> best;
  std::set<std::pair<double, State>> queue;
  const auto reach = [&](const State& state, double length) {
    const auto [it, is_new] = best.try_emplace(state, length);
    if (!is_new && it->second <= length) return;
    if (!is_new) queue.erase({it->second, state});
    it->second = length;
    queue.insert({length, state});
  };
  reach({high, std::vector<std::int64_t>(cocycles.size(), 0)}, 0);
  while (!queue.empty()) {
    const auto [length, state] = *queue.begin();
    queue.erase(queue.begin());
    if (state == State{low, target}) return length + complex.edges[birth].value;
    if (best.size() > 20000) {
      gave_up = true;
      return std::nullopt;
    }
    for (std::size_t i = 0; i < complex.edges.size(); ++i) {
      const auto [a, b] = complex.edges[i].ends;
      if (!may_use[i] || (a != state.first && b != state.first)) continue;
      const bool ascends = a == state.first;
      State next{ascends ? b : a, state.second};
      for (std::size_t k = 0; k < cocycles.size(); ++k)
        next.second[k] = modulo(next.second[k] + (ascends ? 1 : -1) * cocycles[k][i], p);
      reach(next, length + complex.edges[i].value);
    }
  }
  return std::nullopt;
}

}  // namespace ph::test
