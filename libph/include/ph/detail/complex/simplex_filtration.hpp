// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// A simplex of up to TopDim + 1 vertices, with its value.
template <int TopDim>
struct ValuedSimplex {
  double value = 0;
  std::array<Index, TopDim + 1> vertices{};  ///< ascending; 0 beyond the dimension

  /// The vertices, if the simplex has dimension `dim`.
  std::span<const Index> span(int dim) const {
    return std::span(vertices).first(static_cast<std::size_t>(dim) + 1);
  }
  friend bool operator==(const ValuedSimplex& a, const ValuedSimplex& b) {
    return a.vertices == b.vertices;
  }
};

namespace detail {
/// @throws Error (bad_data).
[[noreturn]] void refuse_nan(std::span<const Index> simplex);
[[noreturn]] void refuse_late_face(std::span<const Index> face, double face_value,
                                   std::span<const Index> coface, double coface_value);
}  // namespace detail

/// A base class for a filtration of simplices whose values a function computes. It provides all
/// members of Filtration, CofacetFiltration and GraphFiltration. All engines for any filtration
/// therefore run on it. Derived provides two members:
///
///   Index vertex_count() const                                    vertices are 0, 1, …
///   double simplex_value(std::span<const Index> vertices) const   value at which a simplex enters
///
/// The vertices of a simplex are ascending. A simplex of value +infinity never enters, and no
/// simplex may enter before one of its faces. An engine that notices a violation or a NaN throws an
/// Error (bad_data). Several threads may call these members at once.
///
/// Nothing is stored. Listing the facets of a cell of dimension d takes up to d + 1 calls of
/// simplex_value; listing its cofacets takes one call per vertex. Order: (value, dimension,
/// vertices).
/// @tparam TopDim simplices of higher dimensions are left out, which does not change the homology
/// below TopDim.
template <class Derived, int TopDim>
class SimplexFiltration {
  static_assert(TopDim >= 0);

 public:
  using Cell = ValuedSimplex<TopDim>;
  static constexpr bool first_equal_cofacet_is_oldest = true;

  int top_dim() const {
    int dim = 0;
    Cell cell;
    while (dim <= TopDim && !extend(cell, 0, dim, [](const Cell&) { return false; })) ++dim;
    return dim - 1;
  }
  static double value(const Cell& cell) { return cell.value; }
  /// Keys have the same order as values.
  static std::uint64_t key(const Cell& cell) {
    const auto bits = std::bit_cast<std::uint64_t>(cell.value);
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    return (bits & sign) != 0 ? ~bits : bits | sign;
  }
  static bool precedes(const Cell& a, const Cell& b) {
    return a.value != b.value ? a.value < b.value : a.vertices < b.vertices;
  }
  static bool edges_join_vertices() { return true; }
  static CellKind cell_kind() { return CellKind::vertices; }
  static void append_input_cell(int dim, const Cell& cell, std::vector<Index>& numbers) {
    const std::span<const Index> vertices = cell.span(dim);
    numbers.insert(numbers.end(), vertices.begin(), vertices.end());
  }

  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim < 0 || dim > TopDim) return;
    Cell cell;
    extend(cell, 0, dim, [&](const Cell& c) {
      visit(c);
      return true;
    });
  }

  template <class Visit>
  void for_each_facet(int dim, const Cell& cell, Visit&& visit) const {
    if (dim == 0) return;
    for (int gone = 0; gone <= dim; ++gone) {
      Cell facet;
      for (int i = 0, k = 0; i <= dim; ++i)
        if (i != gone) at(facet, k++) = at(cell, i);
      facet.value = value_of(facet, dim - 1);
      check(facet, dim - 1, cell);
      visit(facet, gone % 2 == 0 ? 1 : -1);
    }
  }

  /// The number of the new vertex increases from one cofacet to the next; cofacets of equal value
  /// are therefore visited in the order of the filtration.
  template <class Visit>
  void for_each_cofacet(int dim, const Cell& cell, Visit&& visit) const {
    if (dim >= TopDim) return;
    const Index n = derived().vertex_count();
    int place = 0;  // place of the new vertex
    for (Index v = 0; v < n; ++v) {
      if (place <= dim && at(cell, place) == v) {
        ++place;
        continue;
      }
      Cell cofacet;
      for (int i = 0; i <= dim; ++i) at(cofacet, i < place ? i : i + 1) = at(cell, i);
      at(cofacet, place) = v;
      cofacet.value = value_of(cofacet, dim + 1);
      check(cell, dim, cofacet);
      if (cofacet.value < kNever && !visit(cofacet, place % 2 == 0 ? 1 : -1)) return;
    }
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  const Derived& derived() const { return static_cast<const Derived&>(*this); }
  static Index& at(Cell& cell, int i) { return cell.vertices[static_cast<std::size_t>(i)]; }
  static Index at(const Cell& cell, int i) { return cell.vertices[static_cast<std::size_t>(i)]; }

  /// Visits the simplices of dimension `dim` that begin with the first `count` vertices of a cell,
  /// until `visit` returns false. @return true if `visit` never did.
  template <class Visit>
  bool extend(Cell& cell, int count, int dim, const Visit& visit) const {
    const Index n = derived().vertex_count();
    const Cell face = cell;
    for (Index v = count == 0 ? 0 : at(face, count - 1) + 1; v < n; ++v) {
      at(cell, count) = v;
      cell.value = value_of(cell, count);
      if (count > 0) check(face, count - 1, cell);
      if (cell.value == kNever) continue;
      if (!(count == dim ? visit(cell) : extend(cell, count + 1, dim, visit))) return false;
    }
    cell = face;
    return true;
  }
  /// @throws Error (bad_data) on NaN.
  double value_of(const Cell& cell, int dim) const {
    const double value = derived().simplex_value(cell.span(dim)) + 0.0;  // turns -0 into 0
    if (value != value) detail::refuse_nan(cell.span(dim));
    return value;
  }
  /// @throws Error (bad_data) if a face of dimension `dim` enters after a coface with one vertex
  /// more.
  static void check(const Cell& face, int dim, const Cell& coface) {
    if (face.value > coface.value)
      detail::refuse_late_face(face.span(dim), face.value, coface.span(dim + 1), coface.value);
  }
};

}  // namespace ph

template <int TopDim>
struct std::hash<ph::ValuedSimplex<TopDim>> {
  std::size_t operator()(const ph::ValuedSimplex<TopDim>& simplex) const {
    std::uint64_t mixed = 0;
    for (const ph::Index v : simplex.vertices) {
      mixed = (mixed ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15U;
      mixed ^= mixed >> 32;
    }
    return mixed;
  }
};
