// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/arguments/plot_arguments.hpp"
#include "common/files/file_identity.hpp"

namespace ph::segment {

/// What a file holds.
enum class OutputKind {
  cloud,
  labels,
  surfaces,
  json,
  tree,
  barcode,
  plot,
  coloured,
  picture,
  report
};

struct OutputPaths;

/// An option that asks for a file.
struct OutputOption {
  OutputKind kind;
  std::string_view option;         ///< "--output"
  std::string OutputPaths::*path;  ///< null: --plot, which may ask for several
  std::string_view names, help;    ///< of the command line
  /// What its name may end in; a file in a folder of results ends in the first. Empty: in anything.
  std::span<const std::string_view> extensions;
  bool shows_labels = false, shows_colours = false;  ///< labels of segments, colours of points
};

/// All of them, in the order of --help.
std::span<const OutputOption> output_options();

/// The files to write. An empty path: not asked for.
struct OutputPaths {
  std::string output;            ///< the cloud with its labels
  std::string labels;            ///< one label a point
  std::string surfaces;          ///< one number of a surface a point
  std::string json;              ///< the summary
  std::string tree;              ///< the merge tree
  std::string barcode;           ///< H0
  std::string coloured;          ///< the cloud with a colour a segment
  std::string picture;           ///< the image with a colour a segment
  std::string report;            ///< the page to look at
  std::vector<app::Plot> plots;  ///< figures of what is in it
  PlotOptions look = {};         ///< of the figures

  /// Calls visit(option, path, plot) for each file that is asked for; `plot` is null of all others.
  template <class Visit>
  void each(Visit&& visit) const {
    each_of(*this, visit);
  }
  /// Those that are asked for, with their options.
  std::vector<app::Written> written() const;
  /// Of these the ones that a stream has for each of its frames.
  std::vector<app::Written> of_each_frame() const;
  /// Those of one frame. @param name what stands for it in the names of its files.
  OutputPaths filled(const std::string& name) const;

  bool any() const { return !written().empty(); }
  bool to_standard_output() const;
  /// Whether one of them shows that: &OutputOption::shows_labels.
  bool show(bool OutputOption::*what) const;

 private:
  template <class Paths, class Visit>
  static void each_of(Paths& paths, Visit&& visit) {
    for (const OutputOption& option : output_options()) {
      if (option.path) {
        if (!(paths.*option.path).empty())
          visit(option, paths.*option.path, static_cast<const app::Plot*>(nullptr));
        continue;
      }
      for (auto& plot : paths.plots) visit(option, plot.path, &std::as_const(plot));
    }
  }
};

}  // namespace ph::segment
