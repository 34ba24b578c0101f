// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "tests/fuzz/content.hpp"

namespace ph::fuzz {

/// A reader under test.
struct NamedReader {
  std::string_view name;  ///< the function's name without `read_`, or with the format appended
  /// Extension of the input's name, from which some formats are recognised.
  std::string_view extension;
  /// Reads under a HeapMeter and checks what the type of the result promises. Throws the reader's
  /// errors, or Violation.
  Content (*read)(const Input& input, const ReadOptions& options);
  /// Writes the result in every format that can hold it, reads it again, and checks that nothing
  /// has changed. Does nothing for types that libph does not write. Throws Violation.
  void (*rewrite)(const Input& input, const ReadOptions& options);
};

/// All readers. A reader with a choice of formats occurs once per format.
std::span<const NamedReader> readers();
/// Null if no reader has this name.
const NamedReader* find_reader(std::string_view name);

}  // namespace ph::fuzz
