// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "barcode/arguments/arguments.hpp"
#include "common/run/program.hpp"
#include "common/run/session.hpp"

namespace ph::barcode {

inline constexpr app::Program kProgram{
    "ph-barcode",
    "take fewer points or voxels, a lower threshold or dimension (--max-dim), or raise "
    "--memory-limit"};

/// One input and the destination of its barcode.
struct Job {
  std::string input;
  std::string output;
  BarcodeFormat format = BarcodeFormat::csv;
  std::vector<app::Plot> plots = {};
  std::string report = {};  ///< empty: none
  std::vector<Surface> surfaces = {};
  Barcode* bars = nullptr;  ///< receives the bars, if not null
};

/// The outcome of one input.
struct Outcome {
  int code = 0;
  std::string summary;  ///< "1024 points in R^3, CSV: 57 bars"
};

/// Reads one input, computes its barcode and writes it. A stored barcode is already computed.
/// @throws Error.
Outcome run(const Job& job, const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
