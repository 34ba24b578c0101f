// SPDX-License-Identifier: MIT
// The checksum of a stored tree stops every change before anything else looks at it: here it is set
// right.
#include <string>

#include "targets.hpp"
#include "tree/tree_file.hpp"

namespace ph::fuzz {

void run_tree(std::string_view bytes) {
  run_reader("tree", bytes);
  if (bytes.size() < segment::kTreeSum) return;
  std::string repaired(bytes.substr(0, bytes.size() - segment::kTreeSum));
  const std::uint32_t sum = segment::tree_sum(repaired);
  for (int shift = 0; shift < 32; shift += 8) repaired += static_cast<char>(sum >> shift & 0xFF);
  run_reader("tree", repaired);
}

}  // namespace ph::fuzz
