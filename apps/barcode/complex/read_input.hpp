// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>

#include "barcode/arguments/arguments.hpp"

namespace ph::barcode {

/// An input as it was read.
struct NamedData {
  std::string name;  ///< of the input, printable
  ReadResult read;
  std::size_t dropped = 0;  ///< points that were left out
  std::string sha256 = {};  ///< of the bytes that were read; empty: nobody wants to know
};
/// @throws Error as the readers.
NamedData read_input(const Input& input, const Arguments& arguments, const RunContext& context);

/// Points, and the vertices of a mesh; nothing of other data.
std::optional<PointsView> points_of(const ReadResult& read);

}  // namespace ph::barcode
