// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph::fuzz {

/// Measures the memory that the calling thread takes while the object lives. It counts every
/// malloc, including those of C libraries. It needs the address sanitizer, and measures nothing
/// without it.
class HeapMeter {
 public:
  HeapMeter();
  HeapMeter(const HeapMeter&) = delete;
  HeapMeter& operator=(const HeapMeter&) = delete;
  ~HeapMeter();
  /// The peak number of bytes during the thread's last HeapMeter, beyond what the thread already
  /// held.
  static std::size_t last_peak();
};

}  // namespace ph::fuzz
