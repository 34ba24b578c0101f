// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "report/report_file.hpp"

namespace ph::report {

/// Writes points/position. Stored as 16-bit numbers over their box where a step of these is at most
/// `tolerance` on every axis, else as they are.
/// @param coordinates finite, `dims` (1 to 3) a point.
template <class Real>
void add_positions(ReportFile& report, std::span<const Real> coordinates, std::size_t dims,
                   double tolerance);

/// A unit normal as two numbers of an octahedron; -128, -128 of one that is not finite.
std::array<std::int8_t, 2> octahedral(double x, double y, double z);

/// Writes labels from 0 in the narrowest type that holds them and, with `none`, one more number,
/// the largest of the type, which stands for UINT32_MAX.
void add_labels(ReportFile& report, std::string_view name, std::span<const std::uint32_t> labels,
                bool none);

}  // namespace ph::report
