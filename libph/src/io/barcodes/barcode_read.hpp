// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include "ph/detail/io/barcode_formats.hpp"
#include "ph/detail/io/json_cursor.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {

/// The highest dimension that a barcode file may name.
inline constexpr std::int64_t kMostBarDimension = 1 << 20;

/// Describes the problem with a bar. Fault::what is empty if there is no problem.
Fault fault_of_bar(const Bar& bar);

/// This line precedes the intervals of each dimension in Ripser's output.
inline constexpr std::string_view kRipserHeading = "persistence intervals in dim ";

/// Reads a birth, a death or another value of a filtration. A death of null means that the class
/// never dies.
double read_barcode_value(detail::JsonCursor& json);
/// Reads the value of a member of a barcode if it describes the origin of the barcode. @return
/// false for any other member.
bool read_barcode_info(detail::JsonCursor& json, const std::string& name, BarcodeInfo& info);

StoredBarcode read_barcode_json(const Input& input);
Barcode read_barcode_ripser(const Input& input);
/// Reads a table of bars in the formats csv or pers, or similar output of other programs.
/// @param may_be_empty true if an empty file is an empty barcode.
StoredBarcode read_barcode_rows(const Input& input, bool may_be_empty);
/// True if the first line names the columns of a table of bars.
bool has_barcode_header(const Input& input);

}  // namespace ph
