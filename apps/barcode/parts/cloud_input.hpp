// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/complex/read_input.hpp"
#include "apps/common/run/session.hpp"
#include "ph/parts/cloud_part.hpp"

namespace ph::barcode {

/// A point cloud, some of whose blocks are to be processed, and the requested results.
struct CloudInput {
  NamedData data;
  PointsView points;  ///< the points of `data`
  CloudPartOptions options;
};

/// @param input a path. The data stay in the file if they have the same layout there as in memory.
/// @throws Error (usage) if the input does not consist of points, or if more than components is
/// requested.
CloudInput read_cloud_input(const std::string& input, const Job& job, app::Session& session);

/// The part in a file, if it is this part of this cloud and complete. Otherwise the part must be
/// computed again.
std::optional<CloudPart> kept_cloud_part(const std::string& path, const CloudInput& cloud, int part,
                                         int parts, app::Session& session);

}  // namespace ph::barcode
