// SPDX-License-Identifier: MIT
#include "apps/cluster/arguments/arguments.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "apps/cluster/arguments/scopes.hpp"
#include "apps/common/arguments/options.hpp"
#include "apps/common/inputs/set_options.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"

namespace ph::cluster {
namespace {

using app::parse_integer;

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

void add_input_options(app::Options& options, Arguments& a) {
  options.topic("input");
  options.inputs("INPUT", "points or distances, as ph-barcode reads them; - is standard input",
                 a.inputs);
  std::vector<std::string_view> formats;
  for (const Format format : input_formats()) formats.push_back(format_info(format).name);
  options.choice("--format", formats,
                 "format of the input (default auto: by content and extension)",
                 [&a](std::size_t i) { a.format = input_formats()[i]; });
  options.flag("--allow-empty", "an input without points is no error", a.reading.allow_empty);
  app::add_matrix_options(options, kOfMatrices, kOfDistances, a.reading);
  options.choice({"--nan", kOfData},
                 "what NaN means: an error (default), or a point or distance that is not there",
                 a.reading.nan);
  app::add_columns_option(options, kOfPoints, a.reading);
  app::add_raw_options(options, kOfPoints, kOfPoints, "float32", a.reading);
}

void add_cluster_options(app::Options& options, Arguments& a) {
  options.topic("clusters");
  options.value(
      "--min-size", "M", "fewest points of a cluster, at least 2 (default 5)",
      [&a](const std::string& text) { a.min_size = parse_integer("--min-size", text, 2); });
  options.value(
      "--neighbours", "K",
      "the core distance of a point is the distance to its K-th nearest other point "
      "(default: one less than --min-size, as in scikit-learn, where the point itself counts); 0 "
      "is single linkage",
      [&a](const std::string& text) { a.neighbours = parse_integer("--neighbours", text, 0); });
  app::add_metric_option(options, kOfPoints, a.rips);
  options.choice({"--method", kOfFullRuns},
                 "the clusters with the largest total stability (eom, default), or those without "
                 "clusters inside them (leaf)",
                 a.choice.method);
  options.value(
      {"--epsilon", kOfFullRuns}, "E",
      "a cluster that joins others at a distance below E is replaced by the first one "
      "around it that does not (default 0)",
      [&a](const std::string& text) {
        a.choice.epsilon = app::parse_number("--epsilon", text);
        if (!(a.choice.epsilon >= 0) || std::isinf(a.choice.epsilon))
          reject(fmt::format("--epsilon: found '{}', expected a finite number >= 0", text));
      });
  options.value(
      {"--max-size", kOfEom}, "N",
      "most points of a cluster that --method eom chooses (default: any number)",
      [&a](const std::string& text) { a.choice.max_size = parse_integer("--max-size", text, 1); });
  options.flag({"--allow-single", kOfFullRuns},
               "all points together may be chosen as the only cluster", a.choice.allow_single);
}

void add_output_options(app::Options& options, Arguments& a) {
  options.topic("output");
  options.path(
      {"-o,--output,--labels", kOfFullRuns}, "FILE",
      "where the labels go, one per point: 0, 1, … by the first points of the clusters, "
      "-1 for noise, -3 for a point that is left out, see --nan (default -: standard output)",
      a.output);
  options.choice({"--output-format", kOfFullRuns},
                 "format of the labels (default: by extension, or csv); pcd and ply are the cloud "
                 "that was read, with the field label: 0 for noise, 1, 2, … for the clusters",
                 a.output_format);
  options.flag({"--scores", kOfFullRuns},
               "beside each label: probability, how long the point stays in its cluster as a share "
               "of the time until the cluster ends; and outlier_score (GLOSH), near 1 for outliers",
               a.scores);
  options.path({"--tree", kOfFullRuns}, "FILE.json|.csv",
               "write all clusters of the hierarchy: the condensed tree of HDBSCAN*; JSON also has "
               "where each point leaves it",
               a.tree);
  options.flag("--dry-run", "read the input, print an estimate of the memory; compute nothing",
               a.dry_run);
}

void check_raw(Arguments& a) {
  if (!a.reading.raw) {
    if (a.format == Format::raw) reject("--format: found raw, which needs --raw-points");
    return;
  }
  if (a.reading.raw->coordinates == 0)
    reject("--raw-type, --raw-big-endian and --raw-skip need --raw-points");
  if (a.format == Format::automatic) a.format = Format::raw;
  if (a.format != Format::raw) reject("--raw-points: makes sense for --format raw only");
  app::settle_raw(*a.reading.raw);
}

/// Decides whether numbers are points or distances, if the options leave only one of them.
void settle_meaning(Arguments& a) {
  ArrayMeaning& meaning = a.reading.array;  // distances, if an option for matrices is given
  const bool is_of_points = std::ranges::any_of(a.given, [](const app::GivenOption& option) {
    return (option.scope.where & kAllData) == kPoints;
  });
  if (a.format == Format::distance)
    meaning = ArrayMeaning::distances;
  else if (meaning == ArrayMeaning::automatic)
    meaning =
        a.format == Format::points || is_of_points ? ArrayMeaning::points : ArrayMeaning::rips;
}

void check_outputs(const Arguments& a) {
  if (a.output == "-" && a.tree == "-")
    reject("--tree: standard output already has the labels; use -o FILE or --tree FILE");
  if (!a.tree.empty() && a.tree != "-" && !ends_in(a.tree, ".json") && !ends_in(a.tree, ".csv"))
    reject(fmt::format("--tree: found {}, expected a file name that ends in .json or .csv",
                       printable(a.tree)));
}

void check_together(Arguments& a) {
  if (a.inputs.empty()) reject("INPUT is missing; see --help");
  if (a.inputs.size() > 1)
    reject(fmt::format("INPUT: found {} inputs, expected one", a.inputs.size()));
  if (a.input().empty()) reject("INPUT: found '', expected a path");
  const Situation method = a.choice.method == ClusterMethod::eom ? kEom : kLeaf;
  app::require_in_scope(a.given, method, name_of(method));
  if (a.choice.max_size != 0 && a.choice.max_size < a.min_size)
    reject(fmt::format("--max-size: found {}, expected at least --min-size ({})", a.choice.max_size,
                       a.min_size));
  if (a.has_births() && a.neighbours)
    reject("--neighbours: cannot be combined with --diagonal births; leave out one of them");
  if (a.has_births() && a.reading.from_correlation)
    reject("--diagonal births: cannot be combined with --from-correlation; leave out one of them");
  check_raw(a);
  settle_meaning(a);
  check_outputs(a);
}

}  // namespace

std::optional<OutputFormat> Arguments::named_format() const {
  if (output_format) return output_format;
  for (const Named<OutputFormat>& known : names_of<OutputFormat>)
    if (ends_in(output, fmt::format(".{}", known.name))) return known.value;
  return std::nullopt;
}

std::span<const Format> input_formats() {
  static constexpr std::array kFormats{Format::automatic,
                                       Format::points,
                                       Format::distance,
                                       Format::lower_distance,
                                       Format::upper_distance,
                                       Format::sparse,
                                       Format::binary,
                                       Format::dipha,
                                       Format::npy,
                                       Format::npz,
                                       Format::off,
                                       Format::ply,
                                       Format::pcd,
                                       Format::xyz,
                                       Format::pts,
                                       Format::raw};
  return kFormats;
}

std::optional<std::string> parse_arguments(int argc, const char* const* argv,
                                           Arguments& arguments) {
  CLI::App cli("", std::string(manual().program));
  app::Options options(cli);
  add_input_options(options, arguments);
  add_cluster_options(options, arguments);
  add_output_options(options, arguments);
  app::add_common_options(options, arguments.common);
  if (auto answer = app::parse_command_line(options, arguments.common, argc, argv, manual()))
    return answer;
  arguments.given = options.given();
  check_together(arguments);
  return std::nullopt;
}

}  // namespace ph::cluster
