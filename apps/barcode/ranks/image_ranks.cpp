// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "apps/barcode/memory/forecast_text.hpp"
#include "apps/barcode/parts/image_parts.hpp"
#include "apps/barcode/parts/part_input.hpp"
#include "apps/barcode/ranks/rank_result.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/facade/bar_bytes.hpp"
#include "ph/detail/facade/join_ranks.hpp"

namespace ph::barcode {
namespace {

/// The first layer of each part, if layers are distributed by their content. Rank 0 determines
/// these layers from a sample of the image and sends them to the other ranks.
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
    session.explain(fmt::format(
        "the ranks begin with layers {}: otherwise the slowest rank would take {:.1f} times the "
        "mean time",
        fmt::join(layers, ", "), forecast.longest));
  }
  ByteWriter to;
  to.put_list(layers, [&](Index layer) { to.put(std::int64_t{layer}); });
  const std::vector<std::byte> bytes = to.take();
  for (int other = 1; other < post.size(); ++other) post.send(other, bytes);
  return layers;
}

}  // namespace

RankResult image_of_ranks(const Job& job, Transport& transport, app::Session& session) {
  const RunContext& context = session.context();
  const int rank = transport.rank(), size = transport.size();
  PartInput input =
      read_part_input(job.places.input, job.places.format == BarcodeFormat::json, job, session);
  input.options.loops = true;
  const int parts = std::min(size, ImagePart::most_parts(input.image, input.options.cubical));
  if (parts < size)
    session.note(fmt::format("nothing to do for {}: the image has {}",
                             app::count_of(static_cast<std::size_t>(size - parts), "rank"),
                             app::count_of(static_cast<std::size_t>(parts), "layer")));
  RankResult result;
  if (job.results.dry_run) {
    if (rank == 0) foresee(input, parts, "rank");
    return result;
  }
  Post post(transport);
  input.options.first_layers = shared_out(input, parts, post, session);
  std::optional<ImagePart> own;
  if (rank < parts) {
    result.kept = kept_path(job, rank, parts);
    own.emplace(kept_or_computed(
        result.kept, job, session,
        [&] { return kept_image_part(result.kept, input, rank, parts, session); },
        [&] { return ImagePart(input.image, rank, parts, input.options, context); },
        [&](const ImagePart& part) {
          // The search for loops needs voxels, which are not in part files.
          if (!part.has_loops()) return true;
          session.note("--resume does nothing for loops of volumes: they are computed anew");
          return false;
        }));
  }
  const bool has_loops = own && own->has_loops();
  if (has_loops && job.common.slab_layers > 0)
    session.note("--slab-layers does nothing for loops of volumes: they need all layers of a part");
  // The search for loops takes the voxels out of the part first, because the join destroys the
  // part.
  std::optional<ImageLoops> loops;
  if (has_loops) loops.emplace(*own, job.question.options.field, context);

  const std::optional<ImagePart> whole = join_ranks(std::move(own), post, context);
  Barcode found(CellKind::grid);
  if (has_loops)
    found = loops_of_ranks(std::move(loops), parts, whole ? &*whole : nullptr, post, context);
  explain_costs(post, session);
  if (!whole) return result;
  const std::string description = fmt::format(
      "{}, {}", input.description, app::count_of(static_cast<std::size_t>(parts), "rank"));
  RankBars& all = result.bars.emplace(RankBars{whole->barcode(context), {}});
  all.info = named(all.bars.info(), description, job);
  all.info.field = job.question.options.field;
  add_bars(all.bars, found);
  all.bars.sort(context);
  return result;
}

}  // namespace ph::barcode
