// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "ph/cubical.hpp"

namespace ph::barcode {

/// The options for one image, from the arguments. @param periodic the axes that the image file
/// declares periodic.
/// @throws Error (usage) if an option needs more axes than the image has.
CubicalOptions cubical_options(const Job& job, const Image& image,
                               const std::vector<bool>& periodic);

}  // namespace ph::barcode
