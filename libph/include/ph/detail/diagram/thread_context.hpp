// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/detail/core/parallel.hpp"
#include "ph/run_context.hpp"

namespace ph::diagram {

/// Contexts for tasks that run on several threads. Each task needs its own context, because a
/// context can report to one thread only, and each task has its own share of the memory.
class ThreadContexts {
 public:
  /// @param tasks largest number of tasks at the same time. @param parent must outlive this object.
  ThreadContexts(std::size_t tasks, const RunContext& parent)
      : parent_(parent),
        share_(parent.memory.limit() == MemoryBudget::kUnlimited
                   ? MemoryBudget::kUnlimited
                   : parent.memory.left() /
                         std::clamp<std::size_t>(thread_count(parent), 1, std::max(tasks, kOne))) {}

  /// Prepares a new context for a task. The context has one thread, stops with the parent, and has
  /// a share of the memory.
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
