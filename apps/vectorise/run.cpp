// SPDX-License-Identifier: MIT
#include "apps/vectorise/run.hpp"

#include <fmt/format.h>

#include <optional>

#include "apps/common/files/extensions.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/inputs/barcode_files.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/vectorise/arguments/scopes.hpp"
#include "apps/vectorise/data/samples.hpp"
#include "apps/vectorise/data/table.hpp"
#include "apps/vectorise/fit/fit.hpp"
#include "apps/vectorise/make_fit.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/diagram/thread_context.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::vectorise {
namespace {

/// One run: opens the outputs, reads the inputs, fits, computes, and writes the table.
class Run {
 public:
  Run(const Arguments& arguments, app::Session& session)
      : arguments_(arguments), session_(session), context_(session.context()) {
    if (arguments.fitted.empty()) {
      fit_ = fit_of(arguments);
    } else {
      fit_ = read_fit(Input::open(arguments.fitted, &context_, Input::Excess::refused,
                                  detail::start_check(Format::points)));
      if (fit_.kind != Kind::euler) require_kind(arguments, fit_.kind);
    }
    files_ = files_of(arguments, fit_.kind);
    require_separate();
    output_.emplace(arguments.output);
    if (!arguments.names_format() && app::has_extension(arguments.output))
      session.note(app::no_format_in(arguments.output, "csv"));
    if (!arguments.fit.empty()) fit_output_.emplace(arguments.fit);
  }

  void run() {
    Table table = fit_.kind == Kind::euler ? euler_curves() : vectors();
    if (dropped_ > 0)
      session_.note(
          fmt::format("left out: {} without a finite birth and death; --infinite T sets "
                      "the death of bars that never die",
                      app::count_of(dropped_, "bar")));
    const app::BarHold results_are_written(session_);
    write_table(output_->file(), table, arguments_.written_format(), files_, names_of(fit_));
    output_->commit();
    if (fit_output_) {
      fit_output_->write(fit_json(fit_, dropped_));
      fit_output_->commit();
    }
    session_.note(fmt::format("{}, {}: {} of {}", app::count_of(files_.size(), "input"),
                              name_of(fit_.kind), app::count_of(files_.size(), "vector"),
                              app::count_of(table.columns, "number")));
  }

 private:
  bool is_fitting() const { return arguments_.fitted.empty(); }

  /// Checks that no output replaces an input. @throws Error (usage).
  void require_separate() const {
    app::InputFiles inputs;
    for (const std::string& file : files_) inputs.add(file);  // mutant: table-inputs
    if (!arguments_.fitted.empty()) inputs.add(arguments_.fitted);
    std::vector<app::Written> outputs{{"--output", arguments_.output}};
    if (!arguments_.fit.empty()) outputs.push_back({"--fit", arguments_.fit});
    const bool replaces = app::require_separate(inputs, outputs, arguments_.common.force);
    if (!replaces && arguments_.common.force)
      session_.explain("--force: not needed, because no output is an input");
  }

  Table new_table() const {
    Table table{length_of(fit_), std::pmr::vector<double>(&session_.context().memory)};
    std::size_t numbers = 0;
    if (__builtin_mul_overflow(files_.size(), table.columns, &numbers))
      throw Error(ErrorKind::resource, "the table would have more numbers than 64 bits can count");
    table.numbers.resize(numbers);
    return table;
  }

  Table vectors() {
    const app::StoredBarcodes stored(files_, session_);
    const std::vector<Barcode>& barcodes = stored.all();
    std::size_t ignored = 0;
    if (is_fitting()) add_blocks(fit_, barcodes, files_, arguments_, ignored, context_);
    Table table = new_table();
    std::vector<std::size_t> dropped(files_.size());
    const diagram::ThreadContexts tasks(files_.size(), context_);
    for_each_piece("vectors", files_.size(), 1, context_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        RunContext task;
        tasks.prepare(task);
        std::size_t at = 0;
        for (const Block& block : fit_.blocks) {
          const std::vector<Bar> bars =
              bars_of(fit_, barcodes[i].bars(block.dim), files_[i], dropped[i]);
          std::size_t length = 1;
          for (const std::size_t n : shape_of(fit_, block)) length *= n;
          try {
            write_block(fit_, block, bars, table.row(i).subspan(at, length), task);
          } catch (const Error& error) {
            if (error.kind() != ErrorKind::bad_data) throw;
            throw about_input(error, files_[i]);
          }
          at += length;  // mutant: block-place
        }
      }
    });
    for (const std::size_t count : dropped) dropped_ += count;
    return table;
  }

  /// The curve of a sample.
  StepFunction curve_of(const Sample& sample, const std::string& name) {
    if (const auto* cubical = std::get_if<Cubical>(&sample)) return euler_curve(*cubical, context_);
    const Barcode& barcode = std::get<Barcode>(sample);
    const std::span<const Bar> all(barcode.begin(), barcode.end());
    return euler_curve(bars_of(fit_, all, name, dropped_));
  }

  /// Computes the curves sample by sample, so that only one image must be in memory. Only a grid
  /// that must be fitted needs the curves of all samples first.
  Table euler_curves() {
    const bool knows_grid = !is_fitting() || (arguments_.grid && arguments_.grid->range);
    if (knows_grid && is_fitting()) add_euler_block(fit_, {}, arguments_);
    std::vector<StepFunction> curves;
    std::optional<Table> table;
    if (knows_grid) table = new_table();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const Sample sample = read_sample(files_[i], fit_.cubical, arguments_, session_);
      const auto* cubical = std::get_if<Cubical>(&sample);
      if (!knows_grid)
        curves.push_back(curve_of(sample, files_[i]));
      else if (cubical != nullptr)
        euler_curve(*cubical, fit_.blocks[0].grid, table->row(i), context_);
      else
        curve_of(sample, files_[i]).sample(fit_.blocks[0].grid, table->row(i));
    }
    if (!knows_grid) {
      add_euler_block(fit_, curves, arguments_);
      table = new_table();
      for (std::size_t i = 0; i < files_.size(); ++i)
        curves[i].sample(fit_.blocks[0].grid, table->row(i));
    }
    return std::move(*table);
  }

  const Arguments& arguments_;
  app::Session& session_;
  const RunContext& context_;
  Fit fit_;
  std::vector<std::string> files_;
  std::size_t dropped_ = 0;
  std::optional<app::Output> output_, fit_output_;
};

}  // namespace

int run(const Arguments& arguments, app::Session& session) {
  Run(arguments, session).run();
  return app::kOk;
}

}  // namespace ph::vectorise
