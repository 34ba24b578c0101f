// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

namespace ph {

/// The memory of the machine in bytes; 0 if the system does not report it.
std::uint64_t physical_memory();

/// Nine tenths of the memory that the machine or the container allows. With this limit, a
/// computation exceeds its budget before the system kills the process. The number is practically
/// unlimited if the system does not report its memory.
std::size_t machine_memory();

/// The size of the stack of this thread in bytes; 0 if the system does not report it.
std::size_t stack_size();
/// Each thread that calls libph, and each thread that libph starts, needs a stack of this size.
constexpr std::size_t kLeastStack = std::size_t{128} << 10;

/// The smallest memory limit of the control groups of a process, of either version.
/// @param memberships the content of the process's /proc/self/cgroup. @param root where control
/// groups are mounted.
std::optional<std::uint64_t> control_group_limit(std::istream& memberships,
                                                 const std::string& root);

/// A number in /proc/self/status that is given in kB, such as "VmHWM:"; returned in bytes. Empty if
/// the system does not report it.
std::optional<std::uint64_t> status_bytes(std::string_view name);

}  // namespace ph
