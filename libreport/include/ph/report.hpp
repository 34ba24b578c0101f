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

/// The contents of a barcode's page. Everything that it refers to must outlive the page.
struct BarcodePage {
  std::string title;
  const Barcode& barcode;
  /// The data from which the barcode was computed. Null: only the bars are shown, without cells,
  /// because the data of these cells are not here.
  const AnyComplex* complex = nullptr;
  /// For a Rips filtration, the form of it that has these bars.
  std::optional<RipsForm> form = {};
  /// The vertices of the complex in space, at least one, unless they are those of a grid.
  std::optional<PointsView> points = {};
  /// The numbers of the points in the cells of the barcode; empty: their own numbers.
  std::span<const Index> point_ids = {};
  /// True if the edges at a distance are all pairs of points within it: then the page finds them
  /// itself.
  bool is_euclidean = false;
  bool has_axes_of_space = false;   ///< true if the first axis of an image with three axes is x
  const ShownTree* tree = nullptr;  ///< tree of the complex; null: not shown
  bool negated = false;  ///< values are minus those of the data; for an image it is known
  /// Notes about anything that is not shown are added.
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
