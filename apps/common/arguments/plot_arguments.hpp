// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/arguments/option_scope.hpp"
#include "ph/io/plot.hpp"

namespace ph::app {

class Options;

/// A static picture to draw.
struct Plot {
  std::string path;
  std::string kind;               ///< a word of --plot-kind
  std::string option = "--plot";  ///< the option that named the path

  /// True if the file name ends in .png. A name with an unknown ending means SVG.
  bool is_png() const;
  bool is_svg() const;  ///< true if the file name ends in .svg
  /// True if the picture shows bars, as a barcode, a diagram or Betti curves.
  bool shows_bars() const { return plot_kind_named(kind).has_value(); }
};

/// @throws Error (usage) unless the name ends in .svg or .png, or names a folder; Error
/// (not_built_in) if this build cannot draw a PNG.
void require_known_format(const Plot& plot);

/// The content of a plot's file. @param what a barcode, a merge tree or a coloured picture.
template <class What>
std::string drawn(const Plot& plot, const What& what, const PlotOptions& options,
                  const RunContext& context) {
  return plot.is_png() ? png_plot(what, options, context) : svg_plot(what, options);
}

/// An option for the look of plots, and the plots to which it applies.
struct PlotLook {
  std::string option;
  bool (*fits)(const Plot& plot);
  /// A word for the plots that the option is meant for, such as "bars". It occurs in the message
  /// that the option applies to no plot.
  std::string meant_for;
};

/// The options --plot, --plot-kind and the look of plots, as they were typed.
struct PlotArguments {
  Scope scope;  ///< the situations in which plots are drawn
  std::vector<std::string> paths, kinds;
  PlotOptions look;             ///< the look of all plots: title, size, axis, dimensions
  std::vector<PlotLook> looks;  ///< the options that set the look

  /// Pairs each picture with its kind, in turn. The last kind applies to all further pictures.
  /// @param usual the kind of all pictures if none is given.
  /// @throws Error (usage) if there are more kinds than pictures, if two pictures have the same
  /// file, or if a look applies to none of them.
  std::vector<Plot> together(std::string_view usual) const;
};

/// Registers the plot options that all programs have. They come first in the topic `pictures`.
/// `kinds` and `to` must outlive `options`.
void add_plot_options(Options& options, std::span<const std::string_view> kinds,
                      const std::string& description, PlotArguments& to);

/// Registers another option for the look of plots. @param take stores the value of the option in
/// `to.look`.
void add_plot_look(Options& options, const PlotLook& look, const std::string& placeholder,
                   const std::string& what, PlotArguments& to,
                   std::function<void(const std::string& text)> take);

}  // namespace ph::app
