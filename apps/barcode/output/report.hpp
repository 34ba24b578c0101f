// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/complex/build_complex.hpp"
#include "apps/barcode/complex/read_input.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

/// The contents of a barcode's report.
struct Shown {
  const Barcode& barcode;  ///< with its origin
  const NamedData& data;
  const BuiltComplex& built;
  std::optional<RipsForm> form;        ///< for a Rips complex
  std::optional<std::string> promise;  ///< the result of promise_of
  std::vector<std::string> warnings;
};

/// Writes the interactive report. The caller commits the file. In addition to the barcode, the
/// report contains the points or the image, and the merge tree of H0. It has no tree if the complex
/// was subsampled, approximated or cut off. If memory does not suffice for the tree, the tree is
/// left out and a note reports it.
/// @throws Error (io, resource, cancelled).
void write_report(OutputFile& file, const Shown& shown, const Job& job, app::Session& session);

/// Handles --compare: reads two barcodes, and writes their distances and a report of both barcodes.
/// @return the exit code.
/// @throws Error like read_barcode and OutputFile.
int run_comparison(const Job& job, app::Session& session);

}  // namespace ph::barcode
