// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace ph {

struct RunContext;

/// A number of the input: a vertex, a grid coordinate, a row. Never negative.
using Index = std::int64_t;

/// What the numbers that name a cell mean to the user who supplied the input.
enum class CellKind {
  vertices,  ///< the vertices of a simplex, ascending: vertex i is input point i
  grid,      ///< doubled grid coordinates, one an axis: 2i is voxel i, 2i+1 spans voxels i and i+1
  row,       ///< the row of an explicit boundary matrix (one number)
};

// THE CONTRACT
// ============
// Data become a filtration, an engine turns a filtration into a barcode. An engine knows nothing of
// a complex but what stands here; a complex knows nothing of engines.
//
// Order. Each filtration owns one strict total order of its cells that refines the value and puts
// faces before cofaces: (key, dimension, index). Engines only ever compare cells of one dimension
// (`precedes`); a pairing depends on nothing else. The order is a function of the input alone, so
// two engines give the same pairs, cell by cell, ties included.
//
// Cells. `Cell` is a small regular value (copied freely, hashed by std::hash) that is unique within
// its dimension. The dimension is always passed beside it. Cells that never enter (a distance above
// the threshold, an infinite voxel) are never visited, neither as cells nor as facets or cofacets.
//
// Chains. A facet comes with its incidence number, an ordinary int. Boundary of boundary is zero
// over the integers, or at least over the field in use. A facet is visited at most once a cell.

// clang-format off

/// A filtered complex, lazy or stored, as far as the oracle and the homology engine need it.
template <class F>
concept Filtration =
    std::regular<typename F::Cell> &&
    requires(const F& f, int dim, const typename F::Cell& cell, std::vector<Index>& numbers) {
      { std::hash<typename F::Cell>{}(cell) } -> std::convertible_to<std::size_t>;
      /// The largest dimension of a cell; -1 for the empty complex.
      { f.top_dim() } -> std::same_as<int>;
      { f.value(cell) } -> std::convertible_to<double>;
      /// The total order among cells of one dimension.
      { f.precedes(cell, cell) } -> std::same_as<bool>;
      /// Calls `visit(Cell)` for each cell of dimension `dim`, in any order.
      f.for_each_cell(dim, [](const typename F::Cell&) {});
      /// Calls `visit(Cell facet, int incidence)` for each facet of a cell of dimension `dim`.
      f.for_each_facet(dim, cell, [](const typename F::Cell&, int) {});
      { f.cell_kind() } -> std::same_as<CellKind>;
      /// Appends the numbers by which the user knows the cell.
      f.append_input_cell(dim, cell, numbers);
    };

/// A filtration that can also list cofacets: enough for implicit cohomology and for the shortcuts
/// of both engines.
template <class F>
concept CofacetFiltration =
    Filtration<F> && requires(const F& f, int dim, const typename F::Cell& cell) {
      /// The first part of the order, shared by all dimensions: a face's key is at most its
      /// coface's, and if they are equal, so are the values.
      { f.key(cell) } -> std::unsigned_integral;
      /// Calls `visit(Cell cofacet, int incidence)`, which returns false to stop.
      f.for_each_cofacet(dim, cell, [](const typename F::Cell&, int) { return true; });
      /// Capability: among the cofacets with the cell's own key the first visited precedes the
      /// others. `false` is always safe and costs speed. A wrong `true` gives wrong barcodes.
      { F::first_equal_cofacet_is_oldest } -> std::convertible_to<bool>;
    };

/// Capability: knows its apparent pairs (ph/detail/reduction/apparent_pairs.hpp) without going
/// through facets and cofacets. They must be the ones that a search of all facets and cofacets
/// finds.
template <class F>
concept ApparentFiltration =
    CofacetFiltration<F> && requires(const F& f, int dim, const typename F::Cell& cell) {
      /// The cofacet, or facet, with which a cell of dimension `dim` is an apparent pair.
      { f.apparent_cofacet(dim, cell) } -> std::same_as<std::optional<typename F::Cell>>;
      { f.apparent_facet(dim, cell) } -> std::same_as<std::optional<typename F::Cell>>;
      /// The cells of dimension >= 1 come in that many groups; a cell of a group precedes those of
      /// later groups.
      { f.group_count() } -> std::convertible_to<std::size_t>;
      /// The cells of dimension `dim` >= 1 in no apparent pair: `for_each(first, last, visit, on_step)`
      /// of it calls `visit(Cell)` for those in the groups first … last - 1, youngest first, and
      /// `on_step()` now and then. Fastest if ranges descend from call to call.
      f.unmatched_cells(dim).for_each(std::size_t{}, std::size_t{},
                                      [](const typename F::Cell&) {}, [] {});
    };

/// Capability: the cells are numbered densely, so that an engine may use arrays in place of hash
/// tables. `slot` is below `slot_count()` and unique within a dimension.
template <class F>
concept SlottedFiltration = Filtration<F> && requires(const F& f, const typename F::Cell& cell) {
  { f.slot_count() } -> std::convertible_to<std::size_t>;
  { f.slot(cell) } -> std::convertible_to<std::size_t>;
};

/// Capability: something is made when a cell, facet or value is first asked for, which takes time and
/// memory. A function that has a context of its own has it made beforehand, by prepare_cells.
template <class F>
concept LazyFiltration = Filtration<F> && requires(const F& f, const RunContext& context) {
  /// Makes it unless that has been done. Stopped, watched and bounded by `context`, which need not
  /// outlive the filtration.
  f.prepare(context);
};

/// Capability: each 1-cell has the boundary (vertex) - (other vertex), or none at all (a loop).
/// Union-find computes H0 then. A property of the data for complexes read from files.
template <class F>
concept GraphFiltration = Filtration<F> && requires(const F& f) {
  { f.edges_join_vertices() } -> std::same_as<bool>;
};

// clang-format on

/// Makes what a lazy filtration needs for its cells. Whoever lists cells calls it first.
/// @throws Error (resource) and (cancelled), of that context.
template <Filtration F>
void prepare_cells(const F& filtration, const RunContext& context) {
  if constexpr (LazyFiltration<F>) filtration.prepare(context);
}

}  // namespace ph
