// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "barcode/parts/part_files.hpp"

namespace ph::barcode {

/// Computes a part of the components of a point cloud and writes it. Precondition: arguments.part.
/// @throws Error (usage) if the input is no points, or more than components is wanted.
Outcome run_cloud_part(const std::string& input, const Arguments& arguments, app::Session& session);

/// Joins parts of a cloud and writes the bars, or one part. @throws Error (bad_data) that names
/// files, if they do not belong together or some are missing.
Outcome join_cloud_parts(const std::vector<PartFile>& files, const Job& job,
                         const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
