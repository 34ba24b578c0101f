// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/barcode/job/own_complex.hpp"
#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/arguments/plot_arguments.hpp"
#include "ph/alpha.hpp"
#include "ph/cubical.hpp"
#include "ph/detail/core/loop.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "ph/voxel_image.hpp"

namespace ph::barcode {

/// The kinds of complexes, in the order of complex_names(). `own` is a complex that a program has
/// added (see OwnComplex).
enum class ComplexKind {
  automatic,
  rips,
  cubical,
  explicit_cells,
  lower_star,
  alpha,
  delaunay_cech,
  delaunay_rips,
  own
};

/// True if the complex is made from a triangulation of the points.
constexpr bool is_triangulated(ComplexKind kind) {
  return kind >= ComplexKind::alpha && kind <= ComplexKind::delaunay_rips;
}

/// The delay embedding of a time series. Each window of the series becomes a point.
struct Delay {
  Index dimension, delay;
};

/// The way to read an input.
struct Reading {
  Format format = Format::automatic;
  ReadOptions options;
  std::string values;          ///< a path; empty if there is none
  std::optional<Delay> delay;  ///< empty if the input is not a time series
};

/// The computation that an input requires: a complex, and the task for its homology.
struct Question {
  ComplexKind complex = ComplexKind::automatic;
  const OwnComplex* own_complex = nullptr;  ///< for ComplexKind::own
  std::optional<double> threshold;
  RipsOptions rips;
  std::string vertex_weights;  ///< a path; empty if there is none
  std::optional<AlphaOptions::Unit> alpha_unit;
  std::string weights;  ///< a path; empty if there is none
  /// One period for all axes, or one period for each axis; empty if no axis is periodic.
  std::vector<double> period;
  CubicalOptions cubical;
  std::optional<double> voxel;  ///< the edge of a voxel, in the unit of the points
  VoxelValue voxel_value = VoxelValue::distance;
  Options options;
};

/// The results to compute in addition to the bars, and the form of all results.
struct Results {
  std::optional<LoopChoice> loops;  ///< empty if not given; the default is tight
  bool check = false;
  bool significance = false;  ///< true if a p-value for each bar is requested
  bool dry_run = false;
  /// The format that --output-format names; empty if it is not given.
  std::optional<BarcodeFormat> output_format;
  PlotOptions look;  ///< the look of the plots
};

/// The surface of an alpha complex at a value, as a file of triangles.
struct Surface {
  double value = 0;
  std::string path;
  bool is_wrap = false;  ///< true for the surface of the wrap complex
  std::string option() const { return is_wrap ? "--wrap" : "--alpha-shape"; }
};

/// One input, and the destinations of its results. If there are several inputs, the destinations in
/// the job are folders or patterns, and each input gets places of its own.
struct Places {
  std::string input = {};  ///< if empty, the inputs of the job are used
  std::string output = "-";
  /// The format of the barcode, once it has been determined.
  BarcodeFormat format = BarcodeFormat::csv;
  std::vector<app::Plot> plots = {};
  std::string report = {};  ///< empty if there is no report
  std::vector<Surface> surfaces = {};
  Barcode* bars = nullptr;  ///< receives the bars, unless it is null
};

/// The share of the work that this process does.
struct Sharing {
  struct Part {
    int number, of;  // `number` counts from 0
  };
  std::optional<Part> part;
  bool on_ranks = false;     ///< true if the program has several processes
  bool joins = false;        ///< true if the inputs are parts
  bool resumes = false;      ///< true if a part that exists already is kept
  bool keeps_cells = false;  ///< true if parts store the cells of bars
  /// With --part, the options that affect results, as typed.
  std::vector<std::string> typed_options;
};

/// Everything that the command line requests.
struct Job {
  app::CommonOptions common;
  std::vector<std::string> inputs;
  Reading reading;
  Question question;
  Results results;
  Places places;
  Sharing sharing;
  /// True if the inputs are barcodes, as in `ph-barcode plot BARS…`.
  bool stored = false;
  std::vector<std::string> compare;  ///< two barcode files; if empty, a barcode is computed
  std::vector<std::string> notes;    ///< notes about the command line, to be printed once
  std::vector<std::string> command;  ///< the command as typed, for the report
  /// The given options that have no effect for some inputs.
  std::vector<app::GivenOption> given;
  bool of_batch = false;  ///< true if `places` belongs to one input of a batch

  /// True if the command line requests a plot of the merge tree.
  bool draws_tree() const;
  /// True if CSV gets the places of the cycles of points.
  bool writes_centroids() const;
  /// True if this is a folder whose files are inputs. With --stack, a folder is one input.
  bool is_folder_of_inputs(const std::string& path) const;
  /// True if a single input is computed in parts. With --part, the run computes one part. On ranks,
  /// it computes all parts. False if --part selects some of several inputs. The input is an image,
  /// unless --complex rips says that it consists of points.
  bool wants_part_of_one() const;
  bool wants_image_part() const {
    return wants_part_of_one() && question.complex != ComplexKind::rips;
  }
  /// True if the run is a batch, in which each input has its own output files.
  bool is_batch() const;
};

/// The outcome of one input.
struct Outcome {
  int code = 0;
  std::string summary;  ///< such as "1024 points in R^3, CSV: 57 bars"
};

}  // namespace ph::barcode
