// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>

#include "barcode/arguments/arguments.hpp"
#include "barcode/complex/read_input.hpp"
#include "common/run/session.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph::barcode {

/// A point cloud of which some blocks will be looked at, and what is wanted of them.
struct CloudInput {
  NamedData data;
  PointsView points;  ///< of the data
  CloudPartOptions options;
};

/// @param input stays in its file where it lies there as in memory.
/// @throws Error (usage) on anything but points, and where more than components is wanted.
CloudInput read_cloud_input(const std::string& input, const Arguments& arguments,
                            app::Session& session);

/// The part of a file, if it is that part of that cloud, whole, and not older than it. A file that
/// is another is said to be, and has to be computed anew.
std::optional<CloudPart> kept_cloud_part(const std::string& path, const std::string& input,
                                         const CloudInput& cloud, int part, int parts,
                                         app::Session& session);

}  // namespace ph::barcode
