// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// A static picture to draw.
struct Plot {
  std::string path;
  std::string kind;  ///< a word of --plot-kind
};

/// --plot and --plot-kind as they were typed.
struct PlotArguments {
  std::vector<std::string> paths, kinds;

  /// Each picture with its kind: in turn, the last kind counts for the rest.
  /// @param usual kind of all if none is given.
  /// @throws Error (usage) if there are more kinds than pictures, or two pictures in one file.
  std::vector<Plot> together(std::string_view usual) const;
};

/// Registers both. @param kinds outlives `app`, as `to` does. @param files "FILE.svg".
void add_plot_options(CLI::App& app, std::span<const std::string_view> kinds,
                      const std::string& files, const std::string& description,
                      const std::string& group, PlotArguments& to);

}  // namespace ph::app
