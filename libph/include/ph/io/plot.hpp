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

/// The kinds of plots of a barcode.
enum class PlotKind {
  barcode,  ///< one line per bar over the filtration value; a triangle ends an infinite bar
  diagram,  ///< one point per bar: birth on the horizontal axis, death on the vertical axis,
            ///< infinite deaths on a line of their own
  betti,    ///< number of living bars over the filtration value, one curve per dimension
};
std::optional<PlotKind> plot_kind_named(std::string_view name);

/// The size of an entire picture in pixels; in SVG, CSS pixels.
struct PlotSize {
  int width = 0, height = 0;  ///< 1 to kMostPlotPixels
};
inline constexpr int kMostPlotPixels = 10'000;

/// The range of filtration values on the axis. Bars outside the range are counted, not drawn.
struct PlotAxis {
  std::optional<double> low, high;  ///< low < high; empty: up to the extreme values
  bool logarithmic = false;         ///< values of at most 0 are drawn at the low end
};

/// The appearance of a plot of a barcode.
struct PlotOptions {
  PlotKind kind = PlotKind::barcode;
  std::string title;                             ///< empty if there is none
  std::string value_label = "Filtration value";  ///< names the axis and, in brackets, its unit
  std::vector<int> dims = {};                    ///< dimensions of a barcode to draw; empty: all
  /// The picture is fitted into this size, with white margins; default: 88 mm wide.
  std::optional<PlotSize> size = {};
  PlotAxis axis = {};
  /// True if values belong to negated data (superlevel sets): the axis shows the data's own values,
  /// which then decrease from left to right. `axis` is in the data's own values.
  bool negated = false;
};

/// A picture of a barcode as a complete SVG document, sized for a column of a paper (88 mm). Text
/// is stored as text. The file stays below 1 MB for any number of bars: bars that cannot be told
/// apart are drawn once.
/// @throws Error (usage) on an empty axis: low >= high, or a logarithmic one that starts at 0 or
/// below.
std::string svg_plot(const Barcode& barcode, const PlotOptions& options = {});

/// A picture of a merge tree (MergeTree::branches): one line per class over the filtration value,
/// and at its death a line to the class that it joins. Classes of little persistence are drawn as a
/// density. `options.kind` is ignored. @throws Error (bad_data) on NaN, or if a branch names an
/// elder branch that does not exist.
std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options = {});

/// A picture made of points or pixels whose colours have names.
struct ColouredPicture {
  struct Entry {
    std::optional<std::uint32_t> colour;  ///< 0x00RRGGBB; if empty, the entry is only text
    std::string name, value;
  };
  /// A word on the picture, with white around it.
  struct Mark {
    double x, y;  ///< its centre, in pixels of the raster
    std::string text;
  };
  Raster raster;  ///< at most 1040 pixels wide; a PNG shows such a raster without scaling
  std::vector<Mark> marks;
  std::string heading;        ///< says what the names and the values mean
  std::vector<Entry> legend;  ///< in columns below the picture; if empty, nothing is below it
  std::string description;    ///< describes the picture for readers who cannot see it
};

/// Embeds the raster unchanged, with the legend as text. `options.title` is written above the
/// picture; `options.kind` and `options.value_label` are ignored.
/// @throws Error (bad_data) if the sizes of the raster disagree.
std::string svg_plot(const ColouredPicture& picture, const PlotOptions& options = {});

/// The libraries that draw the text of PNG plots, such as "FreeType 2.12.1, DejaVu Sans"; empty if
/// PNG plots are not built in.
std::string png_plot_support();

/// The pictures of svg_plot() as complete PNG files. Without options.size, they are 1040 pixels
/// wide, which is 88 mm at 300 dots per inch, the resolution stored in the file. The same input
/// gives the same pixels, whatever fonts are installed.
/// @throws Error (not_built_in) if the library was built without FreeType; Error (resource) if the
/// pixels exceed the memory limit.
std::string png_plot(const Barcode& barcode, const PlotOptions& options = {},
                     const RunContext& context = default_context());
std::string png_plot(std::span<const Branch> tree, const PlotOptions& options = {},
                     const RunContext& context = default_context());
/// @throws Error (bad_data) also if the sizes of the raster disagree.
std::string png_plot(const ColouredPicture& picture, const PlotOptions& options = {},
                     const RunContext& context = default_context());

}  // namespace ph
