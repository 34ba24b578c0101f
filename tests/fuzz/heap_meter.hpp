// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph::fuzz {

/// Measures the memory that the calling thread takes while this object lives. It counts every
/// malloc, including those in C libraries; this needs the address sanitizer, without which it sees
/// nothing.
class HeapMeter {
 public:
  HeapMeter();
  HeapMeter(const HeapMeter&) = delete;
  HeapMeter& operator=(const HeapMeter&) = delete;
  ~HeapMeter();
  /// The peak number of bytes that the thread held under its last meter, beyond its earlier memory.
  static std::size_t last_peak();
};

}  // namespace ph::fuzz
