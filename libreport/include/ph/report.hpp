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

/// What the page of a barcode shows. What is referred to outlives the page.
struct BarcodePage {
  std::string title;
  const Barcode& barcode;
  /// What it is the barcode of. Null: the bars are all that is shown, without cells, for these are
  /// cells of data that are not here.
  const AnyComplex* complex = nullptr;
  /// Of a Rips filtration the form whose bars they are.
  std::optional<RipsForm> form = {};
  /// The vertices of the complex in space, at least one, unless they are those of a grid.
  std::optional<PointsView> points = {};
  /// The numbers that the points have in the cells of the barcode; empty: their own.
  std::span<const Index> point_ids = {};
  /// Whether all pairs of points within a distance are the edges at that distance: the page finds
  /// them.
  bool is_euclidean = false;
  bool has_axes_of_space = false;   ///< the first axis of an image of three is x
  const ShownTree* tree = nullptr;  ///< of the complex; null: not shown
  bool negated = false;             ///< values are minus those of the data; of an image it is known
  /// Notes on what is not shown are added.
  Provenance provenance = {};
};

/// Writes the page: the bars, their cells and chains, the points or the image (of two or three
/// axes, if it is not too large), what the page cannot find out for itself of the complex, the
/// merge tree.
/// @throws Error (not_built_in) without a page; Error (bad_data) on bars of dimension 256 or
/// higher;
///         Error (resource, cancelled); what `sink` throws.
void write_page(const Sink& sink, const BarcodePage& page, const RunContext& context);

}  // namespace ph::report
