// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <string_view>

#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"

namespace ph::barcode {
namespace {

void take_part(Job& job, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == text.npos)
    throw Error(ErrorKind::usage,
                fmt::format("--part: found '{}', expected I/P, such as 1/8", text));
  constexpr std::int64_t most = std::int64_t{1} << 30;
  const std::int64_t parts = app::parse_integer("--part", text.substr(slash + 1), 1, most);
  job.sharing.part = {
      // mutant: part-number
      static_cast<int>(app::parse_integer("--part", text.substr(0, slash), 1, parts)) - 1,
      static_cast<int>(parts)};
}

/// Refuses options that ranks do not support, because ranks join their parts themselves.
void check_ranks(const Job& job) {
  const auto reject = [](std::string_view option, std::string_view why) {
    throw Error(ErrorKind::usage, fmt::format("{}: not possible on MPI ranks{}", option, why));
  };
  if (job.sharing.keeps_cells) reject("--keep-cells", "; JSON has the cells");
  if (!job.places.report.empty())
    reject("--report", "; `ph-barcode plot BARS --report` makes a report");
  if (!job.compare.empty()) reject("--compare", "");
  if (job.stored) reject("plot", "");
  if (job.question.options.min_persistence < 0)
    throw Error(ErrorKind::usage,
                "--min-persistence: found a negative number, expected 0 or more on MPI ranks, "
                "whose parts keep no bars of length 0");
  for (const app::Plot& plot : job.places.plots)
    if (!plot.shows_bars()) reject("--plot-kind tree", "; plot the bars");
}

}  // namespace

void add_part_options(app::Options& options, Job& job) {
  options.topic("parts");
  options.value({"--part", kOffRanks}, "I/P",
                "compute part I (from 1 on) of P, on any machine, and write it as a part file: of "
                "an image some of its layers, of points (--complex rips --max-dim 0) some "
                "blocks of them, of several inputs some of them",
                [&job](const std::string& text) { take_part(job, text); });
  options.flag({"--join", kOffRanks},
               "the inputs are part files, in any order: bars if all are there, else, with -o "
               "FILE.ph, one part",
               job.sharing.joins);
  options.flag("--resume",
               job.sharing.on_ranks
                   ? "keep the part of each rank beside the output until all is done, and "
                     "take the parts that are there: a run that died goes on. Loops of "
                     "volumes are computed anew"
                   : "with --part: nothing is done if the output is that part already, "
                     "whole, and made from the same data",
               job.sharing.resumes);
  options.flag({"--keep-cells", kOffRanks},
               "with --part of an image: keep the cells of bars, which JSON shows",
               job.sharing.keeps_cells);
}

void check_part_arguments(const Job& job) {
  const auto reject = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
  if (job.sharing.on_ranks) {
    if (job.sharing.part || job.sharing.joins)
      reject(
          "--part and --join: not possible on MPI ranks, which make and join the parts themselves");
    check_ranks(job);
    if (job.sharing.resumes && job.places.output == "-")
      reject("--resume: needs -o FILE, beside which the ranks keep their parts");
    return;
  }
  if (!job.sharing.part && !job.sharing.joins) {
    if (job.sharing.resumes) reject("--resume: needs --part, whose output it keeps");
    if (job.sharing.keeps_cells) reject("--keep-cells: needs --part");
    return;
  }
  if (job.sharing.part && job.sharing.joins)
    reject("--join: found together with --part; compute the parts first");
  const std::string_view option = job.sharing.part ? "--part" : "--join";
  if (!job.compare.empty())
    reject(fmt::format("{}: cannot be combined with --compare; leave out one of them", option));
  if (job.stored)
    reject(fmt::format("{}: cannot be combined with the word plot; leave out one of them", option));
  if (!job.places.report.empty())
    reject(fmt::format(
        "--report: found together with {}; `ph-barcode plot BARS --report` makes a report",
        option));
  if (job.sharing.keeps_cells && job.wants_part_of_one() && !job.wants_image_part())
    reject("--keep-cells: makes sense for images only; parts of points always have the cells");
  if (job.sharing.joins && job.sharing.resumes) reject("--resume: makes sense with --part only");
  if (job.question.options.min_persistence < 0 && (job.sharing.joins || job.wants_part_of_one()))
    reject(
        fmt::format("--min-persistence: found a negative number, expected 0 or more with {}, "
                    "because parts keep no bars of length 0",
                    option));
  if (job.sharing.joins && job.sharing.keeps_cells)
    reject("--keep-cells: makes sense with --part only");
  if (job.sharing.part && job.results.output_format)
    reject(
        "--output-format: found together with --part, which writes a part file; --join writes "
        "other formats");
  for (const app::Plot& plot : job.places.plots)
    if (!plot.shows_bars())
      reject(fmt::format("--plot-kind: found {} together with {}, expected a plot of bars",
                         plot.kind, option));
}

}  // namespace ph::barcode
