// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ph/filtration.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// Simplices in any order, each with its value: simplex i has the vertices
/// vertices[offsets[i] … offsets[i+1]).
struct SimplexList {
  std::vector<Index> vertices;
  std::vector<std::size_t> offsets{0};
  std::vector<double> values;

  std::size_t size() const { return offsets.empty() ? 0 : offsets.size() - 1; }
  /// @throws Error (bad_data) unless the offsets ascend from 0 to the number of vertices.
  void check_layout() const;
  std::span<const Index> simplex(std::size_t i) const {
    return std::span(vertices).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  void add(std::span<const Index> simplex_vertices, double value) {
    vertices.insert(vertices.end(), simplex_vertices.begin(), simplex_vertices.end());
    offsets.push_back(vertices.size());
    values.push_back(value);
  }
};

/// A boundary matrix, stored by columns: column i is cell i of dimension dims[i], with the facets
/// rows[offsets[i] … offsets[i+1]) and their incidence numbers at the same positions of
/// `incidences`.
struct BoundaryMatrix {
  std::vector<int> dims;
  std::vector<std::size_t> offsets{0};
  std::vector<Index> rows;
  std::vector<int> incidences;  ///< if empty, all are 1, which is meaningful only over Z/2
  std::vector<double> values;   ///< if empty, a cell's value is its position in the order

  std::size_t size() const { return dims.size(); }
};

/// Names a cell of the input in an error message ("mesh.txt:12"); by default, the message gives the
/// cell's position.
using CellNamer = std::function<std::string(std::size_t)>;

/// A filtered complex stored cell by cell, with facets and cofacets. A cell of value +infinity
/// never enters: it is checked for mistakes and then left out. Order: (value, dimension, position
/// in the input).
class ExplicitComplex {
 public:
  struct Cell {
    std::uint32_t id = 0;  ///< position in the total order
    friend auto operator<=>(const Cell&, const Cell&) = default;
  };
  static constexpr bool first_equal_cofacet_is_oldest = true;

  /// @throws Error (bad_data) if a simplex occurs twice, repeats a vertex, lacks a facet, enters
  ///         before one of its facets or has a NaN value; also if the sizes of the arrays disagree.
  static ExplicitComplex from_simplices(SimplexList simplices, const CellNamer& name = {},
                                        const RunContext& context = default_context());
  /// @throws Error (bad_data) if a facet is out of range, is not exactly one dimension lower or
  ///         enters after its coface; also if the sizes of the arrays disagree, a value is NaN, or
  ///         the boundary of a boundary is not zero (over the integers, or over Z/2 without
  ///         incidences).
  static ExplicitComplex from_boundary(const BoundaryMatrix& matrix, const CellNamer& name = {},
                                       const RunContext& context = default_context());

  /// The largest value that bars and merge trees take into account, inclusive: `persistence`, `run`
  /// and `merge_tree` use the subcomplex of all cells with values up to it. All cells stay listed;
  /// therefore the choice of an engine and the cells of the bars do not depend on the threshold.
  /// @throws Error (usage) on a NaN.
  void set_threshold(double largest);
  /// The threshold that was set; empty if all cells count.
  std::optional<double> threshold() const { return threshold_; }

  /// True if incidence numbers are known; without them, only coefficients in Z/2 are meaningful.
  bool has_incidences() const { return has_incidences_; }
  /// Number of cells that enter.
  std::size_t size() const { return input_position_.size(); }
  /// Number of vertices of the input, including vertices that never enter.
  std::size_t vertex_count() const { return vertices_.size(); }
  /// The place of a vertex among all vertices, in the order of the input.
  std::size_t vertex_number(Cell vertex) const;

  int top_dim() const { return static_cast<int>(first_of_dim_.size()) - 2; }
  double value(Cell c) const { return values_[key_[c.id]]; }
  std::uint32_t key(Cell c) const { return key_[c.id]; }
  static bool precedes(Cell a, Cell b) { return a.id < b.id; }
  std::size_t slot_count() const { return size(); }
  static std::size_t slot(Cell c) { return c.id; }
  bool edges_join_vertices() const { return edges_join_vertices_; }
  CellKind cell_kind() const { return kind_; }
  void append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const;

  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim < 0 || dim > top_dim()) return;
    const auto d = static_cast<std::size_t>(dim);
    for (std::size_t i = first_of_dim_[d]; i < first_of_dim_[d + 1]; ++i) visit(Cell{of_dim_[i]});
  }
  template <class Visit>
  void for_each_facet(int, Cell cell, Visit&& visit) const {
    for (std::size_t i = facets_.offsets[cell.id]; i < facets_.offsets[cell.id + 1]; ++i)
      visit(Cell{facets_.cells[i]}, int{facets_.incidences[i]});
  }
  template <class Visit>
  void for_each_cofacet(int, Cell cell, Visit&& visit) const {
    for (std::size_t i = cofacets_.offsets[cell.id]; i < cofacets_.offsets[cell.id + 1]; ++i)
      if (!visit(Cell{cofacets_.cells[i]}, int{cofacets_.incidences[i]})) return;
  }

 private:
  struct Incidence {  // compressed rows: neighbours of cell i in ascending order
    explicit Incidence(std::pmr::memory_resource* memory)
        : offsets(memory), cells(memory), incidences(memory) {}
    std::pmr::vector<std::size_t> offsets;
    std::pmr::vector<std::uint32_t> cells;
    std::pmr::vector<int> incidences;
  };
  explicit ExplicitComplex(std::pmr::memory_resource* memory)
      : values_(memory),
        key_(memory),
        input_position_(memory),
        id_of_(memory),
        vertices_(memory),
        first_of_dim_(memory),
        of_dim_(memory),
        facets_(memory),
        cofacets_(memory) {}
  void order_cells(const std::vector<int>& dims, std::span<const double> values);
  void build_cofacets();
  void check(const std::vector<int>& dims, const CellNamer& name);
  void leave_out_what_never_enters();
  void sort_by_dimension(const std::vector<int>& dims);

  CellKind kind_ = CellKind::row;
  std::optional<double> threshold_;
  bool has_incidences_ = true;
  bool edges_join_vertices_ = true;
  std::pmr::vector<double> values_;                 // distinct values, ascending
  std::pmr::vector<std::uint32_t> key_;             // by id: index into values_
  std::pmr::vector<std::uint32_t> input_position_;  // by id: the cell's position in the input
  std::pmr::vector<std::uint32_t> id_of_;           // the inverse, for all cells of the input
  // Positions of the vertices in the input, ascending.
  std::pmr::vector<std::uint32_t> vertices_;
  std::pmr::vector<std::size_t> first_of_dim_;  // ranges in of_dim_
  std::pmr::vector<std::uint32_t> of_dim_;      // ids sorted by dimension, then input position
  Incidence facets_, cofacets_;
  SimplexList simplices_;  // for kind `vertices`: the simplices of the input, vertices ascending
  std::shared_ptr<const MemoryClaim> simplices_claim_;
};

/// The lower-star filtration: a simplex enters with the last of its vertices. The simplices may be
/// given without their faces (the triangles of a mesh, for example); missing faces are added. The
/// values of the list are ignored.
/// @param vertex_values a value for each vertex id 0 … size-1, not NaN; a vertex of value +infinity
/// never enters.
/// @throws Error (bad_data) on a vertex id without a value, a NaN or a vertex that occurs twice in
///         a simplex, or if sizes disagree; Error (resource) on a simplex of more than 24 vertices.
ExplicitComplex lower_star(const SimplexList& simplices, std::span<const double> vertex_values,
                           const CellNamer& name = {},
                           const RunContext& context = default_context());

/// The lower-star filtration of a graph on vertices 0 … size-1.
ExplicitComplex lower_star(std::span<const WeightedEdge> edges,
                           std::span<const double> vertex_values,
                           const RunContext& context = default_context());

}  // namespace ph

template <>
struct std::hash<ph::ExplicitComplex::Cell> {
  std::size_t operator()(ph::ExplicitComplex::Cell c) const { return c.id; }
};
