// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/barcode/job/job.hpp"
#include "apps/barcode/job/own_complex.hpp"
#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/arguments/plot_arguments.hpp"
#include "apps/common/manual/manual.hpp"
#include "ph/alpha.hpp"
#include "ph/cubical.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "ph/voxel_image.hpp"

namespace ph::barcode {

/// In the order of complex_names(); `own`: one that the program has added.
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

/// Whether it is made of a triangulation of points.
constexpr bool is_triangulated(ComplexKind kind) {
  return kind >= ComplexKind::alpha && kind <= ComplexKind::delaunay_rips;
}

/// Whether bars of H1 that come with cycles come with loops, too.
enum class LoopChoice { tight, plain, none };

/// Everything the command line says.
struct Arguments {
  app::CommonOptions common;
  std::vector<std::string> inputs;

  // How the input is read.
  Format format = Format::automatic;
  ReadOptions read;
  std::string values;  // path; empty: none
  struct Delay {
    Index dimension, delay;
  };
  std::optional<Delay> delay;  // the input is a time series, its windows are the points

  // Which complex is built of it.
  ComplexKind complex = ComplexKind::automatic;
  const OwnComplex* own_complex = nullptr;  // of ComplexKind::own
  std::optional<double> threshold;
  RipsOptions rips;
  std::string vertex_weights;  // path; empty: none
  std::optional<AlphaOptions::Unit> alpha_unit;
  std::string weights;         // path; empty: none
  std::vector<double> period;  // one for all axes, or one an axis; empty: none closes up
  CubicalOptions cubical;
  std::optional<double> voxel;  // of points, in their unit
  VoxelValue voxel_value = VoxelValue::distance;

  // What is computed.
  Options options;
  std::optional<LoopChoice> loops;  // empty: not said, which is tight
  bool check = false;
  bool significance = false;  // a p-value for each bar
  bool dry_run = false;

  // Which part of it, on which machine.
  struct Part {
    int number, of;  // numbers from 0 on
  };
  std::optional<Part> part;
  bool on_ranks = false;                   // the program has several processes
  bool joins = false;                      // the inputs are parts
  bool resumes = false;                    // a part that is there already is kept
  bool keeps_cells = false;                // of bars, in a part
  std::vector<std::string> typed_options;  // with --part: what results depend on, as it was typed

  // Where it goes.
  std::string output = "-";
  std::optional<BarcodeFormat> output_format;
  std::vector<app::Plot> plots;
  PlotOptions look;  // of the plots
  std::vector<Surface> surfaces;
  std::string report;                // path; empty: none
  bool stored = false;               // the inputs are barcodes: `ph-barcode plot BARS…`
  std::vector<std::string> compare;  // two barcode files; empty: a barcode is computed
  std::vector<std::string> notes;    // on the command line itself, to be said once
  std::vector<std::string> command;  // as it was typed, for the report
  // The options that were given of those that do nothing for some inputs.
  std::vector<app::GivenOption> given;

  /// Whether the merge tree is asked for by itself.
  bool draws_tree() const;
  /// Whether a part of one input is asked for, or all parts on ranks; else of several inputs. It is
  /// an image unless --complex rips says that it is points.
  bool wants_part_of_one() const;
  bool wants_image_part() const { return wants_part_of_one() && complex != ComplexKind::rips; }
  /// Whether each input has files of its own, in folders.
  bool is_batch() const;
};

/// Reads the command line; prints nothing.
/// @return the answer to --help, --version or --formats, which is all that is left to do.
/// @throws Error (usage) that names the option; Error (not_built_in).
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// What the program says of itself beside its options.
const app::Manual& manual();
/// The same of ph-barcode-mpi.
const app::Manual& manual_of_ranks();

/// The answer to --formats: what is read and what is written, a format each, with an example.
std::string formats_table();

}  // namespace ph::barcode

namespace ph {

template <>
inline constexpr std::array names_of<barcode::LoopChoice>{
    Named{barcode::LoopChoice::tight, "tight"},
    Named{barcode::LoopChoice::plain, "plain"},
    Named{barcode::LoopChoice::none, "none"},
};

}  // namespace ph
