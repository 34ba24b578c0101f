// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>

#include "apps/barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// An input as it was read.
struct NamedData {
  std::string name;  ///< the name of the input, printable
  ReadResult read;
  std::size_t dropped = 0;  ///< the number of points that were left out
  /// The hash of the bytes that were read; empty if it is not needed.
  std::string sha256 = {};
};
/// @throws Error like the readers.
NamedData read_input(const Input& input, const Job& job, const RunContext& context);

/// The points, or the vertices of a mesh. Empty for other data.
std::optional<PointsView> points_of(const ReadResult& read);

}  // namespace ph::barcode
