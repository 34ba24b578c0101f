// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include "io/barcodes/barcode_formats.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph {

/// The highest dimension that a barcode file may name.
inline constexpr std::int64_t kMostBarDimension = 1 << 20;

/// What is wrong with a bar; `what` is empty if nothing is.
Fault fault_of_bar(const Bar& bar);

StoredBarcode read_barcode_json(const Input& input);

}  // namespace ph
