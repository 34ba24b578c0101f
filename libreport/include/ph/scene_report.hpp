// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/detail/report/provenance.hpp"
#include "ph/segment.hpp"

namespace ph::report {

/// The contents of a segmentation's page. All objects to which it refers must outlive it.
struct ScenePage {
  std::string title;
  const segment::Segmentation& segmentation;
  const Cloud* cloud = nullptr;  ///< null: a stored tree was cut; the page shows the tree's points
  std::vector<std::uint32_t> numbers = {};  ///< name of each segment; empty: its label
  /// The command for another cut, "{cut}" standing for its value; empty: the page does not show
  /// one.
  std::vector<std::string> cut_command = {};
  /// The origin of the page's contents; write_page adds the description of the input and notes on
  /// the method.
  Provenance provenance = {};
};

/// Writes the page: the points with their colours, normals and ground truth (which the segmentation
/// never reads), the segments and surfaces with their properties, the merge tree (in which vertices
/// that no cut can separate are contracted), and the bars of positive length. At the cut of the
/// segmentation, the page shows exactly this segmentation; any other cut gives the segments and
/// surfaces of `ph-segment --cut` with `--parts`.
/// @throws Error (not_built_in) if this build has no page; Error (resource, cancelled); errors of
///     `sink`.
void write_page(const Sink& sink, const ScenePage& page, const RunContext& context);

}  // namespace ph::report
