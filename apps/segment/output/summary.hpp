// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/segment/output/outputs.hpp"

namespace ph::segment {

/// The summary as JSON, with the columns of the paper's Table I and more. An infinite number is
/// null.
std::string json_summary(const Arguments& arguments, const Segmentation& segmentation,
                         const RunInfo& info);

/// A table of the segments for people, with one segment per line.
std::string text_summary(const Segmentation& segmentation);

/// The place where two segments join, in one line. @throws Error (usage) like first_meeting.
std::string explanation(const Segmentation& segmentation, std::uint32_t a, std::uint32_t b);

/// One line about the run, which also states how many points are in range and before the plane.
std::string one_line_summary(const Segmentation& segmentation);

}  // namespace ph::segment
