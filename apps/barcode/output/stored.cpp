// SPDX-License-Identifier: MIT
// Processes barcodes that were computed earlier.
#include "apps/barcode/output/stored.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "apps/common/distances/distance_choice.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/detail/report/sha256.hpp"
#include "ph/report.hpp"

namespace ph::barcode {
namespace {

void write_stored_report(app::Output& output, const Input& input, const Barcode& barcode,
                         const BarcodeInfo& info, bool superlevel, const Job& job,
                         app::Session& session) {
  report::BarcodePage page{report::title_of(info.input), barcode};
  page.negated = superlevel;
  page.provenance.command = job.command;
  page.provenance.has_homology = false;
  page.provenance.run = info;
  page.provenance.sha256 = report::sha256_hex(input, session.context());
  report::write_page([&](std::string_view text) { output.file().write(text); }, page,
                     session.context());
  output.commit();
}

}  // namespace

Outcome run_stored(const Job& job, const Input& input, Outputs& outputs, app::Session& session) {
  for (const app::Plot& plot : job.places.plots)
    if (!plot.shows_bars())
      throw Error(
          ErrorKind::usage,
          fmt::format("--plot-kind {}: makes sense for data only, found a barcode", plot.kind));
  StoredBarcode stored = read_stored_barcode(input);
  Barcode& barcode = stored.bars;
  const std::string description =
      fmt::format("a barcode, {}", app::count_of(barcode.size(), "bar"));
  const std::string what = fmt::format("read {}: {}", input.name(), description);
  if (job.of_batch)
    session.explain(what);
  else
    session.note(what);
  // Other formats have no room for the further data of a JSON file, and nobody expects to find
  // these data in them. A loss is therefore noted only for JSON.
  if (job.places.format == BarcodeFormat::json && !stored.left_out.empty())
    session.note(fmt::format("{}: not kept: {}", input.name(), fmt::join(stored.left_out, ", ")));
  BarcodeInfo info;
  info.program = app::program_and_version("ph-barcode");
  info.input = job.places.input;
  info.input_description = description;
  info.peak_memory = app::peak_memory();
  note_absent_dims(barcode, job.results.look, session);
  const app::BarHold results_are_written(session);
  const bool superlevel = barcode.info().superlevel;
  // The program that converts the bars is not the program that computed them.
  // mutant: stored-origin
  if (barcode.info().program.empty()) barcode.set_info(info);
  outputs.write(barcode, {.loops = stored.loops, .p_values = stored.p_values},
                look_of(job.results.look, superlevel), {}, session.context());
  if (!job.places.report.empty())
    write_stored_report(outputs.report(), input, barcode, info, superlevel, job, session);
  return {app::kOk, description};
}

DistanceFormat distance_format(const Job& job) {
  const auto format = job.results.output_format ? job.results.output_format
                                                : barcode_format_of_path(job.places.output);
  if (!format || *format == BarcodeFormat::none) return DistanceFormat::text;
  if (*format == BarcodeFormat::csv) return DistanceFormat::csv;
  if (*format == BarcodeFormat::json) return DistanceFormat::json;
  if (job.results.output_format)
    throw Error(ErrorKind::usage,
                fmt::format("--output-format: found {}, expected csv, json or none with --compare; "
                            "by default, distances are text",
                            barcode_format_name(*format)));
  throw Error(ErrorKind::usage,
              fmt::format("--output: found {}, expected FILE.csv or FILE.json with --compare; "
                          "other names give text",
                          printable(job.places.output)));
}

std::string distances_file(const std::vector<report::Distance>& distances,
                           std::span<const Barcode> barcodes,
                           const std::vector<std::string>& left_out, const Job& job,
                           DistanceFormat format) {
  const std::string &first = job.compare[0], &second = job.compare[1];
  std::string text;
  if (format == DistanceFormat::csv) {
    text = "dim,bottleneck\n";
    for (const auto& [dim, bottleneck] : distances)
      text += fmt::format("{},{}\n", dim, shortest(bottleneck));
    return text;
  }
  if (format == DistanceFormat::json) {
    const auto distance = [](const report::Distance& d) {
      return json::object(
          {{"dim", json::integer(d.dim)}, {"bottleneck", json::number(d.bottleneck)}});
    };
    return json::document({{"format", json::string("ph-barcode distances")},
                           {"version", "1"},
                           {"program", json::string(app::program_and_version("ph-barcode"))},
                           {"inputs", json::array(std::array{first, second}, json::string)},
                           {"distances", json::lines(distances, distance)},
                           {"left_out", json::array(left_out, json::string)}});
  }
  const app::DistanceChoice choice;  // the default choice is the bottleneck distance
  text =
      fmt::format("{} of {} and {}\n", app::words_of(choice), printable(first), printable(second));
  for (const auto& [dim, bottleneck] : distances)
    text += fmt::format("H{}  {}\n", dim,
                        app::text_of({bottleneck, bottleneck}, choice, barcodes[0].bars(dim),
                                     barcodes[1].bars(dim)));
  for (const std::string& what : left_out) text += fmt::format("left out: {}\n", what);
  if (distances.empty() && left_out.empty()) text += "no bars\n";
  return text;
}

}  // namespace ph::barcode
