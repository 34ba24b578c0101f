// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "arguments.hpp"
#include "program.hpp"
#include "session.hpp"

namespace ph::barcode {

inline constexpr app::Program kProgram{
    "ph-barcode",
    "lower the threshold, the dimension (--max-dim) or the number of points, or raise "
    "--memory-limit"};

/// One input and where its barcode goes.
struct Job {
  std::string input;
  std::string output;
  BarcodeFormat format = BarcodeFormat::csv;
};

/// What became of it.
struct Outcome {
  int code = 0;
  std::string summary;  ///< "1024 points in R^3, CSV: 57 bars"
};

/// An input as it was read.
struct NamedData {
  std::string name;  ///< of the input, printable
  ReadResult read;
  std::size_t dropped = 0;  ///< points that were left out
  std::string sha256 = {};  ///< of the bytes that were read; empty: nobody wants to know
};
/// @throws Error as the readers.
NamedData read_input(const Job& job, const Arguments& arguments, const RunContext& context);

/// Reads one input, computes its barcode and writes it. @throws Error.
Outcome run(const Job& job, const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
