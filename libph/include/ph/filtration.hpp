// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ph/detail/core/names.hpp"

namespace ph {

struct RunContext;

/// A number from the input: a vertex, a grid coordinate, a row. Never negative.
using Index = std::int64_t;

/// The meaning of the numbers that name a cell to the user who supplied the input.
enum class CellKind {
  vertices,  ///< the vertices of a simplex, ascending: vertex i is input point i
  /// Doubled grid coordinates, one per axis. If voxels are vertices (V), 2i is voxel i, and 2i+1
  /// spans voxels i and i+1. If voxels are top cubes (T), 2i+1 is voxel i, and 2i is the face
  /// before it.
  grid,
  row,  ///< the row of an explicit boundary matrix (one number)
};

template <>
inline constexpr std::array names_of<CellKind>{
    Named{CellKind::vertices, "vertices"},
    Named{CellKind::grid, "grid"},
    Named{CellKind::row, "row"},
};

// THE CONTRACT ============ Data become a filtration, and an engine turns a filtration into a
// barcode. An engine relies only on this contract, and a complex knows nothing about engines.
//
// Order. Each filtration owns one strict total order of its cells that refines the value and puts
// faces before cofaces: (key, dimension, index). Engines only ever compare cells of one dimension
// (`precedes`); a pairing depends on nothing else. The order is a function of the input alone;
// therefore two engines give the same pairs, cell by cell, including ties.
//
// Cells. `Cell` is a small regular value (copied freely, hashed by std::hash) that is unique within
// its dimension. The dimension is always passed with it. Cells that never enter (a distance above
// the threshold, an infinite voxel) are never visited, neither as cells nor as facets or cofacets.
//
// Chains. A facet is passed with its incidence number, an ordinary int. The boundary of a boundary
// is zero over the integers, or at least over the field in use. A facet is visited at most once per
// cell.

// clang-format off

/// A filtered complex, lazy or stored, with the members that the oracle (Engine::standard) and the
/// homology engine need.
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
      /// Appends the numbers that name the cell to the user.
      f.append_input_cell(dim, cell, numbers);
    };

/// A filtration that can also list cofacets: enough for implicit cohomology and for the shortcuts
/// of homology and cohomology.
template <class F>
concept CofacetFiltration =
    Filtration<F> && requires(const F& f, int dim, const typename F::Cell& cell) {
      /// The first part of the order, shared by all dimensions: a face's key is at most its
      /// coface's key; equal keys mean equal values.
      { f.key(cell) } -> std::unsigned_integral;
      /// Calls `visit(Cell cofacet, int incidence)` for each cofacet; `visit` returns false to
      /// stop.
      f.for_each_cofacet(dim, cell, [](const typename F::Cell&, int) { return true; });
      /// Capability: the first visited cofacet with the cell's own key precedes all others with
      /// that key. `false` is always safe, but slower; a wrong `true` gives wrong barcodes.
      { F::first_equal_cofacet_is_oldest } -> std::convertible_to<bool>;
    };

/// Capability: the filtration knows its apparent pairs (ph/detail/reduction/apparent_pairs.hpp)
/// without a search through facets and cofacets. The pairs must be the same as the pairs that such
/// a search finds.
template <class F>
concept ApparentFiltration =
    CofacetFiltration<F> && requires(const F& f, int dim, const typename F::Cell& cell) {
      /// The cofacet, or facet, that forms an apparent pair with a cell of dimension `dim`.
      { f.apparent_cofacet(dim, cell) } -> std::same_as<std::optional<typename F::Cell>>;
      { f.apparent_facet(dim, cell) } -> std::same_as<std::optional<typename F::Cell>>;
      /// The number of groups of the cells of dimension >= 1; a cell of a group precedes the cells
      /// of later groups.
      { f.group_count() } -> std::convertible_to<std::size_t>;
      /// The cells of dimension `dim` >= 1 that are in no apparent pair. The member
      /// `for_each(first, last, visit, on_step)` of the result calls `visit(Cell)` for such cells
      /// in the groups first … last - 1, youngest first, and calls `on_step()` now and then. The
      /// calls are fastest if the ranges of groups descend from call to call.
      f.unmatched_cells(dim).for_each(std::size_t{}, std::size_t{},
                                      [](const typename F::Cell&) {}, [] {});
    };

/// Capability: the cells are numbered densely, which lets an engine use arrays instead of hash
/// tables. `slot` is below `slot_count()` and unique within a dimension.
template <class F>
concept SlottedFiltration = Filtration<F> && requires(const F& f, const typename F::Cell& cell) {
  { f.slot_count() } -> std::convertible_to<std::size_t>;
  { f.slot(cell) } -> std::convertible_to<std::size_t>;
};

/// Capability: some data are made when a cell, facet or value is first requested, which takes time
/// and memory. A function that has its own context calls prepare_cells first, which makes the data
/// within the limits of that context.
template <class F>
concept LazyFiltration = Filtration<F> && requires(const F& f, const RunContext& context) {
  /// Makes these data, unless they exist. `context` limits the work, receives its progress and can
  /// stop it; it need not outlive the filtration.
  f.prepare(context);
};

/// Capability: each 1-cell has the boundary (vertex) - (other vertex), or none at all (a loop).
/// Union-find can then compute H0. For complexes read from files, this depends on the data.
template <class F>
concept GraphFiltration = Filtration<F> && requires(const F& f) {
  { f.edges_join_vertices() } -> std::same_as<bool>;
};

// clang-format on

/// Makes the data from which a lazy filtration lists its cells. Call it before listing cells.
/// @throws Error (resource) beyond the memory limit of `context`; Error (cancelled) on a stop
/// request.
template <Filtration F>
void prepare_cells(const F& filtration, const RunContext& context) {
  if constexpr (LazyFiltration<F>) filtration.prepare(context);
}

}  // namespace ph
