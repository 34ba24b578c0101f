// SPDX-License-Identifier: MIT
#include "libph/src/alpha/listed_simplices.hpp"

#include <algorithm>

#include "libph/src/complex/counted_list.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// A simplex, given by its sites in descending order.
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
        if (cells.across(code) < code) continue;  // kNone is larger than any code
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
  std::size_t count = 0, vertices = 0;
  for (int dim = 0; dim <= std::max(cells.dim(), 1); ++dim) {
    std::size_t here = dim <= 1 && enters(0) ? cells.sites.copies.size() : 0;
    for_each_simplex(cells, dim, [&](const auto&, double value) { here += enters(value) ? 1 : 0; });
    count += here;
    vertices += here * (static_cast<std::size_t>(dim) + 1);
  }
  CountedList list(count, vertices, context);
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
    if (dim > 1 || !enters(0)) continue;  // mutant: alpha-copy-edges
    for (const auto& [copy, site] : cells.sites.copies) {
      numbers = {Index{copy}, Index{cells.sites.input[site]}};
      add(size, 0);
    }
  }
  simplices = std::pmr::vector<Listed>(&context.memory);
  return ExplicitComplex::from_simplices(list.take(), {}, context);
}

namespace {

/// Lists the cells of a Delta-complex with their boundaries. The sites of a cell ascend, but the
/// input points of these sites need not. Chains list the input points of each cell in ascending
/// order, and the incidences in the boundaries refer to this order.
class CellList {
 public:
  CellList(const AlphaCells& cells, const Enters& enters, SimplexList& vertices,
           const RunContext& context)
      : cells_(cells),
        enters_(enters),
        vertices_(vertices),
        ticker_(context, "cells"),
        is_turned_(&context.memory),
        vertex_rows_(cells.sites.size(), kMissing, &context.memory),
        edge_rows_(cells.edge_states.size(), kMissing, &context.memory),
        facet_rows_(4 * cells.triangulation.size(), kMissing, &context.memory) {}

  BoundaryMatrix run() {
    for (uint32_t v = 0; v < cells_.sites.size(); ++v)
      vertex_rows_[v] = add_cell({&v, 1}, cells_.vertex_value(v), {});
    add_copies();
    add_edges();
    if (cells_.dim() > 1) add_facets();
    for (uint32_t t = 0; t < cells_.triangulation.size(); ++t) {
      const auto size = static_cast<std::size_t>(cells_.dim()) + 1;
      const auto& cell = cells_.triangulation.cells[t];
      auto boundary = size == 2 ? boundary_of_edge(cell) : std::array<Index, 4>();
      for (uint32_t k = 0; size > 2 && k < size; ++k) boundary[k] = facet_row(4 * t + k);
      add_cell(std::span(cell).first(size), cells_.cell_values[t], std::span(boundary).first(size));
    }
    return std::move(matrix_);
  }

 private:
  static constexpr Index kMissing = -1;

  /// Adds a cell if it enters the filtration. @param boundary the row of each facet of the cell;
  /// facet i is opposite vertex i.
  /// @return the row of the cell, or kMissing if it does not enter.
  Index add_cell(std::span<const uint32_t> sites, double value, std::span<const Index> boundary) {
    std::array<Index, 4> points{};
    for (std::size_t i = 0; i < sites.size(); ++i) points[i] = cells_.sites.input[sites[i]];
    return add(std::span(points).first(sites.size()), value, boundary);
  }
  /// Adds a cell if it enters the filtration. @param points the points of the cell in the order of
  /// their sites; the function sorts them.
  Index add(std::span<Index> points, double value, std::span<const Index> boundary) {
    if (!enters_(value)) return kMissing;
    ticker_.tick();
    const auto row = static_cast<Index>(matrix_.dims.size());
    matrix_.dims.push_back(static_cast<int>(points.size()) - 1);
    matrix_.values.push_back(value);
    const bool is_turned = sort_points(points);
    is_turned_.push_back(is_turned);
    vertices_.add(points, value);
    const bool is_loop = boundary.size() == 2 && boundary[0] == boundary[1];  // mutant: alpha-loop
    for (std::size_t k = 0; k < boundary.size() && !is_loop; ++k) {
      // mutant: alpha-face-sign
      const bool is_against = is_turned != is_turned_[static_cast<std::size_t>(boundary[k])];
      matrix_.rows.push_back(boundary[k]);
      matrix_.incidences.push_back((k % 2 == 0) != is_against ? 1 : -1);
    }
    matrix_.offsets.push_back(matrix_.rows.size());
    return row;
  }
  /// Keeps the order of equal points. @return true if the permutation is odd.
  static bool sort_points(std::span<Index> points) {
    bool is_odd = false;
    for (std::size_t i = 1; i < points.size(); ++i)
      for (std::size_t k = i; k > 0 && points[k - 1] > points[k]; --k) {
        std::swap(points[k - 1], points[k]);
        is_odd = !is_odd;
      }
    return is_odd;
  }
  void add_copies() {
    if (!enters_(0)) return;
    for (const auto& [copy, site] : cells_.sites.copies) {
      std::array points{Index{cells_.sites.input[site]}, Index{copy}};
      const Index row = add(std::span(points).last(1), 0, {});
      add(points, 0, std::array{row, vertex_rows_[site]});
    }
  }
  template <class Ends>
  std::array<Index, 4> boundary_of_edge(const Ends& ends) const {
    return {vertex_rows_[ends[1]], vertex_rows_[ends[0]]};
  }
  void add_edges() {
    for (std::size_t e = 0; e < cells_.edge_states.size(); ++e) {
      const auto& ends = cells_.edges.ends[e];
      const auto boundary = boundary_of_edge(ends);
      edge_rows_[e] = add_cell(ends, cells_.edge_states[e].value, std::span(boundary).first(2));
    }
  }
  void add_facets() {
    const auto size = static_cast<std::size_t>(cells_.dim());
    for (uint32_t code = 0; code < facet_rows_.size(); ++code) {
      // kNone is larger than any code.
      if ((code & 3) > size || cells_.across(code) < code) continue;
      const auto v = cells_.facet_vertices(code);
      auto boundary = size == 2 ? boundary_of_edge(v) : std::array<Index, 4>();
      if (size == 3) {
        const auto edges = cells_.facet_edges(code);
        for (std::size_t i = 0; i < 3; ++i) boundary[i] = edge_rows_[edges[i]];
      }
      facet_rows_[code] = add_cell(std::span(v).first(size), facet_value(cells_, code),
                                   std::span(boundary).first(size));
    }
  }
  Index facet_row(uint32_t code) const { return facet_rows_[std::min(code, cells_.across(code))]; }

  const AlphaCells& cells_;
  const Enters& enters_;
  SimplexList& vertices_;
  Ticker ticker_;
  BoundaryMatrix matrix_;
  // For each row: true if the permutation that sorted the points is odd.
  std::pmr::vector<bool> is_turned_;
  // The rows of the vertices are indexed by site, the rows of the edges by number, and the rows of
  // the facets by usual name.
  std::pmr::vector<Index> vertex_rows_, edge_rows_, facet_rows_;
};

}  // namespace

ExplicitComplex list_cells(const AlphaCells& cells, const Enters& enters, SimplexList& vertices,
                           const RunContext& context) {
  vertices = {};
  const BoundaryMatrix matrix = CellList(cells, enters, vertices, context).run();
  return ExplicitComplex::from_boundary(matrix, {}, context);
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
