// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/common/run/session.hpp"
#include "apps/vectorise/arguments/arguments.hpp"
#include "ph/barcode.hpp"
#include "ph/cubical.hpp"

namespace ph::vectorise {

/// The inputs, with each folder replaced by its files.
std::vector<std::string> files_of(const Arguments& arguments, Kind kind);

/// The input of an Euler curve.
using Sample = std::variant<Barcode, Cubical>;

/// @param cubical the options for an image. Axes that its file declares periodic are added.
/// @throws Error like the readers; Error (usage) on an option that does not apply to this kind of
/// input.
Sample read_sample(const std::string& path, const CubicalOptions& cubical,
                   const Arguments& arguments, app::Session& session);

}  // namespace ph::vectorise
