// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::distance_program {

/// The groups that barcodes belong to.
struct Groups {
  std::vector<std::string> names;  // in the order in which they come first
  std::vector<std::size_t> sizes;
  std::vector<std::int64_t> of;  // of each barcode, its place among the names
};

/// Reads a word a line; blank lines and comments, from # on, are skipped.
/// @param count how many barcodes there are.
/// @throws Error (bad_data) on a line of several words, another number of them, fewer than two
///         groups, or one with a single barcode.
Groups read_groups(const Input& input, std::size_t count);

/// "control 4, treated 5"
std::string words_of(const Groups& groups);

}  // namespace ph::distance_program
