// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <mutex>
#include <optional>

#include "ph/alpha.hpp"

namespace ph {

/// Data of an alpha complex that are computed only when they are first needed.
struct Alpha::Lazy {
  explicit Lazy(const RunContext& made_with) : context(&made_with) {}
  void set(ExplicitComplex complex) {
    listed.emplace(std::move(complex));
    ready.store(&*listed, std::memory_order_release);
  }

  std::mutex mutex;
  std::atomic<const ExplicitComplex*> ready{nullptr};
  std::optional<ExplicitComplex> listed;
  /// The vertices of each cell of `listed`; empty unless the space is periodic.
  SimplexList vertices;
  const RunContext* context;
};

}  // namespace ph
