// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "apps/common/arguments/plot_arguments.hpp"
#include "ph/barcode.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {

/// The surface of an alpha complex at a value, as a file of triangles.
struct Surface {
  double value = 0;
  std::string path;
  bool is_wrap = false;  ///< of its wrap complex
  std::string option() const { return is_wrap ? "--wrap" : "--alpha-shape"; }
};

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

}  // namespace ph::barcode
