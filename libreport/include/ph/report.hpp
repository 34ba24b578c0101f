// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>

#include "ph/detail/report/provenance.hpp"
#include "ph/detail/report/shown_tree.hpp"
#include "ph/persistence.hpp"
#include "ph/points.hpp"

namespace ph::report {

/// The contents of a barcode's page. All objects to which it refers must outlive it.
struct BarcodePage {
  std::string title;
  const Barcode& barcode;
  /// The data from which the barcode was computed. Null: only the bars are shown, without cells,
  /// because the data behind the cells are missing.
  const AnyComplex* complex = nullptr;
  /// For a Rips filtration, the form from which the bars were computed.
  std::optional<RipsForm> form = {};
  /// The positions of the complex's vertices, at least one; empty for the vertices of a grid.
  std::optional<PointsView> points = {};
  /// The numbers by which the cells of the barcode name the points; empty: 0, 1, 2, ….
  std::span<const Index> point_ids = {};
  /// True if the edges up to each distance are exactly the pairs of points that are no farther
  /// apart. The page then finds the edges itself.
  bool is_euclidean = false;
  bool has_axes_of_space = false;   ///< true if the first axis of an image with three axes is x
  const ShownTree* tree = nullptr;  ///< tree of the complex; null: not shown
  /// True if values are the negated values of the data. Not used for an image, which states this
  /// itself.
  bool negated = false;
  /// The origin of the page's contents; write_page adds notes about anything that is not shown.
  Provenance provenance = {};
};

/// Writes the page: the bars with their cells and chains, the points or the image (with two or
/// three axes, if it is not too large), the parts of the complex that the page cannot derive, and
/// the merge tree.
/// @throws Error (not_built_in) if this build has no page; Error (bad_data) on bars of dimension
/// 256 or higher;
///         Error (resource, cancelled); what `sink` throws.
void write_page(const Sink& sink, const BarcodePage& page, const RunContext& context);

}  // namespace ph::report
