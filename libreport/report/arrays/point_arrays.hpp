// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/report/report_file.hpp"

namespace ph::report {

/// Writes the array points/position. If a step is at most `tolerance` on every axis, coordinates
/// are stored as 16-bit steps across their bounding box. Otherwise they are stored unchanged.
/// @param coordinates finite numbers, `dims` (1 to 3) per point.
template <class Real>
void add_positions(ReportFile& report, std::span<const Real> coordinates, std::size_t dims,
                   double tolerance);

/// Encodes a unit normal as two numbers (octahedral encoding). A normal that is not finite becomes
/// -128, -128.
std::array<std::int8_t, 2> octahedral(double x, double y, double z);

/// Writes labels in the narrowest type that can store them. If `none` is true, the label UINT32_MAX
/// means that there is no label, and is stored as the largest number of the type.
void add_labels(ReportFile& report, std::string_view name, std::span<const std::uint32_t> labels,
                bool none);

}  // namespace ph::report
