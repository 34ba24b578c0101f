// SPDX-License-Identifier: MIT
#include "common/run/memory_limit.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

namespace ph::app {
namespace {

// Sanitizers map far more than the program asks for.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

/// The number in the first line of a file of the kernel's, if there is one.
std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  if (!(file >> word)) return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// Writable private memory of this process, bytes: what RLIMIT_DATA counts.
std::optional<std::uint64_t> data_size() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::uint64_t kib = 0; word == "VmData:" && status >> kib) return kib * 1024;
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> control_group_limit(std::istream& memberships,
                                                 const std::string& root) {
  std::optional<std::uint64_t> least;
  // A line is "number:controllers:/path"; version 2 names no controllers.
  for (std::string line; std::getline(memberships, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool unified = controllers.empty();
    if (!unified && ("," + controllers + ",").find(",memory,") == std::string::npos) continue;
    const std::string mount = unified ? root : root + "/memory";
    const std::string file = unified ? "/memory.max" : "/memory.limit_in_bytes";
    // A group is bounded by those around it, too: "/a/b", then "/a", then "".
    for (std::string group = line.substr(second + 1);; group.resize(group.rfind('/'))) {
      const auto limit = number_in(mount + group + file);
      if (limit) least = std::min(least.value_or(*limit), *limit);
      if (group.rfind('/') == std::string::npos) break;
    }
  }
  return least;
}

std::size_t machine_memory() {
  const auto pages = static_cast<std::uint64_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  std::uint64_t bytes = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::ifstream memberships("/proc/self/cgroup");
  bytes = std::min(bytes, control_group_limit(memberships, "/sys/fs/cgroup").value_or(bytes));
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0)
    bytes = std::min<std::uint64_t>(bytes, address_space.rlim_cur);
  return static_cast<std::size_t>(bytes / 10 * 9);
}

HeapBound::HeapBound() {
  rlimit data{};
  if (!kIsSanitized && getrlimit(RLIMIT_DATA, &data) == 0) at_start_ = data.rlim_cur;
}

HeapBound::~HeapBound() {
  if (bound_) set(*at_start_);
}

void HeapBound::bound(std::size_t bytes) {
  // Small blocks, the allocator's own and stacks of threads.
  constexpr std::uint64_t slack = std::uint64_t{16} << 20;
  const auto now = data_size();
  std::uint64_t limit = 0;
  if (!at_start_ || !now) return;
  // The free end of the heap is there, but not taken.
  const std::uint64_t taken = *now - std::min<std::uint64_t>(*now, mallinfo2().keepcost);
  if (__builtin_add_overflow(taken + slack, bytes, &limit)) return;
  if (limit >= *at_start_) return;
  bound_ = limit;
  set(limit);
}

void HeapBound::loosen() {
  constexpr std::uint64_t holes = std::uint64_t{4} << 20;
  if (bound_) set(*bound_ + std::min(holes, *at_start_ - *bound_));
}

void HeapBound::set(std::uint64_t limit) const {
  rlimit data{};
  if (getrlimit(RLIMIT_DATA, &data) != 0) return;
  data.rlim_cur = limit;
  setrlimit(RLIMIT_DATA, &data);
}

}  // namespace ph::app
