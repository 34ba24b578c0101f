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

/// Lets the kernel refuse memory beyond `bytes` more than the process has now. Behind the budget
/// of a RunContext, which counts large containers only, this bounds all the others; an allocation
/// then fails with std::bad_alloc.
void bound_heap(std::size_t bytes);

/// Lets go of a little of that bound: after a run that met it, addresses between blocks still in
/// use are lost to the next one.
void loosen_heap_bound();

}  // namespace ph::app
