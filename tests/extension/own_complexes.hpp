// SPDX-License-Identifier: MIT
#pragma once
// Complexes that are derived from the base classes of ph/custom.hpp. They have only the functions
// that these base classes require.
#include <algorithm>
#include <limits>
#include <map>
#include <ph/custom.hpp>
#include <span>
#include <utility>
#include <vector>

/// Simplices from a list. All other simplices never enter.
class LookedUp : public ph::SimplexFiltration<LookedUp, 3> {
 public:
  LookedUp(ph::Index vertices, const ph::SimplexList& simplices) : vertices_(vertices) {
    for (std::size_t i = 0; i < simplices.size(); ++i) {
      const auto simplex = simplices.simplex(i);
      values_[{simplex.begin(), simplex.end()}] = simplices.values[i];
    }
  }
  ph::Index vertex_count() const { return vertices_; }
  double simplex_value(std::span<const ph::Index> vertices) const {
    const auto found = values_.find({vertices.begin(), vertices.end()});
    return found == values_.end() ? std::numeric_limits<double>::infinity() : found->second;
  }

 private:
  ph::Index vertices_;
  std::map<std::vector<ph::Index>, double> values_;
};

/// The Rips filtration of any metric, evaluated simplex by simplex.
template <ph::Metric M>
class Diameters : public ph::SimplexFiltration<Diameters<M>, 3> {
 public:
  explicit Diameters(M metric) : metric_(std::move(metric)) {}
  ph::Index vertex_count() const { return metric_.size(); }
  double simplex_value(std::span<const ph::Index> vertices) const {
    double diameter = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        diameter = std::max<double>(diameter, metric_(vertices[i], vertices[j]));
    return diameter;
  }

 private:
  M metric_;
};

/// The cells of another complex, each named by its number.
class Numbered : public ph::CellFiltration<Numbered, 4> {
 public:
  explicit Numbered(const ph::ExplicitComplex& cells) : cells_(cells) {}
  double value(Cell cell) const { return cells_.value(theirs(cell)); }
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    cells_.for_each_cell(dim, [&](auto cell) { visit(Cell{cell.id}); });
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit&& visit) const {
    cells_.for_each_facet(dim, theirs(cell),
                          [&](auto facet, int incidence) { visit(Cell{facet.id}, incidence); });
  }

 private:
  static ph::ExplicitComplex::Cell theirs(Cell cell) { return {static_cast<std::uint32_t>(cell)}; }
  const ph::ExplicitComplex& cells_;
};
