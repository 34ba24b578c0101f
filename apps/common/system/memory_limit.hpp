// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ph::app {

/// Makes the kernel refuse memory beyond a limit. The budget of a RunContext counts only large
/// containers. The kernel's limit also bounds all other memory. An allocation beyond the limit
/// fails with std::bad_alloc. The limit with which the process was started is never exceeded, and
/// is restored at the end.
class HeapBound {
 public:
  HeapBound();
  ~HeapBound();
  HeapBound(const HeapBound&) = delete;
  HeapBound& operator=(const HeapBound&) = delete;

  /// Limits the memory of the process to `bytes` more than it has now.
  void bound(std::size_t bytes);
  /// Raises the limit a little, permanently. This is needed because, after a run that reached the
  /// limit, the next run cannot use the gaps between blocks that are still in use.
  void loosen();

 private:
  void set(std::uint64_t limit) const;

  std::optional<std::uint64_t> at_start_;  // empty if it is unknown; then no limit is set
  // The limit that was set, if it is lower.
  std::optional<std::uint64_t> bound_;
};

}  // namespace ph::app
