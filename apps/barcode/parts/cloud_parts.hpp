// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "barcode/parts/cloud_input.hpp"
#include "barcode/parts/part_files.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph::barcode {

/// Says what a cloud in parts will take, and computes nothing.
/// @param process as of forecast_text.
Outcome foresee(const CloudInput& cloud, int parts, std::string_view process);

/// Computes a part of the components of a point cloud and writes it. Precondition: arguments.part.
/// @throws Error (usage) if the input is no points, or more than components is wanted.
Outcome run_cloud_part(const std::string& input, const Arguments& arguments, app::Session& session);

/// Joins parts of a cloud and writes the bars, or one part. @throws Error (bad_data) that names
/// files, if they do not belong together or some are missing.
Outcome join_cloud_parts(const std::vector<PartFile>& files, const Job& job,
                         const Arguments& arguments, app::Session& session);

/// The bars of a cloud that is whole again, with cells if a format shows them.
Barcode bars_of(CloudPart whole, BarcodeFormat format, const RunContext& context);

/// What the JSON format says of such a cloud.
BarcodeInfo info_of(const CloudPart& whole, const std::string& description,
                    const std::string& input);

}  // namespace ph::barcode
