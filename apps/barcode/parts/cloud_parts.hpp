// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/barcode/parts/cloud_input.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph::barcode {

/// Prints a forecast of what a cloud in parts will need, and computes nothing else.
/// @param process as in forecast_text.
Outcome foresee(const CloudInput& cloud, int parts, std::string_view process);

/// Computes a part of the components of a point cloud and writes it. Precondition:
/// `job.sharing.part` is set.
/// @throws Error (usage) if the input does not consist of points, or if more than components is
/// requested.
Outcome run_cloud_part(const std::string& input, const Job& job, app::Session& session);

/// Joins parts of a cloud and writes the bars, or one part. @throws Error (bad_data), which names
/// the files, if parts do not belong together or some are missing.
Outcome join_cloud_parts(const std::vector<PartFile>& files, const Job& job, app::Session& session);

/// The bars of a complete cloud, with cells if the format shows them.
Barcode bars_of(CloudPart whole, BarcodeFormat format, const RunContext& context);

}  // namespace ph::barcode
