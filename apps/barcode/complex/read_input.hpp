// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>

#include "apps/barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// An input as it was read.
struct NamedData {
  std::string name;  ///< name of the input, printable
  ReadResult read;
  std::size_t dropped = 0;  ///< number of points that were left out
  std::string sha256 = {};  ///< hash of the bytes that were read; empty: not needed
};
/// @throws Error like the readers.
NamedData read_input(const Input& input, const Job& job, const RunContext& context);

/// Points, or the vertices of a mesh; empty for other data.
std::optional<PointsView> points_of(const ReadResult& read);

}  // namespace ph::barcode
