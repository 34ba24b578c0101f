// SPDX-License-Identifier: MIT
// Checks files that the programs store for later runs, and other small files: merge trees of
// scenes, fits of vectors, groups of barcodes.
#include <algorithm>
#include <memory_resource>
#include <string>
#include <utility>
#include <vector>

#include "apps/distance/data/groups.hpp"
#include "apps/vectorise/fit/fit.hpp"
#include "libsegment/src/tree/tree_file.hpp"
#include "ph/error.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {

// Corrects the checksum of a stored tree, which would otherwise reject every change before any
// other check.
void run_tree(std::string_view bytes) {
  run_reader("tree", bytes);
  if (bytes.size() < segment::kTreeSum) return;
  std::string repaired(bytes.substr(0, bytes.size() - segment::kTreeSum));
  const std::uint32_t sum = segment::tree_sum(repaired);
  for (int shift = 0; shift < 32; shift += 8) repaired += static_cast<char>(sum >> shift & 0xFF);
  run_reader("tree", repaired);
}

void run_distance_groups(std::string_view bytes) {
  const std::size_t count = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0] - '0') % 16U;
  bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 1));
  try {
    const auto groups = distance_program::read_groups(Input::view(bytes, "groups.txt"), count);
    require(groups.of.size() == count, "a barcode has no group, or a group no barcode");
    require(groups.names.size() >= 2, "there are no groups to be told apart");
    for (std::size_t g = 0; g < groups.names.size(); ++g) {
      require(std::cmp_equal(std::ranges::count(groups.of, static_cast<std::int64_t>(g)),
                             groups.sizes[g]),
              "the size of a group is not that of its members");
      require(groups.sizes[g] >= 2, "a group has one member");
    }
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data, "groups are no bad data");
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message of several lines");
  }
}

void run_vectorise_fit(std::string_view bytes) {
  RunContext context;
  context.memory.set_limit(std::size_t{16} << 20);
  const auto read = [&](std::string_view text) {
    std::pmr::vector<char> copy(text.begin(), text.end());
    return vectorise::read_fit(Input::hold(std::move(copy), "fit.json", &context));
  };
  std::string written;
  try {
    written = vectorise::fit_json(read(bytes), 0);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data || error.kind() == ErrorKind::resource,
            "a fit is neither bad nor too large");
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message of several lines");
    return;
  }
  require(vectorise::fit_json(read(written), 0) == written, "a fit is not read as it was written");
}

}  // namespace ph::fuzz
