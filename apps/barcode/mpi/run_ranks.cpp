// SPDX-License-Identifier: MIT
#include "barcode/mpi/run_ranks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "barcode/arguments/option_scopes.hpp"
#include "barcode/batch.hpp"
#include "barcode/memory/forecast_text.hpp"
#include "barcode/parts/image_parts.hpp"
#include "barcode/parts/part_input.hpp"
#include "common/arguments/numbers.hpp"
#include "common/files/file_identity.hpp"
#include "common/terminal/exit_code.hpp"
#include "core/bytes/byte_reader.hpp"
#include "core/bytes/byte_writer.hpp"
#include "core/system/files.hpp"
#include "facade/parts/bar_bytes.hpp"
#include "facade/parts/join_ranks.hpp"
#include "facade/parts/loops_of_ranks.hpp"

namespace ph::barcode {
namespace {

/// The first layers of all parts if layers are shared out by what is in them: rank 0 looks at a
/// sample of the image, and tells the others.
std::vector<Index> shared_out(const PartInput& input, int parts, Post& post,
                              app::Session& session) {
  std::vector<Index> layers;
  if (post.rank() != 0) {
    const std::vector<std::byte> bytes = post.receive(0);
    ByteReader from(bytes, "layers of ranks");
    layers.resize(from.count(sizeof(std::int64_t), "layers"));
    for (Index& layer : layers) layer = static_cast<Index>(from.get<std::int64_t>("layer"));
    return layers;
  }
  const ImagePartForecast forecast = ImagePart::forecast(input.image, parts, input.options);
  if (is_unequal(forecast)) {
    layers = forecast.first_layers;
    session.explain(
        fmt::format("ranks begin with layers {}: else one would take {:.1f} times the "
                    "mean",
                    fmt::join(layers, ", "), forecast.longest));
  }
  ByteWriter to;
  to.put_list(layers, [&](Index layer) { to.put(std::int64_t{layer}); });
  const std::vector<std::byte> bytes = to.take();
  for (int other = 1; other < post.size(); ++other) post.send(other, bytes);
  return layers;
}

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

/// The image once all ranks have joined it, and its bars.
struct Whole {
  ImagePart part;
  Barcode bars;
};

/// Computes the part of this rank and joins it with the others. @return what rank 0 has then.
std::optional<Whole> computed(const PartInput& input, int parts, const std::string& kept,
                              const Arguments& arguments, Post& post, app::Session& session) {
  const RunContext& context = session.context();
  const int rank = post.rank();
  std::optional<ImagePart> own;
  if (rank < parts) own.emplace(own_part(input, rank, parts, kept, arguments, session));
  const bool has_loops = own && own->has_loops();
  std::optional<ImageLoops> loops;  // they take voxels from the part before it goes away
  if (has_loops) loops.emplace(*own, arguments.options.field, context);

  std::optional<ImagePart> whole = join_ranks(std::move(own), post, context);
  Barcode found(CellKind::grid);
  if (has_loops)
    found = loops_of_ranks(std::move(loops), parts, whole ? &*whole : nullptr, post, context);
  session.explain(fmt::format("memory {}, sent {}",
                              app::format_size(static_cast<double>(session.memory_taken())),
                              app::format_size(static_cast<double>(post.bytes_sent()))));
  if (!whole) return std::nullopt;
  Barcode bars = whole->barcode(context);
  add_bars(bars, found);
  bars.sort(context);
  return Whole{std::move(*whole), std::move(bars)};
}

}  // namespace

int run_ranks(const Arguments& arguments, Transport& transport,
              const std::function<void()>& wait_for_all, app::Session& session) {
  const int rank = transport.rank(), size = transport.size();
  app::require_in_scope(arguments.given, kRanks, name_of(kRanks));
  if (!arguments.wants_image_part())
    throw Error(ErrorKind::usage, "INPUT: found several or a folder, expected one image");
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
  if (rank == 0 && !arguments.dry_run) outputs.emplace(job);

  PartInput input = read_part_input(path, format == BarcodeFormat::json, arguments, session);
  input.options.loops = true;
  const int parts = std::min(size, ImagePart::most_parts(input.image, input.options.cubical));
  if (parts < size)
    session.note(fmt::format("{} have nothing to do: the image has {}",
                             app::count_of(static_cast<std::size_t>(size - parts), "rank"),
                             app::count_of(static_cast<std::size_t>(parts), "layer")));
  if (arguments.dry_run) {
    if (rank == 0) foresee(input, parts, true);
    wait_for_all();
    return app::kOk;
  }
  Post post(transport);
  input.options.first_layers = shared_out(input, parts, post, session);
  const std::string kept = fmt::format("{}.{}of{}.ph", arguments.output, rank + 1, parts);
  std::optional<Whole> whole = computed(input, parts, kept, arguments, post, session);
  int code = 0;
  if (whole) {
    const std::string description = fmt::format(
        "{}, {}", input.description, app::count_of(static_cast<std::size_t>(parts), "rank"));
    const BarcodeInfo info = info_of(whole->part, description, path, arguments.options.field);
    const Outcome outcome = write_bars(std::move(whole->bars), info, *outputs, arguments, session);
    session.note(outcome.summary);
    code = outcome.code;
  }
  // Parts are kept until the result is there.
  wait_for_all();
  std::error_code ignored;
  if (arguments.resumes && rank < parts) std::filesystem::remove(files::path_of(kept), ignored);
  return code;
}

}  // namespace ph::barcode
