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
/// added; see OwnComplex.
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

/// The delay embedding of a time series: each window of the series becomes a point.
struct Delay {
  Index dimension, delay;
};

/// The way to read an input.
struct Reading {
  Format format = Format::automatic;
  ReadOptions options;
  std::string values;          ///< path; empty: none
  std::optional<Delay> delay;  ///< empty: the input is not a time series
};

/// The question about an input: a complex, and the task for its homology.
struct Question {
  ComplexKind complex = ComplexKind::automatic;
  const OwnComplex* own_complex = nullptr;  ///< for ComplexKind::own
  std::optional<double> threshold;
  RipsOptions rips;
  std::string vertex_weights;  ///< path; empty: none
  std::optional<AlphaOptions::Unit> alpha_unit;
  std::string weights;         ///< path; empty: none
  std::vector<double> period;  ///< one for all axes, or one per axis; empty: no axis closes up
  CubicalOptions cubical;
  std::optional<double> voxel;  ///< edge of a voxel, in the unit of the points
  VoxelValue voxel_value = VoxelValue::distance;
  Options options;
};

/// The results to compute besides the bars, and the form of all results.
struct Results {
  std::optional<LoopChoice> loops;  ///< empty: not given; tight is the default
  bool check = false;
  bool significance = false;  ///< a p-value per bar
  bool dry_run = false;
  std::optional<BarcodeFormat> output_format;  ///< as --output-format names it; empty: not given
  PlotOptions look;                            ///< look of the plots
};

/// The surface of an alpha complex at a value, as a file of triangles.
struct Surface {
  double value = 0;
  std::string path;
  bool is_wrap = false;  ///< true for the surface of the wrap complex
  std::string option() const { return is_wrap ? "--wrap" : "--alpha-shape"; }
};

/// One input, and the destinations of its results. If there are several inputs, the command line
/// has folders or patterns here, and each input gets its own places.
struct Places {
  std::string input = {};  ///< empty: the inputs of the job
  std::string output = "-";
  BarcodeFormat format = BarcodeFormat::csv;  ///< of the barcode, once it is settled
  std::vector<app::Plot> plots = {};
  std::string report = {};  ///< empty: none
  std::vector<Surface> surfaces = {};
  Barcode* bars = nullptr;  ///< receives the bars, if not null
};

/// The share of the work that this process does.
struct Sharing {
  struct Part {
    int number, of;  // `number` counts from 0
  };
  std::optional<Part> part;
  bool on_ranks = false;     ///< the program has several processes
  bool joins = false;        ///< the inputs are parts
  bool resumes = false;      ///< a part that exists already is kept
  bool keeps_cells = false;  ///< parts store the cells of bars
  /// With --part: the options that affect results, as typed.
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
  bool stored = false;               ///< the inputs are barcodes: `ph-barcode plot BARS…`
  std::vector<std::string> compare;  ///< two barcode files; empty: a barcode is computed
  std::vector<std::string> notes;    ///< notes about the command line, to be printed once
  std::vector<std::string> command;  ///< as typed, for the report
  /// The given options that have no effect for some inputs.
  std::vector<app::GivenOption> given;
  bool of_batch = false;  ///< `places` belongs to one input of a batch

  /// True if the command line asks for a plot of the merge tree.
  bool draws_tree() const;
  /// True if a single input is computed in parts: one part with --part, or all parts on ranks.
  /// False if --part selects some of several inputs. The input is an image, unless --complex rips
  /// says that it consists of points.
  bool wants_part_of_one() const;
  bool wants_image_part() const {
    return wants_part_of_one() && question.complex != ComplexKind::rips;
  }
  /// True if the run is a batch: each input has its own output files.
  bool is_batch() const;
};

/// The outcome of one input.
struct Outcome {
  int code = 0;
  std::string summary;  ///< "1024 points in R^3, CSV: 57 bars"
};

}  // namespace ph::barcode
