// SPDX-License-Identifier: MIT
#include "apps/distance/arguments/arguments.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/arguments/options.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/distance/arguments/scopes.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

using app::DistanceKind;
using app::parse_integer;
using app::parse_number;

constexpr std::int64_t kMost = std::int64_t{1} << 30;  // the largest accepted count

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

/// @param least the smallest accepted number.
double parse_finite(const char* option, const std::string& text, double least) {
  const double number = parse_number(option, text);
  if (!(number >= least) || std::isinf(number))
    reject(
        fmt::format("{}: found '{}', expected a finite number, at least {}", option, text, least));
  return number;
}

double parse_order(const std::string& text) {
  const double order = parse_number("--order", text);
  if (order == kInfinity)
    reject("--order: found inf, expected a finite number; --distance bottleneck has order inf");
  return parse_finite("--order", text, 1);
}

void add_input_options(app::Options& options, Arguments& a) {
  options.topic("input");
  options.inputs("BARCODE",
                 "barcodes, as ph-barcode writes them, or folders of them; - is standard input",
                 a.inputs);
  options.value("--dims,--dim", "D,…",
                "dimensions, each for itself (default: all that the barcodes have)",
                [&a](const std::string& text) {
                  for (const std::int64_t dim : app::parse_integers("--dims", text, 0, 1'000'000))
                    a.dims.push_back(static_cast<int>(dim));
                });
}

void add_distance_options(app::Options& options, Arguments& a) {
  options.topic("distances");
  options.choice(
      "--distance",
      "bottleneck (default): the largest difference, which has no parameters and is what "
      "noise of a known size cannot exceed; wasserstein: the sum of all; sliced: an "
      "approximation by projections to lines",
      a.distance.kind);
  options.value(
      {"--order", kOfWasserstein}, "P", "of the Wasserstein distance, at least 1 (default 1)",
      [&a](const std::string& text) { a.distance.wasserstein_order = parse_order(text); });
  options.value(
      {"--ground", kOfWasserstein}, "inf|2|Q",
      "the norm in which the bars of a pair are apart, at least 1, in the Wasserstein "
      "distance (default inf: the larger of the differences of births and deaths)",
      [&a](const std::string& text) {
        const double ground = parse_number("--ground", text);
        if (!(ground >= 1))
          reject(fmt::format("--ground: found '{}', expected inf or a number, at least 1", text));
        a.distance.wasserstein_ground = ground;
      });
  options.value({"--directions", {kSliced | kAnyNumber | kAnyAim, "--distance sliced"}}, "N",
                "lines of the sliced distance (default 50)", [&a](const std::string& text) {
                  a.distance.directions =
                      static_cast<int>(parse_integer("--directions", text, 1, 1'000'000));
                });
  options.value({"--error",
                 {kBottleneck | kWasserstein | kAnyNumber | kAnyAim,
                  "--distance bottleneck and wasserstein"}},
                "E",
                "how much too large a distance may be, as a part of it: 0.01 is 1 % (default 0: "
                "exact); the lower bound is printed as well",
                [&a](const std::string& text) {
                  a.distance.limits.relative_error = parse_finite("--error", text, 0);
                });
  // mutant: scope-at-most
  options.value({"--at-most",
                 {kBottleneck | kWasserstein | kAnyNumber | kNoGroups,
                  "bottleneck and Wasserstein distances without --groups and --matching"}},
                "T", "end early where a distance is above T: how much it is above does not matter",
                [&a](const std::string& text) {
                  a.distance.limits.at_most = parse_finite("--at-most", text, 0);
                });
}

void add_output_options(app::Options& options, Arguments& a) {
  options.topic("output");
  options.value("-o,--output", "FILE",
                "where the distances go, or what --groups finds (default -: standard output; with "
                "--matrix alone nowhere)",
                [&a](const std::string& text) {
                  if (text.empty()) reject("--output: found '', expected a path");
                  a.output = text;
                });
  options.choice("--output-format", "format of the distances (default: by extension, or text)",
                 a.output_format);
  auto* matching = options.path(
      {"--matching",
       {kBottleneck | kWasserstein | kTwo | kNoGroups | kMatching,
        "two barcodes with --distance bottleneck or wasserstein"}},
      "FILE.csv|.json", "write which bars of two barcodes are paired, and what each pair costs",
      a.matching);
  options.path("--matrix", "FILE.npy|.csv",
               "write the distances of all pairs as a square matrix, of one dimension", a.matrix);
  options.topic("groups");
  options
      .path("--groups", "FILE",
            "test whether groups differ: a word on each line of the file is the group of a "
            "barcode, in the order of the barcodes",
            a.groups)
      ->excludes(matching);
  options.value({"--shuffles", kOfGroups}, "N", "shuffles of the labels (default 1000)",
                [&a](const std::string& text) {
                  a.test.shuffles =
                      static_cast<std::size_t>(parse_integer("--shuffles", text, 1, kMost));
                });
  options.value({"--power", kOfGroups}, "Q",
                "power of the distances whose sum is compared, above 0 (default 1)",
                [&a](const std::string& text) {
                  a.test.power = parse_number("--power", text);
                  if (!(a.test.power > 0) || std::isinf(a.test.power))
                    reject(fmt::format("--power: found '{}', expected a finite number > 0", text));
                });
  options.value({"--seed", kOfGroups}, "N", "of the shuffles (default 0)",
                [&a](const std::string& text) {
                  // mutant: group-seed
                  a.test.seed = static_cast<std::uint64_t>(parse_integer("--seed", text, 0));
                });
}

/// @throws Error (usage) if the name has another format. @param expected such as "FILE.npy or
/// FILE.csv".
void require_format(const char* option, const std::string& path,
                    std::initializer_list<BarcodeFormat> formats, const char* expected) {
  if (path.empty() || path == "-") return;
  const auto format = barcode_format_of_path(path);
  if (!format || std::ranges::find(formats, *format) == formats.end())
    reject(
        fmt::format("{}: found {}, expected {}, or - for CSV", option, printable(path), expected));
}

/// @throws Error (usage) if the name has a format that cannot contain distances.
void require_table_format(const Arguments& a) {
  if (!a.output || a.output_format) return;  // mutant: text-as-array
  const auto format = barcode_format_of_path(*a.output);
  if (format && *format != BarcodeFormat::csv && *format != BarcodeFormat::json)
    reject(
        fmt::format("--output: found {}, expected FILE.csv or FILE.json (other names give text); "
                    "--matrix writes .npy",
                    printable(*a.output)));
}

/// Refuses two results on standard output.
void require_one_on_standard_output(const Arguments& a) {
  std::string first = a.writes_table() && a.output_path() == "-" ? "--output" : "";
  for (const auto& [option, path] : {std::pair{"--matching", a.matching}, {"--matrix", a.matrix}})
    if (path == "-") {
      if (!first.empty())
        reject(fmt::format(
            "{0}: standard output already has the result of {1}; use {0} FILE or {1} FILE", option,
            first));
      first = option;
    }
}

void check_together(const Arguments& a) {
  if (a.inputs.empty()) reject("BARCODE is missing; see --help");
  for (const std::string& input : a.inputs)
    if (input.empty()) reject("BARCODE: found '', expected a path");
  if (std::ranges::count(a.inputs, "-") + (a.groups == "-") > 1)
    reject("BARCODE: standard input can be read once only");
  std::vector<int> dims = a.dims;
  std::ranges::sort(dims);
  if (const auto twice = std::ranges::adjacent_find(dims); twice != dims.end())
    reject(fmt::format("--dims: found {} twice, expected each dimension once", *twice));
  app::require_in_scope(a.given, situation_of(a.distance.kind),
                        fmt::format("--distance {}", a.distance.name()));
  if (!a.matching.empty())
    app::require_in_scope(a.given, kMatching, "--matching");
  else
    app::require_in_scope(a.given, a.groups.empty() ? kNoGroups : kGroups,
                          a.groups.empty() ? "no --groups" : "--groups");
  // mutant: matching-error
  if (!a.matching.empty() && a.distance.kind == DistanceKind::bottleneck &&
      a.distance.limits.relative_error > 0)
    reject(
        "--error: cannot be combined with --matching and --distance bottleneck, whose matchings "
        "are exact");
  require_format("--matching", a.matching, {BarcodeFormat::csv, BarcodeFormat::json},
                 "FILE.csv or FILE.json");
  require_format("--matrix", a.matrix, {BarcodeFormat::csv, BarcodeFormat::npy},
                 "FILE.npy or FILE.csv");
  require_table_format(a);
  require_one_on_standard_output(a);
}

}  // namespace

OutputFormat Arguments::table_format() const {
  if (output_format) return *output_format;
  const auto format = barcode_format_of_path(output_path());
  if (format == BarcodeFormat::csv) return OutputFormat::csv;
  return format == BarcodeFormat::json ? OutputFormat::json : OutputFormat::text;
}

std::optional<std::string> parse_arguments(int argc, const char* const* argv,
                                           Arguments& arguments) {
  CLI::App cli("", std::string(manual().program));
  app::Options options(cli);
  add_input_options(options, arguments);
  add_distance_options(options, arguments);
  add_output_options(options, arguments);
  app::add_common_options(options, arguments.common);
  if (auto answer = app::parse_command_line(options, arguments.common, argc, argv, manual()))
    return answer;
  arguments.given = options.given();
  check_together(arguments);
  return std::nullopt;
}

}  // namespace ph::distance_program
