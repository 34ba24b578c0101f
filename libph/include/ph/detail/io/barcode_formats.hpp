// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ph/io/write.hpp"

namespace ph {

/// The JSON members that describe the values of a filtration: weights, samples, squares, superlevel
/// sets. Empty if there are none.
std::string filtration_members(const BarcodeInfo& info, std::string_view between = ", ");

// One function per format; see BarcodeFormat.
void write_barcode_csv(OutputFile& file, const Barcode& barcode, const BarcodeInfo& info,
                       const BarData& data);
void write_barcode_pers(OutputFile& file, const Barcode& barcode);
void write_barcode_ripser(OutputFile& file, const Barcode& barcode, int max_dim);
void write_barcode_json(OutputFile& file, const Barcode& barcode, const BarcodeInfo& info,
                        const BarData& data);
void write_barcode_dipha(OutputFile& file, const Barcode& barcode,
                         const std::optional<double>& threshold);
void write_barcode_npy(OutputFile& file, const Barcode& barcode);

}  // namespace ph
