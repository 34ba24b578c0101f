// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/arguments.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <string_view>

#include "apps/barcode/arguments/argument_groups.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/inputs/set_options.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/report/page_template.hpp"

namespace ph::barcode {
namespace {

using Names = std::vector<std::string_view>;

Names format_names() {
  Names names;
  for (const FormatInfo& info : formats()) names.push_back(info.name);
  return names;
}

Names output_formats() {
  Names names;
  for (const BarcodeFormatInfo& info : barcode_formats()) names.push_back(info.name);
  return names;
}

void take_report(Job& job, const std::string& path) {
  report::require_built_in();
  const bool is_place = path.ends_with('/') || app::is_folder(path);
  if (path != "-" && !is_place && !ends_in(path, ".html") && !ends_in(path, ".htm"))
    throw Error(
        ErrorKind::usage,
        fmt::format("--report: found '{}', expected a name that ends in .html or .htm", path));
  job.places.report = path;
}

void add_input_options(app::Options& options, Job& job) {
  options.topic("input");
  options.inputs(
      "INPUT",
      job.sharing.on_ranks
          ? "the image, or the points; all ranks have to see the file"
          : "files to read; - is standard input. Several, or a folder, are a batch: its outputs "
            "are folders (FOLDER/) or have a * for the input's name. A stored barcode is drawn, "
            "converted or reported again; the word plot before it says that it is one",
      job.inputs);
  static const Names formats = format_names();
  options.choice({"--format", kOfInputs.with(kSomeLayers | kSomeBlocks)}, formats,
                 "format of the input (default auto: by content and extension)",
                 [&job](std::size_t i) { job.reading.format = ph::formats()[i].format; });
  options.path(
      {"--values", kOfInputs}, "FILE",
      "values of the cells of a boundary matrix (default: their order), or of the vertices of "
      "a mesh: text, NPY, or a property of a mesh, FILE.ply:NAME",
      job.reading.values);
  options.flag({"--allow-empty", kOfInputs}, "an input without points is no error",
               job.reading.options.allow_empty);
  // mutant: scope-correlation
  app::add_matrix_options(options, kOfMatrices, kOfDistances, job.reading.options);
  options.choice(
      {"--nan",
       {kRips | kCubical | kOwn | kAlpha | kSomeLayers | kSomeBlocks,
        "points, distances and images"}},
      "what NaN means: an error (default), or a point, distance or voxel that is not there",
      job.reading.options.nan);
}

constexpr std::array<std::string_view, 4> kPlotKinds{"barcode", "diagram", "betti", "tree"};

constexpr int kAnyNumber = 1 << 20;

void take_compared(Job& job, const std::vector<std::string>& paths) {
  if (paths.size() != 2)
    throw Error(ErrorKind::usage,
                fmt::format("--compare: found {}, expected two barcodes", paths.size()));
  job.compare = paths;
}

void add_output_options(app::Options& options, Job& job) {
  options.topic("output");
  options.value(
      "-o,--output", "FILE",
      "where the barcode goes (default -: standard output); FOLDER/ for several inputs; after the "
      "word plot, where the picture goes",
      [&job](const std::string& text) {
        if (text.empty()) throw Error(ErrorKind::usage, "--output: found '', expected a path");
        job.places.output = text;
      });
  static const Names names = output_formats();
  options.choice(
      "--output-format", names, "format of the barcode (default: by extension, or csv)",
      [&job](std::size_t i) { job.results.output_format = barcode_format_named(names[i]); });
  options.value(
      {"--report", kOffRanks}, "FILE.html|.htm",
      "one page to look at: barcode, diagram, merge tree and data, linked; needs no network",
      [&job](const std::string& path) { take_report(job, path); });
  CLI::Option* compare = options.cli().add_option_function<std::vector<std::string>>(
      "--compare", [&job](const std::vector<std::string>& paths) { take_compared(job, paths); },
      "compute nothing but the bottleneck distances of two barcode files, dimension by dimension: "
      "text, or --output-format csv or json; with --report also side by side in a page; "
      "ph-distance has others");
  options.limit(compare, kOffRanks)
      ->type_name("FILE FILE")
      ->type_size(1)
      ->expected(1, kAnyNumber);  // take_compared() reports a wrong number of files
}

void add_picture_options(app::Options& options, app::PlotArguments& plots) {
  app::add_plot_options(options, kPlotKinds,
                        "draw the barcode, or the merge tree of H0 (repeatable)", plots);
  options.value({"--dims", plots.scope}, "D,…",
                "dimensions of the bars that are written and drawn (default: all that there are)",
                [&plots](const std::string& text) {
                  for (const std::int64_t dim : app::parse_integers("--dims", text, 0, 1'000'000))
                    plots.look.dims.push_back(static_cast<int>(dim));
                });
}

/// Handles `ph-barcode plot BARS… -o FILE.svg`, which draws stored barcodes.
/// @return true if the first plot is the file that -o names.
bool take_word(Job& job, app::PlotArguments& plots) {
  if (job.inputs.empty() || job.inputs.front() != "plot") return false;
  // If `plot` is the only input and a file has this name, `plot` means the file. If there are other
  // inputs, this file must be given as ./plot.
  if (job.inputs.size() == 1 && std::filesystem::exists("plot")) return false;
  job.stored = true;
  job.inputs.erase(job.inputs.begin());
  if (job.inputs.empty())
    throw Error(ErrorKind::usage, "plot: INPUT is missing, expected barcode files");
  const bool wants_bars =
      job.results.output_format.value_or(BarcodeFormat::none) != BarcodeFormat::none;
  const app::Plot picture{.path = job.places.output, .kind = {}};
  if (wants_bars && (picture.is_svg() || picture.is_png()))
    throw Error(ErrorKind::usage,
                fmt::format("--output-format: found {0} with -o {1}, which writes a picture; use "
                            "--plot {1} for the picture and -o for the barcode",
                            barcode_format_name(*job.results.output_format), job.places.output));
  const auto bars = barcode_format_of_path(job.places.output);
  const bool has_others = !plots.paths.empty() || !job.places.report.empty();
  if (bars && !wants_bars && !has_others)
    throw Error(ErrorKind::usage,
                fmt::format("plot: found -o {}, expected FILE.svg or FILE.png; --output-format {} "
                            "writes the barcode there",
                            printable(job.places.output), barcode_format_name(*bars)));
  // An output with the extension of a barcode format is a converted barcode.
  const bool is_picture = job.places.output != "-" && !wants_bars && !bars;
  if (is_picture) {
    plots.paths.insert(plots.paths.begin(), job.places.output);
    job.places.output = "-";
  }
  if (job.places.output == "-" && !job.results.output_format)
    job.results.output_format = BarcodeFormat::none;
  if (plots.paths.empty() && job.places.report.empty() &&
      job.results.output_format == BarcodeFormat::none)
    throw Error(ErrorKind::usage,
                "plot: found no output, expected one, such as -o FILE.svg or -o FILE.png");
  return is_picture;
}

/// Checks options that depend on one another.
void check_together(Job& job) {
  const auto reject = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
  if (job.places.report == "-" && job.places.output == "-" &&
      job.results.output_format != BarcodeFormat::none)
    reject(fmt::format(
        "--report: standard output already has the {}; use -o FILE or --output-format none",
        job.compare.empty() ? "barcode" : "distances"));
  if (!job.results.look.dims.empty() && job.results.output_format == BarcodeFormat::none &&
      std::ranges::none_of(job.places.plots, &app::Plot::shows_bars))
    reject("--dims: found no output with bars, expected -o FILE or --plot FILE");
  check_part_arguments(job);
  if (!job.compare.empty()) {
    if (!job.inputs.empty())
      reject(fmt::format("--compare: found INPUT '{}' as well, expected only two barcode files",
                         job.inputs.front()));
    return;
  }
  if (job.inputs.empty()) reject("INPUT is missing; see --help");
  for (const std::string& input : job.inputs)
    if (input.empty()) reject("INPUT: found '', expected a path");
  if (std::count(job.inputs.begin(), job.inputs.end(), "-") > 1)
    reject("INPUT: standard input can be read once only");
  if (job.question.options.max_dim && job.question.options.min_dim > *job.question.options.max_dim)
    reject(fmt::format("--min-dim: found {}, expected at most --max-dim ({})",
                       job.question.options.min_dim, *job.question.options.max_dim));
  const Engine engine = job.question.options.engine;
  if (job.question.options.representatives != Representatives::none && engine == Engine::standard)
    reject(fmt::format(
        "--engine: found {}, which gives no representatives, expected auto or an engine "
        "that gives them, such as twist",
        engine.name()));
  const bool has_cycles = job.question.options.representatives == Representatives::cycles ||
                          job.question.options.representatives == Representatives::voxels;
  if (job.results.loops && !has_cycles)
    reject("--loops: needs --representatives cycles or voxels, from which loops are made");
  if (job.results.loops && (job.question.options.max_dim == 0 || job.question.options.min_dim > 1))
    reject("--loops: needs dimension 1, the only dimension with loops");
  if (job.question.options.collapse == Collapse::on && job.question.options.min_persistence < 0)
    reject(
        "--collapse: found on, expected off or auto with a negative --min-persistence, because a "
        "collapse loses bars of length 0");
  if (job.question.options.collapse == Collapse::on &&
      job.question.options.representatives == Representatives::cocycles)
    reject(
        "--collapse: found on, expected off or auto with --representatives cocycles, which need "
        "all edges");
  check_rips_arguments(job);
  check_alpha_arguments(job);
  check_image_arguments(job);
  check_table_arguments(job);
}

}  // namespace

std::optional<std::string> parse_arguments(int argc, const char* const* argv, Job& job) {
  const app::Manual& about = job.sharing.on_ranks ? manual_of_ranks() : manual();
  CLI::App cli("", std::string(about.program));
  app::Options options(cli);
  app::PlotArguments plots;
  plots.scope = kOfOneBarcode;
  bool list_formats = false;
  add_input_options(options, job);
  add_table_options(options, job);
  options.flag("--formats", "print the table of formats and exit", list_formats);
  add_raw_options(options, job);
  add_complex_options(options, job);
  add_cubical_options(options, job);
  add_rips_options(options, job);
  add_alpha_options(options, job);
  add_homology_options(options, job);
  add_part_options(options, job);
  add_output_options(options, job);
  add_picture_options(options, plots);
  app::add_common_options(options, job.common);
  if (job.sharing.on_ranks) options.hide_outside(kRanks | kCloudRanks);
  if (auto answer = app::parse_command_line(options, job.common, argc, argv, about)) return answer;
  if (list_formats) return formats_table();
  const bool is_first_of_output = take_word(job, plots);
  job.places.plots = plots.together(kPlotKinds.front());
  if (is_first_of_output) job.places.plots.front().option = "--output";
  job.results.look = plots.look;
  for (const app::Plot& plot : job.places.plots) app::require_known_format(plot);
  job.given = options.given();
  check_together(job);
  constexpr std::array<std::string_view, 3> kNotOfResults{"part", "resume", "output"};
  if (job.sharing.part) job.sharing.typed_options = app::given_options(options, kNotOfResults);
  if (job.compare.empty() && !job.is_batch() && !job.sharing.part && !job.sharing.joins &&
      job.is_folder_of_inputs(job.inputs[0]))
    throw Error(
        ErrorKind::no_input,
        fmt::format("{}: it is a directory, which is a batch of inputs; give a folder for the "
                    "results: -o FOLDER/, --plot FOLDER/ or --report FOLDER/; --stack reads the "
                    "pictures in it as one volume",
                    printable(job.inputs[0])));
  if (!job.places.report.empty()) job.command = app::typed_command("ph-barcode", argc, argv);
  return std::nullopt;
}

}  // namespace ph::barcode
