// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::distance_program {

/// The groups that barcodes belong to.
struct Groups {
  std::vector<std::string> names;  // the names in the order of first appearance
  std::vector<std::size_t> sizes;
  std::vector<std::int64_t> of;  // for each barcode, the index of its group in `names`
};

/// Reads one word per line. Skips blank lines and comments, which start at #.
/// @param count the number of barcodes.
/// @throws Error (bad_data) on a line of several words, a different number of lines, fewer than two
/// groups, or a group with a single barcode.
Groups read_groups(const Input& input, std::size_t count);

/// Returns a text such as "control 4, treated 5".
std::string words_of(const Groups& groups);

}  // namespace ph::distance_program
