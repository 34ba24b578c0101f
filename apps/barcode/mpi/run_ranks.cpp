// SPDX-License-Identifier: MIT
#include "barcode/mpi/run_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "barcode/arguments/option_scopes.hpp"
#include "barcode/batch.hpp"
#include "barcode/mpi/cloud_ranks.hpp"
#include "barcode/parts/image_parts.hpp"
#include "barcode/parts/part_input.hpp"
#include "common/arguments/numbers.hpp"
#include "common/files/file_identity.hpp"
#include "core/system/files.hpp"
#include "facade/parts/bar_bytes.hpp"
#include "facade/parts/join_ranks.hpp"
#include "facade/parts/loops_of_ranks.hpp"

namespace ph::barcode {
namespace {

/// The part of this rank: computed, or with --resume taken from its file. Else with --resume it is
/// written there. Loops of volumes need voxels, which no file of a part has.
ImagePart own_part(const PartInput& input, int rank, int parts, const std::string& kept,
                   const Arguments& arguments, app::Session& session) {
  if (arguments.resumes) {
    auto there = kept_image_part(kept, arguments.inputs.front(), input, rank, parts, session);
    if (there && !there->has_loops()) {
      session.explain(fmt::format("rank {}: {} is there already", rank, kept));
      return std::move(*there);
    }
  }
  ImagePart part(input.image, rank, parts, input.options, session.context());
  if (arguments.resumes && part.has_loops()) {
    session.note("--resume does nothing for loops of volumes: they are computed anew");
  } else if (arguments.resumes) {
    app::Output output(kept);
    write_part_file(output, part.bytes());
  }
  return part;
}

/// Computes an image on all ranks.
RankResult image_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session) {
  const RunContext& context = session.context();
  const int rank = transport.rank(), size = transport.size();
  PartInput input =
      read_part_input(job.input, job.format == BarcodeFormat::json, arguments, session);
  input.options.loops = true;
  const int parts = std::min(size, ImagePart::most_parts(input.image, input.options.cubical));
  if (parts < size)
    session.note(fmt::format("{} have nothing to do: the image has {}",
                             app::count_of(static_cast<std::size_t>(size - parts), "rank"),
                             app::count_of(static_cast<std::size_t>(parts), "layer")));
  RankResult result;
  std::optional<ImagePart> own;
  if (rank < parts) {
    result.kept = kept_path(arguments, rank, parts);
    own.emplace(own_part(input, rank, parts, result.kept, arguments, session));
  }
  const bool has_loops = own && own->has_loops();
  std::optional<ImageLoops> loops;  // they take voxels from the part before it goes away
  if (has_loops) loops.emplace(*own, arguments.options.field, context);

  Post post(transport);
  const std::optional<ImagePart> whole = join_ranks(std::move(own), post, context);
  Barcode found(CellKind::grid);
  if (has_loops)
    found = loops_of_ranks(std::move(loops), parts, whole ? &*whole : nullptr, post, context);
  explain_costs(post, session);
  if (!whole) return result;
  const std::string description = fmt::format(
      "{}, {}", input.description, app::count_of(static_cast<std::size_t>(parts), "rank"));
  result.bars.emplace(RankBars{whole->barcode(context),
                               info_of(*whole, description, job.input, arguments.options.field)});
  add_bars(result.bars->bars, found);
  result.bars->bars.sort(context);
  return result;
}

}  // namespace

int run_ranks(const Arguments& arguments, Transport& transport,
              const std::function<void()>& wait_for_all, app::Session& session) {
  if (!arguments.wants_part_of_one())
    throw Error(ErrorKind::usage, "INPUT: found several or a folder, expected one image or cloud");
  const bool is_image = arguments.wants_image_part();
  const Situation situation = is_image ? kRanks : kCloudRanks;
  app::require_in_scope(arguments.given, situation, name_of(situation));
  const std::string& path = arguments.inputs.front();
  const BarcodeFormat format = output_format(arguments, session);
  const Job job{path, arguments.output, format, arguments.plots};
  app::InputFiles inputs;
  inputs.add(path);
  std::vector<app::Written> written{{"--output", job.output}};
  for (const app::Plot& plot : job.plots) written.push_back({plot.option, plot.path});
  app::require_separate(inputs, written, arguments.common.force);
  // What cannot be created is said first.
  std::optional<Outputs> outputs;
  if (transport.rank() == 0) outputs.emplace(job);

  RankResult result = is_image ? image_of_ranks(job, arguments, transport, session)
                               : cloud_of_ranks(job, arguments, transport, session);
  int code = 0;
  if (result.bars) {
    const Outcome outcome =
        write_bars(std::move(result.bars->bars), result.bars->info, *outputs, arguments, session);
    session.note(outcome.summary);
    code = outcome.code;
  }
  // Parts are kept until the result is there.
  wait_for_all();
  std::error_code ignored;
  if (arguments.resumes && !result.kept.empty())
    std::filesystem::remove(files::path_of(result.kept), ignored);
  return code;
}

}  // namespace ph::barcode
