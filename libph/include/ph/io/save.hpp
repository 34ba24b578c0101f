// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/io/write.hpp"
#include "ph/persistence.hpp"

namespace ph {

/// The facts about a barcode that a complex and a plan determine. The caller may add further facts,
/// such as the input, the loops and the p-values.
/// @param plan the plan with which the barcode was computed. @throws as `facts`.
BarcodeInfo info_of(const AnyComplex& complex, const RunPlan& plan,
                    const RunContext& context = default_context());

/// Writes a barcode to a file, completely or not at all. The extension of the file selects the
/// format: .csv, .json, .ripser, .pers, .dipha or .npy. Only JSON states the facts of `info`.
/// @throws Error (usage) on another extension, and as `write_barcode`; Error (io, cannot_create) as
///         OutputFile.
void save(const std::string& path, const Barcode& bars, const BarcodeInfo& info = {});

}  // namespace ph
