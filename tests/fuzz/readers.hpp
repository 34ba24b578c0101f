// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "tests/fuzz/content.hpp"

namespace ph::fuzz {

/// A reader under test.
struct NamedReader {
  std::string_view name;       ///< its function without `read_`, or with the format appended
  std::string_view extension;  ///< of the file's name, by which some formats are known
  /// Reads under a HeapMeter and checks the promises of every result. Throws the reader's errors,
  /// or Violation.
  Content (*read)(const Input& input, const ReadOptions& options);
  /// Writes the result in every format that can hold it, reads it again, and requires it to be the
  /// same; does nothing for types that libph does not write. Throws Violation.
  void (*rewrite)(const Input& input, const ReadOptions& options);
};

/// All readers, and those that choose a format once for each format.
std::span<const NamedReader> readers();
/// Null if none has this name.
const NamedReader* find_reader(std::string_view name);

}  // namespace ph::fuzz
