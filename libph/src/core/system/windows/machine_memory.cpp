// SPDX-License-Identifier: MIT
#include "ph/detail/core/machine_memory.hpp"

#include <windows.h>
// This header must follow windows.h, because it uses types of windows.h.
#include <psapi.h>

namespace ph {

std::uint64_t physical_memory() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return GlobalMemoryStatusEx(&status) == 0 ? 0 : status.ullTotalPhys;
}

std::size_t machine_memory() {
  const std::uint64_t bytes = physical_memory();
  return static_cast<std::size_t>((bytes == 0 ? SIZE_MAX : bytes) / 10 * 9);
}

std::size_t stack_size() { return 0; }

// Windows has no control groups.
std::optional<std::uint64_t> control_group_limit(std::istream&, const std::string&) {
  return std::nullopt;
}

std::optional<std::uint64_t> status_bytes(std::string_view name) {
  PROCESS_MEMORY_COUNTERS counters{};
  if (GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) == 0)
    return std::nullopt;
  if (name == "VmHWM:") return counters.PeakWorkingSetSize;
  if (name == "VmRSS:") return counters.WorkingSetSize;
  return std::nullopt;
}

}  // namespace ph
