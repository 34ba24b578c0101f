// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "segment/output/outputs.hpp"

namespace ph::segment {

/// The summary as JSON: the paper's Table I and more. An infinite number is null.
std::string json_summary(const Arguments& arguments, const Segmentation& segmentation,
                         const RunInfo& info);

/// A table of the segments for people, one a line.
std::string text_summary(const Segmentation& segmentation);

/// Where two segments join, in a line. @throws Error (usage) as first_meeting.
std::string explanation(const Segmentation& segmentation, std::uint32_t a, std::uint32_t b);

/// The run in one line: what each stage left.
std::string one_line_summary(const Segmentation& segmentation);

}  // namespace ph::segment
