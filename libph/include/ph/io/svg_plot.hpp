// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ph/core/barcode.hpp"
#include "ph/core/branch.hpp"

namespace ph {

/// What a plot of a barcode shows.
enum class PlotKind {
  barcode,  ///< one line a bar over the filtration value; a triangle ends an infinite one
  diagram,  ///< one point a bar: birth across, death up, infinity on a line of its own
  betti,    ///< the number of living bars over the filtration value, one curve a dimension
};
std::optional<PlotKind> plot_kind_named(std::string_view name);

/// How a barcode is drawn.
struct PlotOptions {
  PlotKind kind = PlotKind::barcode;
  std::string title;                             ///< empty: none
  std::string value_label = "Filtration value";  ///< names the axis and, in brackets, its unit
};

/// A picture of a barcode as a complete SVG document, sized for a column of a paper (88 mm).
/// Text stays text. However many bars there are, the file stays below 1 MB: what cannot be told
/// apart is drawn once.
std::string svg_plot(const Barcode& barcode, const PlotOptions& options = {});

/// The same of a merge tree (MergeTree::branches): one line a class over the filtration value, and
/// where it dies a line to the class that it joins. Those of little persistence are a density.
/// `options.kind` has no say.
std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options = {});

}  // namespace ph
