// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "ph/io/read.hpp"
#include "ph/points.hpp"

namespace ph::app {

/// The points, or the vertices of a mesh. Empty for other data.
std::optional<PointsView> points_of(const ReadResult& read);

/// The number of bytes of the data that remain in memory while they are used.
std::size_t bytes_of(const ReadResult& read);

/// Refuses points that were left out. Scanners mark holes with NaN, so NaN in a cloud is an error
/// only with --nan error.
/// @param name the name of the input. @throws Error (bad_data) if `dropped` is above 0.
void require_no_dropped_points(const std::string& name, std::size_t dropped);

}  // namespace ph::app
