// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "libph/src/alpha/pairs/alpha_bars.hpp"
#include "libph/src/alpha/pairs/column_store.hpp"
#include "libph/src/alpha/pairs/critical_simplices.hpp"
#include "libph/src/alpha/pairs/edge_column.hpp"
#include "libph/src/alpha/pairs/edge_forest.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::alpha {

/// Computes H1 in dimension 3 by reducing the boundaries of the triangles that union-find has not
/// paired. Columns are reduced in the order of their place in space instead of their age, because
/// the columns that are added to a column are then near it in memory. If a column reaches the pivot
/// of a younger column, it takes over that pivot, and the younger column is reduced further
/// (Morozov & Nigmetov, Towards lockfree persistent homology, 2020). As in the standard algorithm,
/// only older columns are added to younger columns.
///
/// In a periodic space, each boundary that is reduced to zero gives birth to an essential class of
/// H2, and each edge that stays unpaired gives birth to an essential class of H1.
template <Field K>
class Loops {
  using Term = typename EdgeColumn<K>::Term;
  using KeptColumn = Column<K>;

 public:
  /// @param joins for each edge: true if the edge is critical and joins components.
  /// @param column_of for each critical facet: its position in the order of the filtration, or
  /// kNone if the facet joins hollows. `joins` and `column_of` must outlive this object.
  Loops(const AlphaCells& cells, const SimplexSet& joins, std::span<const std::uint32_t> column_of,
        const K& field, const RunContext& context)
      : cells_(cells),
        field_(field),
        context_(context),
        joins_(joins),
        column_of_(column_of),
        owners_(cells.edge_states.size(), nullptr, &context.memory),
        essential_(&context.memory) {}

  void run(AlphaBars& bars) {
    // The terms of a reduced column may depend on the order in which threads run, although its
    // pivot does not. If cycles are wanted, one thread therefore reduces all columns.
    const bool in_turn = bars.wants_cycles();
    const std::size_t count = column_of_.size();
    constexpr std::size_t piece = 1 << 12;  // the number of facets that a thread takes at a time
    std::mutex mutex;
    for_each_piece("loops", count, in_turn ? std::max<std::size_t>(count, 1) : piece, context_,
                   [&](std::size_t from, std::size_t to) {
                     Worker& worker = take_worker(mutex);
                     for (std::size_t i = from; i < to; ++i)
                       if (column_of_[i] != kNone)
                         reduce(static_cast<std::uint32_t>(i), column_of_[i], worker);
                     const std::lock_guard lock(mutex);
                     idle_.push_back(&worker);
                   });
    if (bars.wants(1)) report(bars);
    if (bars.wants(2)) report_essential_facets(bars);
  }

 private:
  /// The working column of one thread, and the finished columns that it stores.
  struct Worker {
    Worker(const Loops& loops)
        : chain(loops.cells_, loops.joins_, loops.field_, loops.context_),
          kept(&loops.context_.memory) {}
    EdgeColumn<K> chain;
    ColumnStore<K> kept;
  };
  Worker& take_worker(std::mutex& mutex) {
    const std::lock_guard lock(mutex);
    if (idle_.empty())
      idle_.push_back(workers_.emplace_back(std::make_unique<Worker>(*this)).get());
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  /// Reduces the boundary of a critical facet. @param column the place of the facet in the order of
  /// the filtration.
  void reduce(std::uint32_t facet, std::uint32_t column, Worker& worker) {
    auto& chain = worker.chain;
    chain.assign_boundary(cells_.facets[facet].code);
    while (const std::optional<Term> pivot = chain.take_pivot()) {
      const std::atomic_ref owner(owners_[pivot->cell.edge]);
      const KeptColumn* other = owner.load(std::memory_order_acquire);
      if (other == nullptr || column < other->number()) {  // mutant: alpha-pivot-taken
        const KeptColumn* const kept =
            worker.kept.keep(column, facet, pivot->coefficient(), chain.terms());
        while ((other == nullptr || column < other->number()) &&
               !owner.compare_exchange_weak(other, kept, std::memory_order_acq_rel)) {
        }
        if (other == nullptr) return;
        if (column < other->number()) {  // the reduction continues with the younger facet
          column = other->number();
          facet = other->facet();
        }
      }
      chain.add(
          field_.negate(field_.multiply(pivot->coefficient(), field_.inverse(other->pivot()))),
          other->below());
    }
    const std::lock_guard lock(mutex_);
    essential_.push_back(facet);  // mutant: alpha-essential-facet
  }
  /// For each edge, the critical facet that kills the class born with the edge, or kNone.
  std::pmr::vector<std::uint32_t> killers() const {
    std::pmr::vector<std::uint32_t> facets(owners_.size(), kNone, &context_.memory);
    for (std::size_t e = 0; e < owners_.size(); ++e)
      if (owners_[e] != nullptr) facets[e] = owners_[e]->facet();
    return facets;
  }
  void drop_columns() {
    decltype(owners_)(owners_.get_allocator()).swap(owners_);
    workers_.clear();
  }
  void report(AlphaBars& bars) {
    const std::pmr::vector<std::uint32_t> killer_of = killers();
    if (!bars.wants_cycles()) drop_columns();
    bars.expect(killer_of.size() - static_cast<std::size_t>(std::ranges::count(killer_of, kNone)));
    std::optional<EdgeForest<K>> forest;
    std::pmr::vector<EdgeTerm<K>> cycle(&context_.memory);
    Ticker ticker(context_, {}, killer_of.size());
    for (std::uint32_t e = 0; e < killer_of.size(); ++e) {
      ticker.tick();
      if (killer_of[e] == kNone) {
        if (cells_.is_periodic) report_essential_edge(e, bars);  // mutant: alpha-essential-edge
        continue;
      }
      const CriticalFacet& killer = cells_.facets[killer_of[e]];
      const bool wants_cycle = bars.pair(
          1, cells_.edge_states[e].value, killer.value, [&] { return edge_simplex(cells_, e); },
          [&] { return facet_simplex(cells_, killer.code); });
      if (!wants_cycle) continue;
      if (!forest) forest.emplace(cells_, joins_, field_, context_);
      cycle.clear();
      const KeptColumn* const column = owners_[e];
      const auto scale = field_.inverse(column->pivot());
      cycle.push_back({e, field_.from_int(1)});
      for (const auto& term : column->below())
        cycle.push_back({term.cell, field_.multiply(scale, term.coefficient())});
      forest->close(cycle);
      for (const EdgeTerm<K>& term : cycle)
        bars.add_term(edge_simplex(cells_, term.edge), field_.to_int(term.coefficient));
      bars.finish_cycle(field_.is_zero(field_.from_int(2)));
    }
  }

  void report_essential_edge(std::uint32_t e, AlphaBars& bars) {
    if (cells_.edge_states[e].up != kCritical || joins_[e]) return;
    bars.essential(1, cells_.edge_states[e].value, [&] { return edge_simplex(cells_, e); });
  }
  void report_essential_facets(AlphaBars& bars) {
    std::ranges::sort(essential_);
    for (const std::uint32_t facet : essential_)
      bars.essential(2, cells_.facets[facet].value,
                     [&] { return facet_simplex(cells_, cells_.facets[facet].code); });
  }

  const AlphaCells& cells_;
  const K& field_;
  const RunContext& context_;
  const SimplexSet& joins_;
  const std::span<const std::uint32_t> column_of_;
  // For each edge, the column whose pivot is this edge, or null.
  std::pmr::vector<const KeptColumn*> owners_;
  std::mutex mutex_;
  std::pmr::vector<std::uint32_t> essential_;  // critical facets whose boundaries are reduced to 0
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

}  // namespace ph::alpha
