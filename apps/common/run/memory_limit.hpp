// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>

namespace ph::app {

/// What the machine, or the container we run in, has for us; nine tenths of it, so that a budget
/// is met before the system kills the process.
std::size_t machine_memory();

/// The least memory limit of the control groups a process is in, of both versions.
/// @param memberships its /proc/self/cgroup. @param root where control groups are mounted.
std::optional<std::uint64_t> control_group_limit(std::istream& memberships,
                                                 const std::string& root);

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
