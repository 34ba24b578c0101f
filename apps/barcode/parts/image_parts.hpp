// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/barcode/output/outputs.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/barcode/parts/part_input.hpp"
#include "apps/common/run/session.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {

/// Prints a forecast of what an image in parts will need, and computes nothing else.
/// @param process as in forecast_text.
Outcome foresee(const PartInput& read, int parts, std::string_view process);

/// Computes a part of an image and writes it. Precondition: `job.sharing.part` is set.
/// @throws Error (usage) if the input is not an image.
Outcome run_image_part(const std::string& input, const Job& job, app::Session& session);

/// The part in a file, if it is this part of this image and complete. Otherwise the part must be
/// computed again.
std::optional<ImagePart> kept_image_part(const std::string& path, const PartInput& image, int part,
                                         int parts, app::Session& session);

/// Joins parts of an image and writes the bars, or one part. @throws Error (bad_data), which names
/// the files, if parts do not belong together or some are missing.
Outcome join_image_parts(std::vector<PartFile> files, const Job& job, app::Session& session);

}  // namespace ph::barcode
