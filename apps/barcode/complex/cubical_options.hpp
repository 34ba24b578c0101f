// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {

/// The options for one image, from the arguments. @param periodic the axes that its file declares
/// periodic.
/// @throws Error (usage) if the image has fewer axes.
CubicalOptions cubical_options(const Job& job, const Image& image,
                               const std::vector<bool>& periodic);

/// These options, as the origin of a barcode states them.
void describe(const CubicalOptions& options, BarcodeInfo& info);

}  // namespace ph::barcode
