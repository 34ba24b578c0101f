// SPDX-License-Identifier: MIT
#include "ph/detail/core/machine_memory.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

namespace ph {
namespace {

/// The number in the first line of a kernel file, or nothing if the line has no number.
std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  if (!(file >> word)) return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::uint64_t> control_group_limit(std::istream& memberships,
                                                 const std::string& root) {
  std::optional<std::uint64_t> least;
  // A line is "number:controllers:/path". In version 2 of control groups, `controllers` is empty.
  for (std::string line; std::getline(memberships, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool unified = controllers.empty();
    if (!unified && ("," + controllers + ",").find(",memory,") == std::string::npos) continue;
    const std::string mount = unified ? root : root + "/memory";
    const std::string file = unified ? "/memory.max" : "/memory.limit_in_bytes";
    // The limits of the enclosing groups apply as well. The loop visits "/a/b", then "/a", then "".
    for (std::string group = line.substr(second + 1);; group.resize(group.rfind('/'))) {
      const auto limit = number_in(mount + group + file);
      if (limit) least = std::min(least.value_or(*limit), *limit);
      if (group.rfind('/') == std::string::npos) break;
    }
  }
  return least;
}

std::uint64_t physical_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page_size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_size <= 0) return 0;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

std::size_t machine_memory() {
  const std::uint64_t physical = physical_memory();
  std::uint64_t bytes = physical > 0 ? physical : std::numeric_limits<std::uint64_t>::max();
  std::ifstream memberships("/proc/self/cgroup");
  bytes = std::min(bytes, control_group_limit(memberships, "/sys/fs/cgroup").value_or(bytes));
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0)
    bytes = std::min<std::uint64_t>(bytes, address_space.rlim_cur);
  return static_cast<std::size_t>(bytes / 10 * 9);
}

std::size_t stack_size() {
#if defined(__linux__)
  // The stack of the main thread grows up to a limit. Other threads start with their whole stack.
  if (::syscall(SYS_gettid) == ::getpid()) {
    rlimit stack{};
    return ::getrlimit(RLIMIT_STACK, &stack) == 0 ? static_cast<std::size_t>(stack.rlim_cur) : 0;
  }
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return 0;
  std::size_t size = 0;
  if (::pthread_attr_getstacksize(&attributes, &size) != 0) size = 0;
  ::pthread_attr_destroy(&attributes);
  return size;
#else
  return 0;
#endif
}

std::optional<std::uint64_t> status_bytes(std::string_view name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::uint64_t kib = 0; word == name && status >> kib) return kib * 1024;
  return std::nullopt;
}

}  // namespace ph
