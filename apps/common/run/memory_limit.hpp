// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ph::app {

/// Lets the kernel refuse memory: behind the budget of a RunContext, which counts large containers
/// only, this bounds all the others. An allocation then fails with std::bad_alloc. The limit that
/// the process was started with is never passed, and comes back in the end.
class HeapBound {
 public:
  HeapBound();
  ~HeapBound();
  HeapBound(const HeapBound&) = delete;
  HeapBound& operator=(const HeapBound&) = delete;

  /// Bounds what the process may have to `bytes` more than it has now.
  void bound(std::size_t bytes);
  /// Lets go of a little of the bound, once and for all: after a run that met it, addresses between
  /// blocks still in use are lost to the next one.
  void loosen();

 private:
  void set(std::uint64_t limit) const;

  std::optional<std::uint64_t> at_start_;  // none: it is not known, nothing is bounded
  std::optional<std::uint64_t> bound_;     // what was set, if it is below
};

}  // namespace ph::app
