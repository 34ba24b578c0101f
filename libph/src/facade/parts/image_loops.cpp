// SPDX-License-Identifier: MIT
#include "ph/parts/image_loops.hpp"

#include <fmt/format.h>

#include <concepts>
#include <optional>
#include <utility>
#include <variant>

#include "libph/src/cubical/rounds/part_loops.hpp"
#include "libph/src/facade/parts/part_state.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/error.hpp"

namespace ph {

using cubical::FreeCells;
using cubical::GridCell;
using cubical::PartLoops;

struct ImageLoops::State {
  State(const ImagePart::State& of, cubical::OwnLayers layers, std::int64_t characteristic,
        const RunContext& run_context)
      : whole(of.whole),
        field(characteristic),
        shape(of.whole.image()),
        part(of.first),
        context(run_context),
        own(std::move(layers)) {
    detail::with_field(field, [&]<Field K>(const K& k) {
      loops.template emplace<std::unique_ptr<PartLoops<K>>>(std::make_unique<PartLoops<K>>(
          own.stars, shape, whole.layout(shape), part,
          whole.hash() + static_cast<std::uint64_t>(field), k, context));
    });
  }
  template <class Use>
  decltype(auto) with_loops(Use&& use) const {
    return std::visit([&](const auto& some) -> decltype(auto) { return use(*some); }, loops);
  }

  cubical::WholeImage whole;
  std::int64_t field;
  cubical::GridShape shape;
  int part;
  const RunContext& context;
  cubical::OwnLayers own;
  std::variant<std::unique_ptr<PartLoops<Z2>>, std::unique_ptr<PartLoops<Zp>>> loops;
  Traffic traffic;
};

ImageLoops::ImageLoops(ImagePart& part, std::int64_t field, const RunContext& context) {
  if (!part.state_->own)
    throw Error(ErrorKind::usage,
                "loops of an image: found a part without loops, or one that was used already, "
                "expected a part that was computed with option loops");
  detail::with_field(field, [](const auto&) {});  // throws an Error if the field is invalid
  state_ = std::make_unique<State>(*part.state_, *std::exchange(part.state_->own, std::nullopt),
                                   field, context);
}
ImageLoops::ImageLoops(ImageLoops&&) noexcept = default;
ImageLoops& ImageLoops::operator=(ImageLoops&&) noexcept = default;
ImageLoops::~ImageLoops() = default;

int ImageLoops::part() const { return state_->part; }

void ImageLoops::begin(std::span<const std::byte> told) {
  ByteReader from(told, "data for the loops of a part");
  if (from.get<std::uint64_t>("image") != state_->whole.hash())
    throw Error(
        ErrorKind::bad_data,
        "data for the loops of a part: found extents, type, options or number of parts that "
        "differ from those of the part, expected data for the same image");
  if (const auto part = from.get<std::int32_t>("part"); part != state_->part)
    throw Error(
        ErrorKind::bad_data,
        fmt::format("data for the loops of a part: found data for part {}, expected part {}", part,
                    state_->part));
  FreeCells free(&state_->context.memory);
  const auto get = [&](std::pmr::vector<GridCell>& cells, std::size_t in_star) {
    constexpr std::size_t bytes_of_cell = 12;
    for (std::size_t left = from.count(bytes_of_cell, "cells"); left > 0; --left) {
      const auto voxel = from.get<std::uint64_t>("cell");
      const auto number = from.get<std::uint32_t>("cell");
      if (number >= in_star || voxel >= GridCell::kMostVoxels) from.refuse("cell");
      cells.emplace_back(voxel, number);
    }
  };
  get(free.edges, cubical::kEdges.size());
  get(free.squares, cubical::kSquares.size());
  from.expect_end();
  free.add(state_->own.free);  // mutant: join-free
  state_->own.free = FreeCells(&state_->context.memory);
  state_->with_loops([&](auto& loops) { loops.begin(std::move(free)); });
}

void ImageLoops::receive(std::span<const std::byte> message) {
  state_->with_loops([&](auto& loops) { loops.receive(message); });
  ++state_->traffic.messages_received;
}
bool ImageLoops::is_idle() const {
  return state_->with_loops([](const auto& loops) { return loops.is_idle(); });
}
void ImageLoops::work(std::size_t most) {
  state_->with_loops([&](auto& loops) { loops.work(most); });
}

std::vector<ImageLoops::Message> ImageLoops::take_messages() {
  std::vector<Message> messages;
  state_->with_loops([&](auto& loops) {
    loops.send([&](int to, std::vector<std::byte> bytes) {
      ++state_->traffic.messages_sent;
      state_->traffic.bytes_sent += bytes.size();
      messages.push_back({to, std::move(bytes)});
    });
  });
  return messages;
}

Barcode ImageLoops::barcode() const {
  Barcode bars(CellKind::grid);
  const cubical::BarSink sink = state_->whole.sink(bars);
  cubical::PairSink pairs(state_->shape, state_->whole.cells, sink);
  state_->with_loops([&](const auto& loops) { loops.finish(pairs); });
  pairs.finish();
  bars.sort(state_->context);
  BarcodeInfo info = state_->whole.info();
  info.field = state_->field;
  bars.set_info(std::move(info));
  return bars;
}

ImageLoops::Traffic ImageLoops::traffic() const {
  Traffic traffic = state_->traffic;
  state_->with_loops([&](const auto& loops) {
    traffic.columns_sent = loops.columns_sent;
    traffic.columns_received = loops.columns_received;
  });
  return traffic;
}

bool ImagePart::has_loops() const { return state_->whole.loops; }

std::vector<std::byte> ImagePart::told_to_loops(int part) const {
  const cubical::PartLayout layout = state_->whole.layout(state_->shape);
  ByteWriter to;
  to.put(state_->whole.hash());
  to.put(std::int32_t{part});
  for (const auto* const cells : {&state_->freed.edges, &state_->freed.squares}) {
    std::vector<GridCell> some;
    for (const GridCell& cell : *cells)
      if (layout.part_of(cell.voxel() / layout.layer_size()) == part) some.push_back(cell);
    std::ranges::sort(some);
    to.put_list(some, [&](const GridCell& cell) {
      to.put(cell.voxel());
      to.put(cell.number());
    });
  }
  return to.take();
}

}  // namespace ph
