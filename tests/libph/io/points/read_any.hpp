// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {

/// An NPY file of doubles. @param shape as Python writes it: "(3, 3)".
inline std::string npy(const std::string& shape, const std::vector<double>& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + le(std::uint16_t{118}) + header + "\n";
  for (const double value : values) bytes += le(value);
  return bytes;
}

/// Reads a file whose format and meaning are not stated.
inline ReadResult any(const std::string& bytes, const ReadOptions& options = {}) {
  return read_any(Input::view(bytes, "t.csv"), Format::automatic, options);
}

/// True if a note contains the words.
inline bool says(const ReadResult& result, const std::string& words) {
  return std::ranges::any_of(result.notes,
                             [&](const Message& note) { return contains(note.str(), words); });
}

}  // namespace ph::test
