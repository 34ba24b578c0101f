// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/components/branch.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// What a plot of a barcode shows.
enum class PlotKind {
  barcode,  ///< one line a bar over the filtration value; a triangle ends an infinite one
  diagram,  ///< one point a bar: birth across, death up, infinity on a line of its own
  betti,    ///< the number of living bars over the filtration value, one curve a dimension
};
std::optional<PlotKind> plot_kind_named(std::string_view name);

/// Of a whole picture, pixels; in SVG the pixels of CSS.
struct PlotSize {
  int width = 0, height = 0;  ///< 1 to kMostPlotPixels
};
inline constexpr int kMostPlotPixels = 10'000;

/// What of the filtration values is on the axis. Classes beyond it are counted, not drawn.
struct PlotAxis {
  std::optional<double> low, high;  ///< low < high; empty: as far as the values go
  bool logarithmic = false;         ///< values of at most 0 lie at the end of small ones
};

/// How a barcode is drawn.
struct PlotOptions {
  PlotKind kind = PlotKind::barcode;
  std::string title;                             ///< empty: none
  std::string value_label = "Filtration value";  ///< names the axis and, in brackets, its unit
  std::vector<int> dims = {};                    ///< of a barcode that are drawn; empty: all
  std::optional<PlotSize> size = {};  ///< the picture fits into it, white around it; default: 88 mm
  PlotAxis axis = {};
  /// The values are those of negated data (superlevel sets): the axis names the data's own, which
  /// then fall from left to right. `axis` is of the data's own.
  bool negated = false;
};

/// A picture of a barcode as a complete SVG document, sized for a column of a paper (88 mm).
/// Text stays text. However many bars there are, the file stays below 1 MB: what cannot be told
/// apart is drawn once.
/// @throws Error (usage) on an axis without room: low >= high, or logarithmic from at most 0.
std::string svg_plot(const Barcode& barcode, const PlotOptions& options = {});

/// The same of a merge tree (MergeTree::branches): one line a class over the filtration value, and
/// where it dies a line to the class that it joins. Those of little persistence are a density.
/// `options.kind` has no say. @throws Error (bad_data) on NaN, or an elder branch that is not
/// there.
std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options = {});

/// A picture made of points or pixels whose colours have names.
struct ColouredPicture {
  struct Entry {
    std::optional<std::uint32_t> colour;  ///< 0x00RRGGBB; none: text alone
    std::string name, value;
  };
  /// A word on the picture, with white around it.
  struct Mark {
    double x, y;  ///< of its middle, pixels of the raster
    std::string text;
  };
  Raster raster;  ///< at most 1040 pixels wide fill the column, without scaling in a PNG
  std::vector<Mark> marks;
  std::string heading;        ///< says what the names and the values are
  std::vector<Entry> legend;  ///< in columns below the picture; empty: nothing is below it
  std::string description;    ///< for those who cannot see it
};

/// The raster as it is, embedded, with the legend as text.
/// `options.title` is above it, `options.kind` and `options.value_label` have no say.
/// @throws Error (bad_data) if the sizes of the raster disagree.
std::string svg_plot(const ColouredPicture& picture, const PlotOptions& options = {});

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
