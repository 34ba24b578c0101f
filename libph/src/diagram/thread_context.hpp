// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/detail/core/parallel.hpp"
#include "ph/run_context.hpp"

namespace ph::diagram {

/// Contexts for tasks that several threads do at the same time: a context reports to one thread
/// only, and limits memory.
class ThreadContexts {
 public:
  /// @param tasks as many at the same time, at most. @param parent outlives this.
  ThreadContexts(std::size_t tasks, const RunContext& parent)
      : parent_(parent),
        share_(parent.memory.limit() == MemoryBudget::kUnlimited
                   ? MemoryBudget::kUnlimited
                   : parent.memory.left() /
                         std::clamp<std::size_t>(thread_count(parent), 1, std::max(tasks, kOne))) {}

  /// Makes a new context that of a task: one thread, stopped with the others, a share of the
  /// memory.
  void prepare(RunContext& task) const {
    task.stop = parent_.stop;
    task.threads = 1;
    task.memory.set_limit(share_);
  }

 private:
  static constexpr std::size_t kOne = 1;

  const RunContext& parent_;
  const std::size_t share_;
};

}  // namespace ph::diagram
