// SPDX-License-Identifier: MIT
#include "apps/vectorise/arguments/arguments.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "apps/common/arguments/options.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/vectorise/arguments/scopes.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"

namespace ph::vectorise {
namespace {

using app::parse_integer;
using app::parse_integers;
using app::parse_number;

constexpr std::int64_t kMostNumbers = std::int64_t{1} << 30;

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

std::size_t parse_count(const char* option, const std::string& text) {
  return static_cast<std::size_t>(parse_integer(option, text, 1, kMostNumbers));
}

double parse_finite(const char* option, const std::string& text, bool may_be_zero) {
  const double number = parse_number(option, text);
  if (!(number > 0 || (may_be_zero && number == 0)) || std::isinf(number))
    reject(fmt::format("{}: found '{}', expected a finite number {} 0", option, text,
                       may_be_zero ? ">=" : ">"));
  return number;
}

AxisArgument parse_axis(const char* option, const std::string& text) {
  if (text.find(',') == text.npos) return {std::nullopt, parse_count(option, text)};
  const std::size_t last = text.rfind(',');
  const std::vector<double> ends = app::parse_numbers(option, text.substr(0, last), 2);
  const std::size_t count = parse_count(option, text.substr(last + 1));
  if (!(ends[0] < ends[1]) || std::isinf(ends[0]) || std::isinf(ends[1]))
    reject(fmt::format("{}: found '{}', expected LO,HI,N with LO < HI, both finite", option, text));
  return {std::array{ends[0], ends[1]}, count};
}

InfiniteRule parse_infinite(const std::string& text) {
  using Rule = InfiniteRule::Rule;
  if (text == "drop") return {Rule::drop, 0};
  if (text == "keep") return {Rule::keep, 0};
  if (text == "error") return {Rule::error, 0};
  const double cap = [&] {
    try {
      return parse_number("--infinite", text);
    } catch (const Error&) {
      reject(fmt::format("--infinite: found '{}', expected drop, keep, error or a number", text));
    }
  }();
  if (std::isinf(cap))
    reject(fmt::format("--infinite: found '{}', expected a finite number", text));
  return {Rule::cap, cap};
}

void take_periodic(CubicalOptions& cubical, const std::string& text) {
  if (text == "all") {
    cubical.periodic.assign(Cubical::kMaxDim, true);
    return;
  }
  for (const std::int64_t number : parse_integers("--periodic", text, 0, Cubical::kMaxDim - 1)) {
    const auto axis = static_cast<std::size_t>(number);
    if (cubical.periodic.size() <= axis) cubical.periodic.resize(axis + 1, false);
    cubical.periodic[axis] = true;
  }
}

void add_input_options(app::Options& options, Arguments& a) {
  options.topic("input");
  options.inputs("INPUT",
                 "barcodes, as ph-barcode writes them, or folders of them; - is standard input. "
                 "With --kind euler also images",
                 a.inputs);
  options.choice(
      {"--format",
       {situation_of(Kind::euler) | kFitting | kFitted | kOfBarcode | kOfImage, "--kind euler"}},
      "what the inputs of an Euler curve are (default auto: by content)", a.format);
  options.choice({"--nan", kOfImages},
                 "what NaN in an image means: an error (default), or a voxel that is not there",
                 a.nan);
  options.choice({"--construction", kOfNewImages},
                 "voxels of an image are vertices (default) or top cells", a.cubical.construction);
  options.flag({"--superlevel", kOfNewImages},
               "superlevel sets of an image; values are those of the negated image",
               [&a] { a.cubical.superlevel = true; });
  options.value({"--periodic", kOfNewImages}, "AXES",
                "axes of an image that close up on themselves, such as 0,2, or all (default: those "
                "that the file says)",
                [&a](const std::string& text) { take_periodic(a.cubical, text); });
}

void add_vector_options(app::Options& options, Arguments& a) {
  options.topic("vectors");
  options.choice({"--kind", kNotFitted}, "what is made (default statistics)", a.kind);
  options.value({"--dims,--dim",
                 {(kAllKinds & ~situation_of(Kind::euler)) | kFitting | kOfBarcode,
                  "vectors of single dimensions that are not fitted yet"}},
                "D,…", "dimensions, a block of columns each (default: all that the inputs have)",
                [&a](const std::string& text) {
                  for (const std::int64_t dim : parse_integers("--dims", text, 0, 1'000'000))
                    a.dims.push_back(static_cast<int>(dim));
                });
  options.value(
      {"--infinite", {kAllKinds | kFitting | kOfBarcode, "barcodes that are not fitted yet"}},
      "drop|keep|error|T",
      "bars that never die are left out (default), an error, or die at T; curves of Betti "
      "numbers, landscapes and Euler curves can keep them, the last ones do so by default",
      [&a](const std::string& text) { a.infinite = parse_infinite(text); });
}

void add_parameter_options(app::Options& options, Arguments& a) {
  options.topic("parameters");
  options.value({"--grid",
                 {of({Kind::betti, Kind::landscape, Kind::silhouette, Kind::life_entropy,
                      Kind::image, Kind::euler}),
                  "curves, landscapes and images that are not fitted yet"}},
                "LO,HI,N|N",
                "the values at which curves and landscapes are looked at, both ends among them; of "
                "images the pixels along births (default: fitted, 100 values or 20 pixels)",
                [&a](const std::string& text) { a.grid = parse_axis("--grid", text); });
  options.value(
      {"--length-grid", kOfPersistenceImages}, "LO,HI,N|N",
      "the pixels of images along lengths (default: from 0 to the longest, as many as along "
      "births)",
      [&a](const std::string& text) { a.length_grid = parse_axis("--length-grid", text); });
  options.value({"--layers", {of({Kind::landscape}), "--kind landscape"}}, "K",
                "layers of landscapes (default 5)",
                [&a](const std::string& text) { a.layers = parse_count("--layers", text); });
  options.value({"--count", {of({Kind::lengths, Kind::atol}), "--kind lengths and atol"}}, "K",
                "how many lengths (default 5), or centres of ATOL (default 10)",
                [&a](const std::string& text) { a.count = parse_count("--count", text); });
  options.value({"--sigma", kOfPersistenceImages}, "S",
                "standard deviation of a bar in an image, in the unit of the values (default: a "
                "twentieth of the longer range)",
                [&a](const std::string& text) { a.sigma = parse_finite("--sigma", text, false); });
  options.value({"--power", {of({Kind::image, Kind::silhouette}), "--kind image and silhouette"}},
                "P", "a bar weighs length^P in images and silhouettes (default 1)",
                [&a](const std::string& text) { a.power = parse_finite("--power", text, true); });
  options.flag({"--normalised", {of({Kind::entropy}), "--kind entropy"}},
               "entropies divided by ln n for n bars", a.normalised);
  options.choice(
      {"--contrast", kOfAtol},
      "what a bar at distance d adds to a centre of ATOL of width w: exp(-d/w) (default), "
      "or exp(-(d/w)^2)",
      a.atol.contrast);
  options.value({"--seed", kOfAtol}, "N", "of the first centres of ATOL (default 0)",
                [&a](const std::string& text) {
                  a.atol.seed = static_cast<std::uint64_t>(parse_integer("--seed", text, 0));
                });
}

void add_output_options(app::Options& options, Arguments& a) {
  options.topic("output");
  options.path("-o,--output", "FILE", "where the table goes (default -: standard output)",
               a.output);
  options.choice("--output-format", "format of the table (default: by extension, or csv)",
                 a.output_format);
  auto* fit =
      options.path({"--fit", kNotFitted}, "FILE.json",
                   "write what was fitted: kind, dimensions, grids, widths, centres", a.fit);
  options
      .path("--fitted", "FILE.json",
            "make the vectors that --fit wrote down: nothing is fitted, no parameter is given",
            a.fitted)
      ->excludes(fit);
}

void check_together(const Arguments& a) {
  if (a.inputs.empty()) reject("INPUT is missing; see --help");
  for (const std::string& input : a.inputs)
    if (input.empty()) reject("INPUT: found '', expected a path");
  if (std::ranges::count(a.inputs, "-") + (a.fitted == "-") > 1)
    reject("INPUT: standard input can be read once only");
  if (a.output == "-" && a.fit == "-")
    reject("--fit: standard output already has the table; use -o FILE or --fit FILE");
  std::vector<int> dims = a.dims;
  std::ranges::sort(dims);
  if (const auto twice = std::ranges::adjacent_find(dims); twice != dims.end())
    reject(fmt::format("--dims: found {} twice, expected each dimension once", *twice));
  if (!a.fitted.empty())
    app::require_in_scope(a.given, kFitted, "--fitted");
  else
    require_kind(a, a.kind);  // mutant: option-kind
  if (a.infinite && a.infinite->rule == InfiniteRule::Rule::keep && !may_keep_infinite(a.kind))
    reject(fmt::format("--infinite: found keep, expected drop, error or a number with --kind {}",
                       name_of(a.kind)));
}

}  // namespace

bool Arguments::names_format() const {
  return output_format || ends_in(output, ".npy") || ends_in(output, ".csv");
}

OutputFormat Arguments::written_format() const {
  return output_format.value_or(ends_in(output, ".npy") ? OutputFormat::npy : OutputFormat::csv);
}

void require_kind(const Arguments& arguments, Kind kind) {
  app::require_in_scope(arguments.given, situation_of(kind),
                        fmt::format("--kind {}", name_of(kind)));
}

std::optional<std::string> parse_arguments(int argc, const char* const* argv,
                                           Arguments& arguments) {
  CLI::App cli("", std::string(manual().program));
  app::Options options(cli);
  add_input_options(options, arguments);
  add_vector_options(options, arguments);
  add_parameter_options(options, arguments);
  add_output_options(options, arguments);
  app::add_common_options(options, arguments.common);
  if (auto answer = app::parse_command_line(options, arguments.common, argc, argv, manual()))
    return answer;
  arguments.given = options.given();
  check_together(arguments);
  return std::nullopt;
}

}  // namespace ph::vectorise
