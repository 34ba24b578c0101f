// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/detail/report/provenance.hpp"
#include "ph/segment.hpp"

namespace ph::report {

/// What the page of a segmentation shows. What is referred to outlives the page.
struct ScenePage {
  std::string title;
  const segment::Segmentation& segmentation;
  const Cloud* cloud = nullptr;             ///< null: a stored tree was cut; its points are shown
  std::vector<std::uint32_t> numbers = {};  ///< what each segment is called; empty: by its label
  /// How another cut is made, "{cut}" standing for its value; empty: the page does not say.
  std::vector<std::string> cut_command = {};
  /// The description of the input, and notes on the method, are added.
  Provenance provenance = {};
};

/// Writes the page: the points with their colours, normals and ground truth (which the segmentation
/// never reads), the segments and the surfaces of the segmentation with what is said of them, the
/// merge tree contracted to what cuts can tell apart, the bars of a length. At the cut of the
/// segmentation the page shows just that; any other cut gives the segments and surfaces of
/// `ph-segment --cut` with `--min-seam 0 --parts`.
/// @throws Error (not_built_in) without a page; Error (resource, cancelled); what `sink` throws.
void write_page(const Sink& sink, const ScenePage& page, const RunContext& context);

}  // namespace ph::report
