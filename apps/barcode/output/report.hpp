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
  const Barcode& barcode;
  const BarcodeInfo& info;
  const NamedData& data;
  const BuiltComplex& built;
  std::optional<RipsForm> form;        ///< for a Rips complex
  std::optional<std::string> promise;  ///< the result of promise_of
  std::vector<std::string> warnings;
};

/// Writes the interactive report; the caller commits the file. Beside the barcode it has the points
/// or the image, and the merge tree of H0. The tree is missing if the complex was subsampled,
/// approximated or cut, or if memory does not suffice, which a note says.
/// @throws Error (io, resource, cancelled).
void write_report(OutputFile& file, const Shown& shown, const Job& job, app::Session& session);

/// --compare: reads two barcodes, writes their distances and the report of both. @return the exit
/// code.
/// @throws Error like read_barcode and OutputFile.
int run_comparison(const Job& job, app::Session& session);

}  // namespace ph::barcode
