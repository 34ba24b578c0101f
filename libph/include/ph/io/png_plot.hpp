// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>

#include "ph/io/svg_plot.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// What draws the text of PNG plots, "FreeType 2.12.1, DejaVu Sans"; empty: they are not built in.
std::string png_plot_support();

/// The pictures of svg_plot() as complete PNG files: 1040 pixels wide, which are 88 mm at 300 dots
/// an inch, and the file says so. The same input gives the same pixels, whatever fonts there are.
/// @throws Error (not_built_in) if the library was built without FreeType; Error (resource) if the
/// pixels exceed the memory limit.
std::string png_plot(const Barcode& barcode, const PlotOptions& options = {},
                     const RunContext& context = default_context());
std::string png_plot(std::span<const Branch> tree, const PlotOptions& options = {},
                     const RunContext& context = default_context());
/// @throws Error (bad_data) too, if the sizes of the raster disagree.
std::string png_plot(const ColouredPicture& picture, const PlotOptions& options = {},
                     const RunContext& context = default_context());

}  // namespace ph
