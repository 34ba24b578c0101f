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
/// Opens the input of a job, which is a file or, with --stack, a folder. The other parameters are
/// as for Input::open.
Input open_input(const std::string& path, const Job& job, const RunContext& context,
                 Input::Excess excess, const Input::StartCheck& check = {});

/// @throws Error like the readers.
NamedData read_input(const Input& input, const Job& job, const RunContext& context);

}  // namespace ph::barcode
