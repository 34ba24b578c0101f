// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include "ph/detail/io/barcode_formats.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {

/// The highest dimension that a barcode file may name.
inline constexpr std::int64_t kMostBarDimension = 1 << 20;

/// Describes the problem with a bar. Fault::what is empty if there is no problem.
Fault fault_of_bar(const Bar& bar);

/// This line precedes the intervals of each dimension in Ripser's output.
inline constexpr std::string_view kRipserHeading = "persistence intervals in dim ";

StoredBarcode read_barcode_json(const Input& input);
Barcode read_barcode_ripser(const Input& input);
/// Reads a table of bars in the formats csv or pers, or similar output of other programs.
/// @param may_be_empty true if an empty file is an empty barcode.
StoredBarcode read_barcode_rows(const Input& input, bool may_be_empty);
/// True if the first line names the columns of a table of bars.
bool has_barcode_header(const Input& input);

}  // namespace ph
