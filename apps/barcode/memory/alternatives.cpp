// SPDX-License-Identifier: MIT
#include "apps/barcode/memory/estimate_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <new>
#include <vector>

#include "apps/barcode/complex/build_complex.hpp"
#include "apps/barcode/complex/read_input.hpp"
#include "apps/common/terminal/words.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {
namespace {

std::string text_of(const std::string& changes, const Fit& fit) {
  return fmt::format("{} ({} to {})", changes, format_size(fit.bytes_low),
                     format_size(fit.bytes_high));
}

std::string text_of(const Fit& fit, const Job& job) {
  std::vector<std::string> changes;
  bool has_loops = job.results.loops.has_value();
  for (const auto& [setting, value] : fit.changes) {
    changes.push_back(app::kWords.setting(setting, value));
    // --loops is refused if no cycles of H1 are computed.
    const bool ends_loops =
        setting == Setting::representatives || (setting == Setting::max_dim && value == "0");
    if (has_loops && ends_loops) {
      changes.push_back("without --loops");
      has_loops = false;
    }
  }
  return text_of(fmt::format("{}", fmt::join(changes, " ")), fit);
}

/// The smallest of a few larger voxel sizes at which the image of the points fits into memory.
/// Empty if the image fits with none of them.
std::string larger_voxel(const NamedData& data, const Job& job, const RunContext& context) {
  for (const double times : {1.5, 2.0, 4.0, 8.0, 16.0}) {
    Job changed = job;
    const std::string text = fmt::format("{:.3g}", times * *job.question.voxel);
    changed.question.voxel = app::parse_number("--voxel", text);
    try {
      const BuiltComplex built =
          build_complex(data.read, data.name, data.dropped, changed, context);
      const Estimate e = estimate(built.complex, changed.question.options, context);
      if (e.bytes_high <= static_cast<double>(context.memory.limit()))
        return text_of("--voxel " + text, {{}, e.bytes_low, e.bytes_high});
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::resource) throw;
    } catch (const std::bad_alloc&) {
    }
  }
  return "";
}

}  // namespace

std::string alternatives(const Job& job, app::Session& session) {
  // Standard input has already been read, and cannot be read again.
  if (job.places.input == "-") return "";
  try {
    const RunContext& context = session.context();
    const NamedData data = read_input(
        open_input(job.places.input, job, context, Input::Excess::stays_in_file), job, context);
    std::vector<std::string> texts;
    if (job.question.voxel)
      if (std::string text = larger_voxel(data, job, context); !text.empty())
        texts.push_back(std::move(text));
    const BuiltComplex built = build_complex(data.read, data.name, data.dropped, job, context);
    for (const Fit& fit : what_fits(built.complex, job.question.options, context))
      texts.push_back(text_of(fit, job));
    if (texts.empty()) return "";
    // The estimate cannot predict how many cells of an image are critical.
    const bool is_image = std::holds_alternative<Image>(data.read.data);
    return fmt::format("what {} fit: {}", is_image ? "may" : "would", fmt::join(texts, "; "));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    return "";
  } catch (const std::bad_alloc&) {
    return "";
  }
}

}  // namespace ph::barcode
