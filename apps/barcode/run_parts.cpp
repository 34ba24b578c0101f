// SPDX-License-Identifier: MIT
#include "apps/barcode/batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/parts/cloud_parts.hpp"
#include "apps/barcode/parts/image_parts.hpp"
#include "apps/barcode/parts/inputs_part.hpp"
#include "apps/barcode/parts/part_files.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/files/file_identity.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/sealed_part.hpp"

namespace ph::barcode {

namespace {

/// Checks that no output replaces an input or another output. @throws Error (usage).
void require_separate(const Job& job) {
  app::InputFiles inputs;
  for (const std::string& input : job.inputs) inputs.add(input);
  std::vector<app::Written> outputs{{"--output", job.places.output}};
  for (const app::Plot& plot : job.places.plots) outputs.push_back({plot.option, plot.path});
  app::require_separate(inputs, outputs, job.common.force);
}

}  // namespace

int run_part(const Job& job, app::Session& session) {
  const std::string& input = job.inputs.front();
  const Outcome outcome = job.wants_image_part() ? run_image_part(input, job, session)
                          : job.wants_part_of_one()
                              ? run_cloud_part(input, job, session)
                              : run_batch_part(inputs_of_batch(job, session), job, session);
  session.note(outcome.summary);
  if (barcode_format_of_path(job.places.output))
    session.note(fmt::format("{}: contains a part despite its name; --join makes bars from parts",
                             printable(job.places.output)));
  return outcome.code;
}

int run_join(const Job& job, BarcodeFormat format, app::Session& session) {
  app::require_in_scope(job.given, kParts, name_of(kParts));
  std::vector<PartFile> files;
  std::string kind;
  for (const std::string& path : job.inputs) {
    if (app::is_folder(path))
      throw Error(ErrorKind::no_input,
                  fmt::format("--join: {} is a directory, expected part files", path));
    std::vector<std::byte> bytes = read_part_file(path, session);
    try {
      const std::string_view found = kind_of_part(bytes);
      if (kind.empty()) kind = found;
      if (found != kind)
        throw Error(ErrorKind::bad_data,
                    fmt::format("part: found kind '{}', expected kind '{}' as in the first file",
                                found, kind));
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("{}: {}", path, error.marked()));
    }
    files.push_back({path, std::move(bytes)});
  }
  Job whole = job;
  whole.places.input = fmt::format("{}", fmt::join(job.inputs, " "));
  whole.places.format = format;
  require_separate(whole);
  const Outcome outcome = kind == kInputsKind ? join_batch_parts(files, whole.places, session)
                          : kind == "cloud"   ? join_cloud_parts(files, whole, session)
                                              : join_image_parts(std::move(files), whole, session);
  session.explain("memory " + format_size(static_cast<double>(session.memory_taken())));
  session.note(outcome.summary);
  return outcome.code;
}

}  // namespace ph::barcode
