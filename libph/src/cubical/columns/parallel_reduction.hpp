// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ph/detail/core/field.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {

/// The age of columns that are numbered from old to young.
struct NumberedByAge {
  static bool is_older(std::uint32_t a, std::uint32_t b) { return a < b; }
};

/// Reduces the columns of a boundary matrix by adding only older columns. Several threads reduce
/// columns at the same time. An older column may take a pivot from a younger column, which is then
/// reduced further in the next round (Morozov & Nigmetov, Towards lockfree persistent homology,
/// 2020). The pairs do not depend on the order in which threads run. Each step of a column reads
/// memory at random places. A thread therefore alternates between several columns, and prefetches
/// the data for the next step of each column.
/// @tparam Chain a working column, such as BoundaryColumn. If Chain has `settle(pivot)`, it is
/// called before a chain is kept, and returns the pivot.
/// @tparam Ages `is_older(a, b)`: true if column a is older than column b, given their numbers.
template <Field K, class Chain, class Ages = NumberedByAge>
class ParallelReduction {
 public:
  using Term = typename Chain::Term;
  /// A reduced column, which is the boundary of a cell plus the boundaries that were added to it.
  /// Cells older than the pivot need not have been expanded. The terms below the pivot follow the
  /// object in memory, because reading the pivot then also loads them.
  class Column {
   public:
    Column(const Term& pivot, std::uint32_t number, std::uint32_t size)
        : pivot_(pivot), number_(number), size_(size) {}
    const Term& pivot() const { return pivot_; }
    std::uint32_t number() const { return number_; }
    std::span<const Term> below() const { return {reinterpret_cast<const Term*>(this + 1), size_}; }

   private:
    Term pivot_;
    std::uint32_t number_, size_;
  };

  static constexpr std::size_t kLanes = 8;

  /// @param size the number of columns.
  /// @param lanes the number of columns between which a thread alternates. With one lane and one
  /// piece, the reduced columns equal the columns of the standard algorithm.
  ParallelReduction(std::size_t size, const K& field, const RunContext& context,
                    std::size_t lanes = kLanes, const Ages& ages = {})
      : field_(field),
        context_(context),
        lanes_(lanes),
        ages_(ages),
        columns_(size, nullptr, &context.memory) {}

  /// Adds `by` columns.
  void grow(std::size_t by) { columns_.resize(columns_.size() + by, nullptr); }

  /// Reduces all columns in the order of their numbers.
  /// @param piece the number of columns that a thread takes at a time.
  /// @param make_chain makes a working column.
  /// @param assign_boundary called with (chain, column): makes the chain the boundary of the
  /// column's cell.
  /// @param owner_of called with the cell of a pivot: returns the entry for the column with this
  /// pivot, which is null at first.
  /// @param expect_owner called with the same cell some time before `owner_of`; it may prefetch the
  /// entry.
  /// @param arrange called with the columns of a round, which it may reorder.
  template <class MakeChain, class AssignBoundary, class OwnerOf, class ExpectOwner, class Arrange>
  void run(std::string_view stage, std::size_t piece, MakeChain&& make_chain,
           AssignBoundary&& assign_boundary, OwnerOf&& owner_of, ExpectOwner&& expect_owner,
           Arrange&& arrange) {
    std::pmr::vector<std::uint32_t> round(columns_.size(), &context_.memory);
    std::iota(round.begin(), round.end(), 0U);
    run_some(std::move(round), stage, piece, make_chain, assign_boundary, owner_of, expect_owner,
             arrange,
             [](std::uint32_t, const std::optional<Term>& pivot, Chain&) { return !pivot; });
  }
  /// Reduces the columns in `round`.
  /// @param is_done called with (column, pivot, chain) after each search for a pivot. It returns
  /// true if this reduction need not continue with the column, because the column is zero or moves
  /// to another part. `is_done` may look for further pivots.
  template <class MakeChain, class AssignBoundary, class OwnerOf, class ExpectOwner, class Arrange,
            class IsDone>
  void run_some(std::pmr::vector<std::uint32_t> round, std::string_view stage, std::size_t piece,
                MakeChain&& make_chain, AssignBoundary&& assign_boundary, OwnerOf&& owner_of,
                ExpectOwner&& expect_owner, Arrange&& arrange, IsDone&& is_done) {
    const auto take_pivot = [&](Lane& lane) {
      lane.pivot = lane.chain.take_pivot();
      if (is_done(lane.column, lane.pivot, lane.chain)) return false;
      return expect(lane, expect_owner);
    };
    const auto begin_with = [&](Lane& lane, std::uint32_t i) {
      lane.column = i;
      const Column* const own = std::exchange(columns_[i], nullptr);
      if (own == nullptr) {
        assign_boundary(lane.chain, i);
        return take_pivot(lane);
      }
      lane.chain.assign(own->below());
      lane.pivot = own->pivot();
      return expect(lane, expect_owner);
    };
    while (!round.empty()) {
      arrange(std::span(round));
      for_each_piece(stage, round.size(), piece, context_, [&](std::size_t begin, std::size_t end) {
        Worker& worker = take_worker(make_chain);
        for (bool is_busy = true; is_busy;) {
          is_busy = false;
          for (Lane& lane : worker.lanes) {
            if (lane.is_busy) lane.is_busy = advance(lane, worker, owner_of, take_pivot);
            while (!lane.is_busy && begin < end) lane.is_busy = begin_with(lane, round[begin++]);
            is_busy = is_busy || lane.is_busy;
          }
        }
        const std::lock_guard lock(mutex_);
        idle_.push_back(&worker);
      });
      round.clear();
      for (const auto& worker : workers_) {
        round.insert(round.end(), worker->again.begin(), worker->again.end());
        worker->again.clear();
      }
      std::ranges::sort(round, [&](auto a, auto b) { return ages_.is_older(a, b); });
    }
  }

  /// The columns after the reduction; null if a column is zero.
  std::span<const Column* const> columns() const { return columns_; }

 private:
  // A column under reduction.
  struct Lane {
    Chain chain;
    bool is_busy = false;
    std::uint32_t column = 0;
    std::optional<Term> pivot{};
    enum class Step : std::uint8_t { find_owner, read_owner, use_owner } next{};
    const Column** owner = nullptr;  // the entry for the column that has the pivot
    const Column* older = nullptr;   // the column that has the pivot
  };

  // The data of one thread. Other threads read its finished columns, which therefore do not move.
  struct Worker {
    using Unit = std::uint64_t;
    static_assert(alignof(Column) <= alignof(Unit) && sizeof(Column) % sizeof(Unit) == 0 &&
                  sizeof(Term) % sizeof(Unit) == 0 && std::is_trivially_copyable_v<Term>);

    std::vector<Lane> lanes{};
    std::vector<std::pmr::vector<Unit>> kept{};
    std::vector<std::uint32_t> again{};  // the columns that lost their pivots

    const Column* keep(const Term& pivot, std::uint32_t number, std::span<const Term> below,
                       std::pmr::memory_resource* memory) {
      constexpr std::size_t least = 1 << 10, most = 1 << 15;
      const std::size_t block = kept.empty() ? least : std::min(2 * kept.back().capacity(), most);
      const std::size_t units = (sizeof(Column) + below.size_bytes()) / sizeof(Unit);
      if (kept.empty() || kept.back().capacity() - kept.back().size() < units)
        kept.emplace_back(memory).reserve(std::max(block, units));
      auto& into = kept.back();
      into.resize(into.size() + units);
      auto* const column = new (into.data() + into.size() - units)
          Column(pivot, number, static_cast<std::uint32_t>(below.size()));
      std::uninitialized_copy(below.begin(), below.end(), reinterpret_cast<Term*>(column + 1));
      return column;
    }
  };
  template <class MakeChain>
  Worker& take_worker(MakeChain&& make_chain) {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      workers_.push_back(std::make_unique<Worker>());
      for (std::size_t i = 0; i < lanes_; ++i) workers_.back()->lanes.push_back({make_chain()});
      return *workers_.back();
    }
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  // Prefetches the data for the next step, which looks up the column that has the pivot.
  template <class ExpectOwner>
  static bool expect(Lane& lane, ExpectOwner&& expect_owner) {
    expect_owner(lane.pivot->cell);
    lane.next = Lane::Step::find_owner;
    return true;
  }
  // Does the next step of a column. @return true if more steps follow.
  template <class OwnerOf, class TakePivot>
  bool advance(Lane& lane, Worker& worker, OwnerOf&& owner_of, TakePivot&& take_pivot) {
    using Step = typename Lane::Step;
    if (lane.next == Step::find_owner) {
      lane.owner = &owner_of(lane.pivot->cell);
      __builtin_prefetch(lane.owner, 1);
      lane.next = Step::read_owner;
      return true;
    }
    if (lane.next == Step::read_owner) {
      lane.older = std::atomic_ref(*lane.owner).load(std::memory_order_acquire);
      if (lane.older != nullptr) __builtin_prefetch(lane.older);
      lane.next = Step::use_owner;
      return true;
    }
    const auto has_older = [&] {
      return lane.older != nullptr && ages_.is_older(lane.older->number(), lane.column);
    };
    if (!has_older()) {
      if constexpr (requires { lane.chain.settle(*lane.pivot); })
        lane.pivot = lane.chain.settle(*lane.pivot);
      const Column* const kept =
          worker.keep(*lane.pivot, lane.column, lane.chain.consolidate(), &context_.memory);
      const std::atomic_ref owner(*lane.owner);
      while (!has_older()) {
        if (!owner.compare_exchange_weak(lane.older, kept, std::memory_order_acq_rel)) continue;
        columns_[lane.column] = kept;
        if (lane.older != nullptr) worker.again.push_back(lane.older->number());
        return false;
      }
      lane.chain.assign(kept->below());  // an older column has taken the pivot in the meantime
    }
    lane.chain.add(
        field_.negate(field_.multiply(lane.pivot->coefficient(),
                                      field_.inverse(lane.older->pivot().coefficient()))),
        lane.older->below());
    return take_pivot(lane);
  }

  const K& field_;
  const RunContext& context_;
  const std::size_t lanes_;
  const Ages ages_;
  std::pmr::vector<const Column*> columns_;
  std::mutex mutex_;  // protects the members below
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

}  // namespace ph::cubical
