// SPDX-License-Identifier: MIT
#include "apps/common/system/temporaries.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <string>

#include "apps/common/system/signals.hpp"

namespace ph::app {
namespace {

// A handler may use only lock-free atomics and memory that does not move. The variables below are
// therefore globals. Like signals, they belong to the process.
constexpr std::size_t kSlots = 64;
constexpr std::size_t kLongestName = 4096;

std::array<std::array<char, kLongestName>, kSlots> temporary_names;
// 0 means free, 1 being filled, and 2 in use.
std::array<std::atomic<int>, kSlots> slot_state;

static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

void remove_temporaries() {
  for (std::size_t i = 0; i < kSlots; ++i)
    if (slot_state[i].load() == 2) unlink(temporary_names[i].data());
}

int remember_temporary(const std::string& path) {
  if (path.empty() || path.size() >= kLongestName) return -1;
  for (std::size_t i = 0; i < kSlots; ++i) {
    int free = 0;
    if (!slot_state[i].compare_exchange_strong(free, 1)) continue;
    std::memcpy(temporary_names[i].data(), path.c_str(), path.size() + 1);
    slot_state[i] = 2;
    return static_cast<int>(i);
  }
  return -1;
}

void forget_temporary(int slot) {
  if (slot >= 0) slot_state[static_cast<std::size_t>(slot)] = 0;
}

}  // namespace ph::app
