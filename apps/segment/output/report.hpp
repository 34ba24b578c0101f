// SPDX-License-Identifier: MIT
#pragma once
#include "segment/output/outputs.hpp"

namespace ph::segment {

/// Writes the interactive report: the points with their colours, normals and ground truth (which
/// the segmentation never reads), the merge tree contracted to what cuts can tell apart, the bars
/// of a length. A cut of the page gives the segments of `ph-segment --cut` with --parts; where the
/// program joined parts, the page does so at the program's own cut. The caller commits the file.
/// @param cloud null: a stored tree was cut; its points are shown.
/// @throws Error (io, resource, cancelled).
void write_report(OutputFile& file, const Cloud* cloud, const Segmentation& segmentation,
                  const RunInfo& info, const Arguments& arguments, const RunContext& context);

}  // namespace ph::segment
