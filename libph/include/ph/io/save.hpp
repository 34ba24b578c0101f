// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/io/write.hpp"

namespace ph {

/// Writes a barcode to a file, completely or not at all. The extension of the file selects the
/// format: .csv, .json, .ripser, .pers, .dipha or .npy. Only JSON states the origin, Barcode::info.
/// @throws Error (usage) on another extension, and as `write_barcode`; Error (io, cannot_create) as
///         OutputFile.
void save(const std::string& path, const Barcode& bars, const BarData& data = {});

}  // namespace ph
