// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "barcode/parts/part_files.hpp"
#include "barcode/run.hpp"

namespace ph::barcode {

/// Computes a part of an image and writes it. Precondition: arguments.part.
/// @throws Error (usage) if the input is no image.
Outcome run_image_part(const std::string& input, const Arguments& arguments, app::Session& session);

/// Joins parts of an image and writes the bars, or one part. @throws Error (bad_data) that names
/// files, if they do not belong together or some are missing.
Outcome join_image_parts(std::vector<PartFile> files, const Job& job, const Arguments& arguments,
                         app::Session& session);

}  // namespace ph::barcode
