// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "content.hpp"

namespace ph::fuzz {

/// A reader under test.
struct NamedReader {
  std::string_view name;       ///< its function without `read_`, or that and the format
  std::string_view extension;  ///< of the file's name, by which some formats are known
  /// Reads under a HeapMeter and checks what every result promises. Throws what the reader throws,
  /// or Violation.
  Content (*read)(const Input& input, const ReadOptions& options);
  /// What it reads, written in every format that can hold it and read again, is the same; does
  /// nothing for what libph does not write. Throws Violation.
  void (*rewrite)(const Input& input, const ReadOptions& options);
};

/// All readers, and those that choose a format once for each format.
std::span<const NamedReader> readers();
/// Null if there is none of that name.
const NamedReader* find_reader(std::string_view name);

}  // namespace ph::fuzz
