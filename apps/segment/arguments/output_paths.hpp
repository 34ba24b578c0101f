// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/common/arguments/plot_arguments.hpp"
#include "apps/common/files/file_identity.hpp"

namespace ph::segment {

/// The content of a file.
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

/// An option that requests a file.
struct OutputOption {
  OutputKind kind;
  std::string_view option;  ///< such as "--output"
  /// Null for --plot, which may request several files.
  std::string OutputPaths::*path;
  std::string_view names, help;  ///< the names and the description of the option in --help
  /// The situations in which the option has an effect.
  app::Scope scope = {};
  /// The extensions that the file may have. In a folder of results, the file has the first of these
  /// extensions. If there are none, any extension is accepted.
  std::span<const std::string_view> extensions;
  /// True if the file depends on labels, or on colours.
  bool shows_labels = false, shows_colours = false;
};

/// The options that request files, in the order of --help.
std::span<const OutputOption> output_options();

/// The files to write. An empty path means that the file is not requested.
struct OutputPaths {
  std::string output;            ///< the cloud with its labels
  std::string labels;            ///< one label per point
  std::string surfaces;          ///< one number of a surface per point
  std::string json;              ///< the summary
  std::string tree;              ///< the merge tree
  std::string barcode;           ///< the barcode of H0
  std::string coloured;          ///< the cloud with one colour per segment
  std::string picture;           ///< the image with one colour per segment
  std::string report;            ///< the interactive page
  std::vector<app::Plot> plots;  ///< pictures of the barcode, the tree or the cloud
  PlotOptions look = {};         ///< the look of the pictures

  /// Calls visit(option, path, plot) for each requested file. `plot` is null for all files except
  /// plots.
  template <class Visit>
  void each(Visit&& visit) const {
    each_of(*this, visit);
  }
  /// The requested files, with their options.
  std::vector<app::Written> written() const;
  /// The requested files that a stream writes for each of its frames, with their options.
  std::vector<app::Written> of_each_frame() const;
  /// The files of one frame. @param name represents the frame in the names of its files.
  OutputPaths filled(const std::string& name) const;

  bool any() const { return !written().empty(); }
  bool to_standard_output() const;
  /// True if a requested file has the given property, such as &OutputOption::shows_labels.
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
