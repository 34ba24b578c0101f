// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ph/core/field.hpp"
#include "ph/core/parallel.hpp"

namespace ph::cubical {

/// Columns of a boundary matrix, reduced by adding older ones only. Several threads reduce columns
/// at a time; who has an older column's pivot takes it, and the younger column is reduced further
/// in the next round (Morozov & Nigmetov, Towards lockfree persistent homology, 2020). The pairs do
/// not depend on who comes first, and one thread that goes from old to young never has to take one
/// away.
/// @tparam Chain a working column, such as BoundaryColumn.
template <Field K, class Chain>
class ParallelReduction {
 public:
  using Term = typename Chain::Term;
  /// The boundary of a cell and what was added to it, as far as it was followed.
  struct Column {
    std::optional<Term> pivot;  ///< nothing: it is zero, or was never looked at
    std::span<const Term> below{};
  };
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// @param size columns, from old to young.
  ParallelReduction(std::size_t size, const K& field, const RunContext& context)
      : field_(field), context_(context), columns_(size, &context.memory) {}

  /// @param piece columns that a thread takes at a time.
  /// @param make_chain called for a working column of a thread.
  /// @param assign_boundary called with (chain, column): makes it the boundary of the column's
  /// cell.
  /// @param owner_of called with a pivot's cell: where its column is noted, kNone at first.
  /// @param arrange called with the columns of a round: may bring them into another order.
  template <class MakeChain, class AssignBoundary, class OwnerOf, class Arrange>
  void run(std::string_view stage, std::size_t piece, MakeChain&& make_chain,
           AssignBoundary&& assign_boundary, OwnerOf&& owner_of, Arrange&& arrange) {
    std::pmr::vector<std::uint32_t> round(columns_.size(), &context_.memory);
    std::iota(round.begin(), round.end(), 0U);
    while (!round.empty()) {
      arrange(std::span(round));
      for_each_piece(stage, round.size(), piece, context_, [&](std::size_t begin, std::size_t end) {
        Worker& worker = take_worker(make_chain);
        for (std::size_t i = begin; i < end; ++i)
          reduce(round[i], worker, assign_boundary, owner_of);
        const std::lock_guard lock(mutex_);
        idle_.push_back(&worker);
      });
      round.clear();
      for (const auto& worker : workers_) {
        round.insert(round.end(), worker->again.begin(), worker->again.end());
        worker->again.clear();
      }
      std::ranges::sort(round);
    }
  }

  std::span<const Column> columns() const { return columns_; }

 private:
  // What a thread has to itself. Terms stay where they are: others read them.
  struct Worker {
    Chain chain;
    std::vector<std::pmr::vector<Term>> kept{};
    std::vector<std::uint32_t> again{};  // lost their pivots

    std::span<const Term> keep(std::span<const Term> terms, std::pmr::memory_resource* memory) {
      constexpr std::size_t block = 1 << 14;
      if (kept.empty() || kept.back().capacity() - kept.back().size() < terms.size())
        kept.emplace_back(memory).reserve(std::max(block, terms.size()));
      auto& into = kept.back();
      into.insert(into.end(), terms.begin(), terms.end());
      return std::span<const Term>(into).last(terms.size());
    }
  };
  template <class MakeChain>
  Worker& take_worker(MakeChain&& make_chain) {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      workers_.emplace_back(new Worker{make_chain()});
      return *workers_.back();
    }
    Worker& worker = *idle_.back();
    idle_.pop_back();
    return worker;
  }

  template <class AssignBoundary, class OwnerOf>
  void reduce(std::uint32_t i, Worker& worker, AssignBoundary&& assign_boundary,
              OwnerOf&& owner_of) {
    Chain& chain = worker.chain;
    Column& own = columns_[i];
    std::optional<Term> pivot = own.pivot;
    if (pivot) {
      chain.assign(own.below);
    } else {
      assign_boundary(chain, i);
      pivot = chain.take_pivot();
    }
    for (; pivot; pivot = chain.take_pivot()) {
      const std::atomic_ref<std::uint32_t> owner(owner_of(pivot->cell));
      std::uint32_t other = owner.load(std::memory_order_acquire);
      if (other > i) {
        own = {pivot, worker.keep(chain.consolidate(), &context_.memory)};
        while (other > i) {
          if (!owner.compare_exchange_weak(other, i, std::memory_order_acq_rel)) continue;
          if (other != kNone) worker.again.push_back(other);
          return;
        }
        chain.assign(own.below);  // an older one came first
      }
      const Column& older = columns_[other];
      chain.add(field_.negate(field_.multiply(pivot->coefficient(),
                                              field_.inverse(older.pivot->coefficient()))),
                older.below);
    }
    own = {};
  }

  const K& field_;
  const RunContext& context_;
  std::pmr::vector<Column> columns_;
  std::mutex mutex_;  // for what follows
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

}  // namespace ph::cubical
