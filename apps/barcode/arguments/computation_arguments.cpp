// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "apps/common/inputs/set_options.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/error.hpp"

namespace ph::barcode {
namespace {

using app::choose;
using app::parse_integer;
using app::parse_number;
using Names = std::vector<std::string_view>;

// A simplex of a higher dimension would not fit into memory.
constexpr int kMostDimensions = 1'000'000;

void take_complex(Job& job, const std::string& text) {
  const auto names = complex_names();
  constexpr auto own = static_cast<std::size_t>(ComplexKind::own);
  const std::size_t place = choose("--complex", text, names);
  job.question.complex = static_cast<ComplexKind>(std::min(place, own));
  if (is_triangulated(job.question.complex) && alpha_support().empty())
    throw Error(ErrorKind::not_built_in,
                fmt::format("--complex {}: not built in: it needs CGAL (Debian: libcgal-dev), and "
                            "a build with CGAL falls under the GPL",
                            text));
  job.question.own_complex = place < own ? nullptr : &own_complexes()[place - own];
}

void take_engine(Job& job, const std::string& text) {
  const Names names = engine_names();
  const std::optional<Engine> engine = engine_named(text);
  job.question.options.engine = engine ? *engine : Engine(names[choose("--engine", text, names)]);
  if (job.question.options.engine.name() != text)
    job.notes.push_back(
        fmt::format("--engine: '{}' is now called '{}'", text, job.question.options.engine.name()));
}

}  // namespace

void add_complex_options(app::Options& options, Job& job) {
  options.topic("complexes");
  std::string what =
      "what is built of the input (default auto: rips for points and distances, cubical for "
      "images, "
      "explicit for boundary matrices and simplices; points may also be cubical: --voxel). Of "
      "points in "
      "one to three dimensions alpha is the fastest: it has the bars of growing balls";
  for (const OwnComplex& own : own_complexes()) what += fmt::format("; {}: {}", own.name, own.what);
  options.value({"--complex", kOfInputs.with(kSomeLayers | kSomeBlocks)},
                fmt::format("{}", fmt::join(complex_names(), "|")), what,
                [&job](const std::string& text) { take_complex(job, text); });
  options.value(
      {"--threshold,--max-scale", kOfInputs.with(kSomeLayers | kSomeBlocks)}, "T",
      "largest filtration value, in units of the input (default for rips: the enclosing "
      "radius, but none for sparse distances, --max-dim 0 and engine beta-skeleton; else none)",
      [&job](const std::string& text) {
        job.question.threshold = parse_number("--threshold", text);
      });
  app::add_metric_option(options, kOfPoints.with(kSomeBlocks), job.question.rips);
}

void add_homology_options(app::Options& options, Job& job) {
  options.topic("engines");
  options.value({"--max-dim", kOfInputs.with(kSomeLayers | kSomeBlocks)}, "D",
                "highest dimension reported (default: 1 for rips, else all)",
                [&job](const std::string& text) {
                  job.question.options.max_dim =
                      static_cast<int>(parse_integer("--max-dim", text, 0, kMostDimensions));
                });
  options.value({"--min-dim", kOfInputs.with(kSomeLayers)}, "D",
                "lowest dimension reported (default 0); of volumes 2 saves the work for loops",
                [&job](const std::string& text) {
                  job.question.options.min_dim =
                      static_cast<int>(parse_integer("--min-dim", text, 0, kMostDimensions));
                });
  options.value({"--field,--modulus", kOfInputs.with(kRanks)}, "P",
                "coefficients modulo the prime P (default 2)", [&job](const std::string& text) {
                  job.question.options.field = parse_integer("--field", text, 2);
                  if (!is_field_characteristic(job.question.options.field))
                    throw Error(ErrorKind::usage,
                                fmt::format("--field: found '{}', expected a prime "
                                            "below 2^31",
                                            text));
                });
  options.value({"--engine", kOfInputs}, fmt::format("{}", fmt::join(engine_names(), "|")),
                "how it is computed (default auto; standard is the slow reference engine)",
                [&job](const std::string& text) { take_engine(job, text); });
  options.flag({"--check", kOfInputs},
               "also run the slow reference engine and compare; a difference is printed and "
               "exits 1",
               job.results.check);
  options.value(
      {"--min-persistence", kOfInputs.with(kParts | kRanks | kCloudRanks)}, "X",
      "omit bars with death - birth <= X (default 0; a negative X keeps bars of length 0)",
      [&job](const std::string& text) {
        job.question.options.min_persistence = parse_number("--min-persistence", text);
      });
  options.choice(
      {"--representatives", kOfInputs},
      "with each bar, in JSON: a cycle, or a cocycle, as cells of the input with "
      "coefficients; of images also voxels: components and hollows as sets of voxels, all "
      "else as cycles (default none)",
      job.question.options.representatives);
  options.choice(
      {"--loops", kOfInputs},
      "with each cycle of edges, in JSON: the closed walks that it consists of, of rips as "
      "short as is cheap (tight, default) or as found (plain)",
      job.results.loops);
  options.flag(
      {"--significance",
       {kAllPairs | kSomePairs | kAlpha, "Rips and alpha complexes of points and distances"}},
      "with each bar of dimension 1 and above, in CSV and JSON: p, how likely noise is to "
      "have a bar that stands out as much (times the number of bars, at most 1; Bobrowski "
      "and Skraba 2023)",
      job.results.significance);
  options.flag({"--dry-run", kOfInputs.with(kSomeLayers | kSomeBlocks)},
               "read the input, print the estimate of cells and memory and the engine; compute "
               "nothing",
               job.results.dry_run);
}

}  // namespace ph::barcode
