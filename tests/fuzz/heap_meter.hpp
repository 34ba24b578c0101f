// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph::fuzz {

/// Measures the memory that the calling thread allocates while the object lives. Every call of
/// malloc counts, including the calls in C libraries. Without the address sanitizer, nothing is
/// measured.
class HeapMeter {
 public:
  HeapMeter();
  HeapMeter(const HeapMeter&) = delete;
  HeapMeter& operator=(const HeapMeter&) = delete;
  ~HeapMeter();
  /// The peak number of bytes during the thread's last HeapMeter, minus the bytes that the thread
  /// held before.
  static std::size_t last_peak();
};

}  // namespace ph::fuzz
