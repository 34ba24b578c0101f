// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "ph/barcode.hpp"
#include "ph/detail/report/report_file.hpp"

namespace ph::report {

/// Writes the arrays `prefix`/dim, `prefix`/birth and `prefix`/death. If `cells` is set and the
/// barcode has cells, also writes the arrays of the cells.
/// @param prefix "bars", or "bars2" for the second barcode of a comparison.
/// @throws Error (bad_data) on a bar of dimension 256 or higher; Error (resource, cancelled, io).
void add_bars(ReportFile& report, const Barcode& barcode, std::string_view prefix = "bars",
              bool cells = true);

/// Writes pictures of the barcodes for browsers that run no scripts. @param barcodes the barcodes
/// that `meta` names.
void add_pictures(ReportFile& report, std::span<const Barcode> barcodes, const Metadata& meta);

/// Writes the representatives of a barcode, if it has them, as chains/….
void add_chains(ReportFile& report, const Barcode& barcode);

}  // namespace ph::report
