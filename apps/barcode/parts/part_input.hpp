// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/common/run/session.hpp"
#include "ph/parts/image_part.hpp"

namespace ph::barcode {

/// An image, some of whose layers are to be processed, and the requested results.
struct PartInput {
  Image image;
  ImagePartOptions options;
  std::string description;  ///< such as "image of 64 x 96 voxels, PGM"
};

/// @param input a path. The data stay in the file if they have the same layout there as in memory.
/// @param keeps_cells true if bars keep their cells.
/// @throws Error (usage) if the input is not an image, and on options that do not apply to images.
PartInput read_part_input(const std::string& input, bool keeps_cells, const Job& job,
                          app::Session& session);

}  // namespace ph::barcode
