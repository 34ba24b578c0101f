// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "libph/src/cubical/columns/boundary_column.hpp"
#include "libph/src/cubical/columns/parallel_reduction.hpp"
#include "libph/src/cubical/sinks/cell_sink.hpp"
#include "ph/detail/core/flat_map.hpp"

namespace ph::cubical {

/// Computes homology in a dimension between the lowest and the highest. It reduces the boundaries
/// of the cells of one dimension with ParallelReduction.
template <Field K>
class BoundaryReduction {
  using Chain = BoundaryColumn<K>;
  using Reduction = ParallelReduction<K, Chain>;
  using Column = typename Reduction::Column;

 public:
  using Name = CellGrid::Name;

  /// @param columns the cells whose boundaries are reduced, in the order of the filtration. They
  /// are in no known pair.
  /// @param rows the cells one dimension lower that are in no known pair.
  BoundaryReduction(const CellGrid& grid, std::span<const Name> columns, std::span<const Name> rows,
                    const K& field, const RunContext& context)
      : grid_(grid),
        names_(columns),
        field_(field),
        context_(context),
        owners_(&context.memory),
        reduction_(columns.size(), field, context) {
    enter_rows(rows);
  }

  /// @param on_pair called with (column, row of its pivot), or (column, nothing) if the column is
  /// reduced to zero.
  template <class OnPair>
  void run(OnPair&& on_pair) {
    constexpr std::size_t piece = 64;  // the number of columns that a thread takes at a time
    reduction_.run(
        "boundaries", piece, [&] { return Chain(grid_, field_, context_); },
        [&](Chain& column, std::uint32_t i) { column.assign_boundary(CellGrid::cell(names_[i])); },
        [&](Name pivot) -> const Column*& { return owner_of(pivot); },
        [&](Name pivot) { owners_.prefetch(CellGrid::cell(pivot)); },
        [](std::span<std::uint32_t>) {});
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Column* const column = reduction_.columns()[i];
      on_pair(names_[i], column ? std::optional<Name>(column->pivot().cell) : std::nullopt);
    }
  }
  /// True if a row is a pivot. Precondition: `run` has been called.
  bool is_pivot(Name row) { return owner_of(row) != nullptr; }

 private:
  void enter_rows(std::span<const Name> rows) {
    owners_.reserve(rows.size());
    Ticker ticker(context_, "rows", rows.size());
    for (const Name name : rows) {
      owners_.try_emplace(CellGrid::cell(name));
      ticker.tick();
    }
  }
  // The entry for the column whose pivot is this row. Precondition: `row` is a row of the matrix.
  const Column*& owner_of(Name row) { return *owners_.find(CellGrid::cell(row)); }

  const CellGrid& grid_;
  std::span<const Name> names_;  // the names of the columns
  const K& field_;
  const RunContext& context_;
  FlatMap<const Column*> owners_;  // indexed by row; null if the row is not a pivot
  Reduction reduction_;
};

}  // namespace ph::cubical
