// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/report/report_file.hpp"

namespace ph::report {

/// Writes points/position. The coordinates are stored as 16-bit numbers over their box if one step
/// is at most `tolerance` on every axis, and otherwise unchanged.
/// @param coordinates finite, `dims` (1 to 3) per point.
template <class Real>
void add_positions(ReportFile& report, std::span<const Real> coordinates, std::size_t dims,
                   double tolerance);

/// A unit normal in the octahedral encoding with two numbers; -128, -128 for a normal that is not
/// finite.
std::array<std::int8_t, 2> octahedral(double x, double y, double z);

/// Writes labels from 0 in the narrowest type that holds them and, with `none`, also the largest
/// number of the type, which stands for UINT32_MAX.
void add_labels(ReportFile& report, std::string_view name, std::span<const std::uint32_t> labels,
                bool none);

}  // namespace ph::report
