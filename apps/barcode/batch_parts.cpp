// SPDX-License-Identifier: MIT
#include "apps/barcode/batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "apps/barcode/parts/inputs_part.hpp"
#include "apps/common/files/csv_cell.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/words.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/fingerprint.hpp"
#include "ph/detail/io/further_files.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::barcode {
namespace {

/// Refuses options that require a single input. @throws Error (usage).
void require_batch_options(const Job& job) {
  constexpr std::array<std::string_view, 13> kOfOne{
      "plot",    "plot-kind",    "dims",        "title", "size",
      "axis",    "loops",        "alpha-shape", "wrap",  "representatives",
      "dry-run", "significance", "keep-cells"};
  for (const std::string& typed : job.sharing.typed_options) {
    if (!typed.starts_with("--")) continue;
    if (std::ranges::find(kOfOne, std::string_view(typed).substr(2)) != kOfOne.end())
      throw Error(
          ErrorKind::usage,
          fmt::format(
              "{}: cannot be combined with --part of several inputs, whose result is one table",
              typed));
  }
}

/// A hash of the files from which the bars of an input are computed; 0 if one of them is no regular
/// file, because other files can be read only once.
std::uint64_t fingerprint_of(const std::string& input, const Job& job) {
  Fingerprint fingerprint;
  std::vector<std::filesystem::path> paths{split_member(files::path_of(input)).first};
  // mutant: part-data-file
  const auto further = detail::further_files(paths[0], job.reading.format);
  paths.insert(paths.end(), further.begin(), further.end());
  for (const std::string& path :
       {job.reading.values, job.question.vertex_weights, job.question.weights})
    if (!path.empty()) paths.push_back(split_member(files::path_of(path)).first);
  for (const std::filesystem::path& of_file : paths) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(of_file, error)) return 0;
    std::ifstream file(of_file, std::ios::binary);
    std::vector<char> block(std::size_t{1} << 16);
    std::uint64_t size = 0;
    do {
      file.read(block.data(), static_cast<std::streamsize>(block.size()));
      const auto read = static_cast<std::size_t>(file.gcount());
      fingerprint.add(std::as_bytes(std::span(block)).first(read));
      size += read;
    } while (file);
    if (!file.eof()) return 0;
    fingerprint.add(size);
  }
  return fingerprint.value();
}

InputsPart::Result run_one(std::size_t number, const std::string& input, Job& job,
                           app::Session& session) {
  InputsPart::Result result;
  result.input = number;
  result.fingerprint = fingerprint_of(input, job);
  const auto fail = [&](std::string_view what, int code) {
    result.code = code;
    result.failure = what;
    result.bars = Barcode();
  };
  try {
    job.places = {.input = input, .format = BarcodeFormat::none, .bars = &result.bars};
    const Outcome outcome = run(job, session);
    if (outcome.code != app::kOk) fail("the engine and the reference engine differ", outcome.code);
    session.note(fmt::format("{}: {}", input, outcome.summary));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    fail(error.in_words(app::kWords), app::report_current_exception(kProgram, input));
  }
  return result;
}

/// True if the file is this part, complete, and its inputs still have the same content.
bool is_there(const std::string& path, const InputsPart::Whole& whole, int part, const Job& job,
              app::Session& session) {
  const auto why_not = [&](const InputsPart& there) -> std::string {
    if (there.whole() != whole || !std::ranges::equal(there.numbers(), std::array{part}))
      return "is not the requested part for these inputs and options";
    for (const InputsPart::Result& result : there.results()) {
      if (!result.failure.empty()) return "has inputs that failed";
      const std::string& input = whole.inputs[result.input];
      const std::uint64_t now = fingerprint_of(input, job);
      if (now == 0 || now != result.fingerprint)  // mutant: part-content
        return fmt::format("has bars of other data than {} has now", input);
    }
    return {};
  };
  return kept_part(path, session, &InputsPart::of_bytes, why_not).has_value();
}

/// The exit code of the first input that failed, or kOk if no input failed.
int code_of(std::span<const InputsPart::Result> results) {
  const auto failed =
      std::ranges::find_if(results, [](const auto& r) { return r.code != app::kOk; });
  return failed == results.end() ? app::kOk : failed->code;  // mutant: part-failed
}

}  // namespace

Outcome run_batch_part(const std::vector<std::string>& inputs, const Job& job,
                       app::Session& session) {
  require_batch_options(job);
  const auto [part, parts] = *job.sharing.part;
  const std::string path = part_path(job.places.output, "part", part, parts);
  app::InputFiles read;
  for (const std::string& input : inputs) read.add(input, job.reading.format);
  app::require_separate(read, std::array{app::Written{"--output", path}}, job.common.force);
  const InputsPart::Whole whole{inputs, job.sharing.typed_options, parts};
  if (job.sharing.resumes && is_there(path, whole, part, job, session))
    return {app::kOk, fmt::format("{} already exists", path)};
  // The file is opened first, so that a failure to create it is reported early.
  app::Output output(path);
  InputsPart done(whole, part);
  Job own_job = job;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (InputsPart::part_of(i, parts) == part) done.add(run_one(i, inputs[i], own_job, session));
  write_part_file(output, done.bytes());
  return {code_of(done.results()), fmt::format("part {} of {}: {}", part + 1, parts,
                                               app::count_of(done.results().size(), "input"))};
}

Outcome join_batch_parts(const std::vector<PartFile>& files, const Places& places,
                         app::Session& session) {
  std::optional<InputsPart> all;
  for (const PartFile& file : files) {
    try {
      InputsPart part = InputsPart::of_bytes(file.bytes);
      if (all)
        all->join(std::move(part));
      else
        all.emplace(std::move(part));
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("{}: {}", file.path, error.marked()));
    }
  }
  const std::string parts =
      fmt::format("{} of {} parts", all->numbers().size(), all->whole().parts);
  if (is_part_path(places.output)) {
    app::Output output(places.output);
    write_part_file(output, all->bytes());
    return {app::kOk, parts};
  }
  if (!all->is_whole()) {
    std::vector<int> missing;
    for (int i = 0; i < all->whole().parts; ++i)
      if (!std::ranges::binary_search(all->numbers(), i)) missing.push_back(i + 1);
    throw Error(
        ErrorKind::bad_data,
        fmt::format("--join: found {}, expected all (missing: {}); -o FILE.ph joins those given",
                    parts, fmt::join(missing, ", ")));
  }
  if (places.format != BarcodeFormat::csv)
    throw Error(ErrorKind::usage,
                fmt::format("--output-format: found {}, expected csv for a table of several inputs",
                            barcode_format_name(places.format)));
  app::Output output(places.output);
  std::size_t failures = 0;
  output.write("input,dim,birth,death\n");
  for (const InputsPart::Result& result : all->results()) {
    const std::string& input = all->whole().inputs[result.input];
    if (!result.failure.empty()) {
      session.note(fmt::format("{}: not in the table: {}", input, result.failure));
      ++failures;
    }
    const std::string cell = app::csv_cell(input);
    for (const Bar& bar : result.bars)
      output.write(
          fmt::format("{},{},{},{}\n", cell, bar.dim, shortest(bar.birth), shortest(bar.death)));
  }
  output.commit();
  return {code_of(all->results()),
          fmt::format("{}{}", app::count_of(all->results().size(), "input"),
                      failures > 0 ? fmt::format(", {} of them failed", failures) : "")};
}

}  // namespace ph::barcode
