// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

namespace ph {

/// All of the machine's, bytes; 0 where the system does not say.
std::uint64_t physical_memory();

/// What the machine, or the container we run in, has for us; nine tenths of it, so that a budget
/// is met before the system kills the process. As good as no limit where the system does not say.
std::size_t machine_memory();

/// The least memory limit of the control groups a process is in, of both versions.
/// @param memberships its /proc/self/cgroup. @param root where control groups are mounted.
std::optional<std::uint64_t> control_group_limit(std::istream& memberships,
                                                 const std::string& root);

/// A number of /proc/self/status that is given in kB, as "VmHWM:"; in bytes. Nothing where the
/// system does not say.
std::optional<std::uint64_t> status_bytes(std::string_view name);

}  // namespace ph
