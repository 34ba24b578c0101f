// SPDX-License-Identifier: MIT
#pragma once
// For a complex or an engine of your own: base classes for complexes, and the engines for any
// filtration, as templates. This header is slow to compile; persistence.hpp is enough for programs
// that use only the complexes of libph.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ph/detail/complex/cell_filtration.hpp"
#include "ph/detail/complex/simplex_filtration.hpp"
#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/facade/generic_engines.hpp"
#include "ph/error.hpp"
#include "ph/estimate.hpp"

namespace ph {

// A COMPLEX is a type that models Filtration (ph/filtration.hpp). With the base SimplexFiltration
// you write two members: the number of vertices, and the value at which a simplex enters. With the
// base CellFiltration you write three: the value at which a cell enters, a list of all cells, and
// the facets of a cell. docs/how-to/own-complex.md has programs.

/// The barcode of a complex of your own: any type that models Filtration. @throws as the other
/// overloads.
template <Filtration F>
Barcode persistence(const F& filtration, const Options& options = {},
                    const RunContext& context = default_context()) {
  return detail::compute(filtration, options, context);
}

/// The plan that `persistence` will follow. @throws as `persistence`.
template <Filtration F>
RunPlan plan(const F& filtration, const Options& options = {}) {
  const auto [max_dim, choice] = detail::plan_for(filtration, options);
  return detail::run_plan(options, max_dim, choice.engine->id, choice.reason);
}

/// The complex, listed cell by cell, for everything that takes an ExplicitComplex: estimates, merge
/// trees, loops, the programs. Cells that the complex names by their vertices keep these names;
/// other cells are named by their position: cells are counted dimension by dimension, in the order
/// of the complex.
/// @throws Error (bad_data) if the complex breaks the contract; Error (resource) on lack of memory.
template <Filtration F>
ExplicitComplex listed(const F& filtration, const RunContext& context = default_context());

// AN ENGINE is a struct whose static members describe it:
//
//   id                     its name: static constexpr ph::Engine id{"my-engine"}
//   can_run(f, task)       true if it can do the task; false for complexes that it does not support
//   suitability(f, task)   how well it suits the task, if it can run: the best engine is chosen
//   listed_dim(max_dim)    the highest dimension whose cells it lists; -1 if it lists none
//   run(f, field, bars, context)   computes: reports each pair and each essential class to `bars`
//
// Further members are needed only where they differ from false or null: goes_by_edges, stops_early,
// is_oracle, rips_bytes(vertices, edges), rips_forms, obstacle(input, task) and suitability(input,
// task). EngineFacts explains them. can_run, suitability and run are templates of the filtration.
// detail/reduction/twist.hpp is a short example.

/// Adds an engine of your own to all complexes of libph except Alpha, until the program ends:
/// Options can name it, `engine_names` lists it, and it is chosen where it suits best. Add engines
/// before other threads compute. @throws Error (usage) if its name is taken.
template <class E>
void add_engine();
/// Adds an engine to a complex of your own, which otherwise has the engines for any filtration.
/// Call `add_engine` first.
template <class E, Filtration F>
void add_engine_for();

namespace detail {
/// @throws Error (usage) if an engine of that name exists.
void add_facts(const EngineFacts& facts);
}  // namespace detail

template <Filtration F>
ExplicitComplex listed(const F& filtration, const RunContext& context) {
  using Cell = typename F::Cell;
  const auto precedes = [&](const Cell& a, const Cell& b) { return filtration.precedes(a, b); };
  SimplexList simplices;
  BoundaryMatrix matrix;
  std::vector<Index> numbers;
  std::vector<Cell> lower, cells;
  prepare_cells(filtration, context);
  for (int dim = 0; dim <= filtration.top_dim(); ++dim) {
    const auto first_lower = static_cast<Index>(matrix.size() - lower.size());
    cells.clear();
    filtration.for_each_cell(dim, [&](const Cell& cell) { cells.push_back(cell); });
    std::sort(cells.begin(), cells.end(), precedes);
    for (const Cell& cell : cells) {
      if (filtration.cell_kind() == CellKind::vertices) {
        numbers.clear();
        filtration.append_input_cell(dim, cell, numbers);
        simplices.add(numbers, filtration.value(cell));
        continue;
      }
      filtration.for_each_facet(dim, cell, [&](const Cell& facet, int incidence) {
        const auto place = std::lower_bound(lower.begin(), lower.end(), facet, precedes);
        matrix.rows.push_back(first_lower + (place - lower.begin()));
        matrix.incidences.push_back(incidence);
      });
      matrix.dims.push_back(dim);
      matrix.offsets.push_back(matrix.rows.size());
      matrix.values.push_back(filtration.value(cell));
    }
    std::swap(lower, cells);
  }
  if (filtration.cell_kind() == CellKind::vertices)
    return ExplicitComplex::from_simplices(std::move(simplices), {}, context);
  return ExplicitComplex::from_boundary(matrix, {}, context);
}

template <class E, Filtration F>
void add_engine_for() {
  auto& list = detail::engines<F>();
  if (std::ranges::find(list, E::id, &EngineFacts::id) == list.end())
    list.push_back(detail::engine_for<E, F>());
}

template <class E>
void add_engine() {
  detail::add_facts(detail::facts<E>());
  add_engine_for<E, Cubical>();
  add_engine_for<E, ExplicitComplex>();
  add_engine_for<E, FilteredGraph>();
  add_engine_for<E, RipsFiltration<RipsLayout::dense, 1>>();
  add_engine_for<E, RipsFiltration<RipsLayout::sparse, 1>>();
  add_engine_for<E, RipsFiltration<RipsLayout::any, 4>>();
}

}  // namespace ph
