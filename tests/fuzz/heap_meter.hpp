// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph::fuzz {

/// Watches the memory that the calling thread takes while this object lives. Counts every malloc,
/// also of libraries in C; it needs the address sanitizer to, and else sees nothing.
class HeapMeter {
 public:
  HeapMeter();
  HeapMeter(const HeapMeter&) = delete;
  HeapMeter& operator=(const HeapMeter&) = delete;
  ~HeapMeter();
  /// The most bytes that the thread held under its last meter, beyond what it had before.
  static std::size_t last_peak();
};

}  // namespace ph::fuzz
