// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "barcode/arguments/arguments.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {

/// What the arguments say of images, for one. @param periodic the axes that its file says close up.
/// @throws Error (usage) if there are not so many axes.
CubicalOptions cubical_options(const Arguments& arguments, const Image& image,
                               const std::vector<bool>& periodic);

/// What a barcode's origin says of them.
void describe(const CubicalOptions& options, BarcodeInfo& info);

}  // namespace ph::barcode
