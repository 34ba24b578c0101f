// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "barcode/output/outputs.hpp"
#include "barcode/parts/part_files.hpp"
#include "barcode/parts/part_input.hpp"
#include "barcode/run.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {

/// Says what an image in parts will take, and computes nothing.
/// @param process as of forecast_text.
Outcome foresee(const PartInput& read, int parts, std::string_view process);

/// Computes a part of an image and writes it. Precondition: arguments.part.
/// @throws Error (usage) if the input is no image.
Outcome run_image_part(const std::string& input, const Arguments& arguments, app::Session& session);

/// The part of a file, if it is that part of that image, whole, and not older than it. A file that
/// is another is said to be, and has to be computed anew.
std::optional<ImagePart> kept_image_part(const std::string& path, const std::string& input,
                                         const PartInput& image, int part, int parts,
                                         app::Session& session);

/// Joins parts of an image and writes the bars, or one part. @throws Error (bad_data) that names
/// files, if they do not belong together or some are missing.
Outcome join_image_parts(std::vector<PartFile> files, const Job& job, const Arguments& arguments,
                         app::Session& session);

/// What the JSON format says of an image that is whole again.
BarcodeInfo info_of(const ImagePart& whole, const std::string& description,
                    const std::string& input, std::int64_t field);

}  // namespace ph::barcode
