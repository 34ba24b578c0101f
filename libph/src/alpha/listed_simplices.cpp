// SPDX-License-Identifier: MIT
#include "alpha/listed_simplices.hpp"

#include <algorithm>

namespace ph::alpha {
namespace {

using std::uint32_t;

/// A simplex by its sites, from the last to the first.
struct Listed {
  std::array<uint32_t, 4> descending;
  double value;
};

/// Calls `visit(sites in order, value)` for each simplex of a dimension.
template <class Visit>
void for_each_simplex(const AlphaCells& cells, int dim, Visit&& visit) {
  const auto& triangulation = cells.triangulation;
  if (dim == 0)
    for (uint32_t v = 0; v < cells.sites.size(); ++v)
      visit(std::array{v, kNone, kNone, kNone}, cells.vertex_value(v));
  if (dim > 0 && dim == cells.dim())
    for (std::size_t t = 0; t < triangulation.size(); ++t)
      visit(triangulation.cells[t], cells.cell_values[t]);
  if (dim > 0 && dim == cells.dim() - 1) {
    auto next = cells.facets.begin();
    for (std::size_t t = 0; t < triangulation.size(); ++t)
      for (int k = 0; k <= cells.dim(); ++k) {
        const auto code = static_cast<uint32_t>(4 * t) + static_cast<uint32_t>(k);
        if (cells.across(code) < code) continue;  // kNone is larger than any
        const bool is_critical = next != cells.facets.end() && next->code == code;
        const double value = facet_value(cells, code, is_critical ? &*next++ : nullptr);
        const auto v = cells.facet_vertices(code);
        visit(std::array{v[0], v[1], v[2], kNone}, value);
      }
  }
  if (dim == 1 && cells.dim() == 3)
    for (std::size_t e = 0; e < cells.edge_states.size(); ++e)
      visit(std::array{cells.edges.ends[e][0], cells.edges.ends[e][1], kNone, kNone},
            cells.edge_states[e].value);
}

}  // namespace

ExplicitComplex list_simplices(const AlphaCells& cells, const Enters& enters,
                               const RunContext& context) {
  SimplexList list;
  Ticker ticker(context, "simplices");
  std::pmr::vector<Listed> simplices(&context.memory);
  std::array<Index, 4> numbers{};
  const auto add = [&](std::size_t size, double value) {
    list.add(std::span(numbers).first(size), value);
    ticker.tick();
  };
  for (int dim = 0; dim <= std::max(cells.dim(), 1); ++dim) {
    const auto size = static_cast<std::size_t>(dim) + 1;
    simplices.clear();
    for_each_simplex(cells, dim, [&](std::array<uint32_t, 4> sites, double value) {
      if (!enters(value)) return;
      std::reverse(sites.begin(), sites.begin() + static_cast<std::ptrdiff_t>(size));
      simplices.push_back({sites, value});
    });
    std::ranges::sort(simplices, {}, &Listed::descending);
    for (const Listed& simplex : simplices) {
      for (std::size_t i = 0; i < size; ++i) numbers[i] = cells.sites.input[simplex.descending[i]];
      add(size, simplex.value);
    }
    if (dim > 1 || !enters(0)) continue;
    for (const auto& [copy, site] : cells.sites.copies) {
      numbers = {Index{copy}, Index{cells.sites.input[site]}};
      add(size, 0);
    }
  }
  return ExplicitComplex::from_simplices(std::move(list), {}, context);
}

int top_dim(const AlphaCells& cells, const Enters& enters) {
  for (int dim = cells.dim(); dim >= 0; --dim) {
    bool is_there = dim == 1 && !cells.sites.copies.empty() && enters(0);
    for_each_simplex(cells, dim,
                     [&](const auto&, double value) { is_there = is_there || enters(value); });
    if (dim == 0 && is_there && !cells.sites.copies.empty()) return 1;
    if (is_there) return dim;
  }
  return -1;
}

std::vector<std::size_t> simplex_counts(const AlphaCells& cells) {
  std::vector<std::size_t> counts;
  for (int dim = 0; dim <= cells.dim(); ++dim) {
    counts.push_back(0);
    for_each_simplex(cells, dim, [&](const auto&, double) { ++counts.back(); });
  }
  if (!cells.sites.copies.empty()) {
    counts.resize(std::max<std::size_t>(counts.size(), 2));
    counts[0] += cells.sites.copies.size();
    counts[1] += cells.sites.copies.size();
  }
  return counts;
}

}  // namespace ph::alpha
