// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>

#include "adjust.hpp"
#include "build_complex.hpp"
#include "exit_code.hpp"
#include "messages.hpp"
#include "numbers.hpp"

namespace ph::barcode {
namespace {

/// Measures the stages of a run.
class Stopwatch {
 public:
  void lap(std::string stage) {
    const auto now = std::chrono::steady_clock::now();
    laps_.emplace_back(std::move(stage), std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }
  const std::vector<std::pair<std::string, double>>& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> laps_;
};

std::string plural(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

struct NamedData {
  std::string name;  // of the input, printable
  ReadResult read;
  std::size_t dropped;  // points
};

NamedData read_input(const Job& job, const Arguments& arguments, app::Session& session) {
  std::vector<Index> dropped;
  ReadOptions options = arguments.read;
  options.context = &session.context();
  options.dropped = &dropped;
  const Input input = Input::open(job.input, &session.context());
  ReadResult result = read_any(input, arguments.format, options, arguments.values);
  const std::string what = fmt::format("{}: {}", input.name(), result.description);
  // A batch says it in its one line an input.
  if (arguments.format == Format::automatic && arguments.inputs.size() == 1)
    session.note("read " + what);
  else
    session.explain("read " + what);
  for (const std::string& note : result.notes)
    session.note(fmt::format("{}: {}", input.name(), note));
  return {input.name(), std::move(result), dropped.size()};
}

/// All that is kept of an input: the complex, and what the results say about it.
struct Loaded {
  BuiltComplex built;
  std::string description;
  std::vector<Index> point_ids;
};

Loaded load(const Job& job, const Arguments& arguments, app::Session& session, Stopwatch& watch) {
  auto [name, read, dropped] = read_input(job, arguments, session);
  watch.lap("read");
  std::string description = read.description;
  std::vector<Index> point_ids = read.point_ids;
  BuiltComplex built = build_complex(std::move(read), name, dropped, arguments, session.context());
  if (built.promise) session.note(*built.promise);
  if (built.empty && !arguments.read.allow_empty)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: no points; --allow-empty accepts that", name));
  return {std::move(built), std::move(description), std::move(point_ids)};
}

/// What was foreseen and what was used, for whoever ran out of memory.
[[noreturn]] void fail_with_estimate(const std::string& what, const Estimate& estimate) {
  throw Error(
      ErrorKind::resource,
      fmt::format("{}; foreseen {} to {}, peak {}", what, app::format_size(estimate.bytes_low),
                  app::format_size(estimate.bytes_high),
                  app::format_size(static_cast<double>(app::peak_memory()))));
}

/// Calls `compute`; memory that runs out is reported beside the estimate.
template <class Compute>
Barcode with_estimate(const Estimate& estimate, Compute&& compute) {
  try {
    return compute();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    fail_with_estimate(error.what(), estimate);
  } catch (const std::bad_alloc&) {
    fail_with_estimate("out of memory", estimate);
  }
}

/// Whether edges are collapsed first, and why; only said of Rips complexes.
std::string collapse_text(const Estimate& estimate) {
  return fmt::format("{} ({})", estimate.collapses ? "on" : "off", estimate.collapse_reason);
}

std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description) {
  std::string text = fmt::format("input    {}\ncomplex  {}", description, built.name);
  if (built.threshold) text += fmt::format(", values up to {}", shortest(*built.threshold));
  if (!built.vertex_weights.empty())
    text += fmt::format(", vertices enter late ({})", built.vertex_weights);
  text += fmt::format("\nengine   {} ({})\n", engine_name(estimate.engine), estimate.reason);
  if (!estimate.collapse_reason.empty()) text += "collapse " + collapse_text(estimate) + '\n';
  for (std::size_t dim = 0; dim < estimate.cells.size(); ++dim)
    text += fmt::format("cells    dimension {}: at most {:.0f}\n", dim, estimate.cells[dim]);
  return text + fmt::format("memory   {} to {}\n", app::format_size(estimate.bytes_low),
                            app::format_size(estimate.bytes_high));
}

void write_outputs(std::optional<app::Output>& output, std::vector<app::Output>& plots,
                   const Barcode& barcode, const Job& job, const Arguments& arguments,
                   const BarcodeInfo& info) {
  if (output) {
    write_barcode(output->file(), barcode, job.format, info);
    output->commit();
  }
  for (std::size_t i = 0; i < plots.size(); ++i) {
    PlotOptions options;
    options.kind = arguments.plots[i].kind;
    plots[i].write(svg_plot(barcode, options));
    plots[i].commit();
  }
}

}  // namespace

Outcome run(const Job& job, const Arguments& arguments, app::Session& session) {
  Stopwatch watch;
  // What cannot be created is said before anything is computed.
  std::optional<app::Output> output;
  std::vector<app::Output> plots;
  if (!arguments.dry_run) {
    if (job.format != BarcodeFormat::none) output.emplace(job.output);
    for (const Plot& plot : arguments.plots) plots.emplace_back(plot.path);
  }

  const auto [built, description, point_ids] = load(job, arguments, session, watch);
  const Estimate estimated = estimate(built.complex, arguments.options, session.context());
  watch.lap("complex");
  session.explain(fmt::format("engine {}: {}", engine_name(estimated.engine), estimated.reason));
  if (!estimated.collapse_reason.empty()) session.explain("collapse " + collapse_text(estimated));
  session.explain(fmt::format("memory {} to {}", app::format_size(estimated.bytes_low),
                              app::format_size(estimated.bytes_high)));
  if (arguments.dry_run) {
    write_file("-", estimate_text(estimated, built, description));
    return {app::kOk, description};
  }

  Options options = arguments.options;
  // A bar that the threshold cuts is infinite, however short it would have been.
  if (built.cut) options.min_persistence = std::min(options.min_persistence, 0.0);
  const auto compute = [&] {
    const Barcode whole = persistence(built.complex, options, session.context());
    Barcode cut = built.cut
                      ? cut_at(whole, built.complex, *built.cut, arguments.options.min_persistence)
                      : whole;
    return point_ids.empty() ? cut : with_input_ids(cut, point_ids);
  };
  const Barcode barcode = with_estimate(estimated, compute);
  watch.lap("persistence");

  int code = app::kOk;
  if (arguments.check) {
    options.engine = Engine::standard;
    options.collapse = Collapse::off;
    options.representatives = Representatives::none;
    const std::string difference = first_difference(barcode, with_estimate(estimated, compute));
    watch.lap("check");
    if (difference.empty()) {
      session.explain("check: the oracle agrees");
    } else {
      app::print_line(fmt::format("ph-barcode: {}: check: engine {} and the oracle differ: {}",
                                  job.input, engine_name(estimated.engine), difference));
      code = app::kDifference;
    }
  }

  BarcodeInfo info;
  info.program = app::program_and_version("ph-barcode");
  info.input = job.input;
  info.input_description = description;
  info.complex = built.name;
  info.field = arguments.options.field;
  info.max_dim = arguments.options.max_dim.value_or(estimated.max_dim);
  info.threshold = built.threshold;
  info.vertex_weights = built.vertex_weights;
  info.subsample = built.subsample;
  info.approximation = arguments.rips.approximation;
  info.engine = engine_name(estimated.engine);
  info.timings = watch.laps();
  info.peak_memory = app::peak_memory();
  for (const auto& [stage, seconds] : watch.laps())
    session.explain(fmt::format("{} {:.3f} s", stage, seconds));
  write_outputs(output, plots, barcode, job, arguments, info);
  return {code, fmt::format("{}: {}", description, plural(barcode.size(), "bar"))};
}

}  // namespace ph::barcode
