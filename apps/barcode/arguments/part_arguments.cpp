// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <string_view>

#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"

namespace ph::barcode {
namespace {

void take_part(Job& a, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == text.npos)
    throw Error(ErrorKind::usage,
                fmt::format("--part: found '{}', expected I/P, such as 1/8", text));
  constexpr std::int64_t most = std::int64_t{1} << 30;
  const std::int64_t parts = app::parse_integer("--part", text.substr(slash + 1), 1, most);
  a.sharing.part = {
      // mutant: part-number
      static_cast<int>(app::parse_integer("--part", text.substr(0, slash), 1, parts)) - 1,
      static_cast<int>(parts)};
}

/// Refuses options that ranks do not support; ranks join their parts themselves.
void check_ranks(const Job& a) {
  const auto reject = [](std::string_view option, std::string_view why) {
    throw Error(ErrorKind::usage, fmt::format("{}: found on ranks{}", option, why));
  };
  if (a.sharing.keeps_cells) reject("--keep-cells", "; JSON has the cells");
  if (!a.places.report.empty()) reject("--report", "; `ph-barcode plot BARS --report` makes one");
  if (!a.compare.empty()) reject("--compare", "");
  if (a.stored) reject("plot", "");
  if (a.question.options.min_persistence < 0)
    reject("--min-persistence", ", and negative: parts keep no bars of length 0");
  for (const app::Plot& plot : a.places.plots)
    if (!plot.shows_bars()) reject("--plot-kind tree", ", expected a plot of bars");
}

}  // namespace

void add_part_options(app::Options& options, Job& a) {
  options.topic("parts");
  options.value({"--part", kOffRanks}, "I/P",
                "compute part I (from 1 on) of P, on any machine, and write it as a part file: of "
                "an image some of its layers, of points (--complex rips --max-dim 0) some "
                "blocks of them, of several inputs some of them",
                [&a](const std::string& text) { take_part(a, text); });
  options.flag({"--join", kOffRanks},
               "the inputs are part files, in any order: bars if all are there, else, with -o "
               "FILE.ph, one part",
               a.sharing.joins);
  options.flag("--resume",
               a.sharing.on_ranks
                   ? "keep the part of each rank beside the output until all is done, and "
                     "take the parts that are there: a run that died goes on. Loops of "
                     "volumes are computed anew"
                   : "with --part: nothing is done if the output is that part already, "
                     "whole, and not older than the input",
               a.sharing.resumes);
  options.flag({"--keep-cells", kOffRanks},
               "with --part of an image: keep the cells of bars, which JSON shows",
               a.sharing.keeps_cells);
}

void check_part_arguments(const Job& a) {
  const auto reject = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
  if (a.sharing.on_ranks) {
    if (a.sharing.part || a.sharing.joins)
      reject("--part and --join: found on ranks, which do both");
    check_ranks(a);
    if (a.sharing.resumes && a.places.output == "-")
      reject("--resume: needs -o FILE, beside which the ranks keep their parts");
    return;
  }
  if (!a.sharing.part && !a.sharing.joins) {
    if (a.sharing.resumes) reject("--resume: found without --part, whose output it keeps");
    if (a.sharing.keeps_cells) reject("--keep-cells: found without --part");
    return;
  }
  if (a.sharing.part && a.sharing.joins)
    reject("--join: found beside --part; parts are computed first");
  const std::string_view option = a.sharing.part ? "--part" : "--join";
  if (!a.compare.empty()) reject(fmt::format("{}: found beside --compare", option));
  if (a.stored) reject(fmt::format("{}: found beside the word plot", option));
  if (!a.places.report.empty())
    reject(
        fmt::format("--report: found beside {}; `ph-barcode plot BARS --report` makes one of "
                    "the bars",
                    option));
  if (a.sharing.keeps_cells && a.wants_part_of_one() && !a.wants_image_part())
    reject("--keep-cells: makes sense for images; parts of points have the cells");
  if (a.sharing.joins && a.sharing.resumes) reject("--resume: makes sense with --part only");
  if (a.question.options.min_persistence < 0 && (a.sharing.joins || a.wants_part_of_one()))
    reject(
        fmt::format("--min-persistence: found a negative number beside {}: parts keep no bars of "
                    "length 0",
                    option));
  if (a.sharing.joins && a.sharing.keeps_cells)
    reject("--keep-cells: makes sense with --part only");
  if (a.sharing.part && a.results.output_format)
    reject(
        "--output-format: found beside --part, which writes a part file; --join writes other "
        "formats");
  for (const app::Plot& plot : a.places.plots)
    if (!plot.shows_bars())
      reject(fmt::format("--plot-kind: found {} beside {}, expected a plot of bars", plot.kind,
                         option));
}

}  // namespace ph::barcode
