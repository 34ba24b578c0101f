// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/run/session.hpp"
#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "vectorise/arguments/arguments.hpp"

namespace ph::vectorise {

/// The inputs, with the files of folders in place of these.
std::vector<std::string> files_of(const Arguments& arguments, Kind kind);

/// What an Euler curve is of.
using Sample = std::variant<Barcode, Cubical>;

/// @param cubical how an image is taken; axes that the file says are periodic are added.
/// @throws Error as the readers; Error (usage) on an option that is not for such an input.
Sample read_sample(const std::string& path, const CubicalOptions& cubical,
                   const Arguments& arguments, app::Session& session);

}  // namespace ph::vectorise
