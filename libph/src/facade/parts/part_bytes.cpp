// SPDX-License-Identifier: MIT
// Writes a part of an image as bytes, and reads such bytes. The bytes contain the data of the
// image, the numbers of the parts, bars, and forests with their seams. When bytes are read, each
// number that refers to a list is checked against the length of the list.
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "libph/src/core/bytes/crc32.hpp"
#include "libph/src/facade/parts/part_state.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "ph/detail/facade/bar_bytes.hpp"

namespace ph {
namespace {

using cubical::GridCell;
using cubical::Seam;
using cubical::SeamBridge;
using cubical::SeamForest;
using cubical::SeamRoot;
using cubical::WholeImage;

constexpr std::string_view kImageKind = "image";

void put_whole(ByteWriter& to, const WholeImage& whole) {
  to.put_list(whole.extents, [&](Index n) { to.put(std::int64_t{n}); });
  for (const bool periodic : whole.periodic) to.put(periodic);
  to.put(static_cast<std::uint8_t>(whole.type));
  to.put(whole.voxels_are_vertices);
  to.put(whole.superlevel);
  to.put(whole.limit);
  for (const int n : {whole.parts, whole.min_dim, whole.max_dim}) to.put(std::int32_t{n});
  to.put(whole.cells);
  to.put(whole.loops);
  to.put_list(whole.first_layers, [&](Index layer) { to.put(std::int64_t{layer}); });
}

WholeImage get_whole(ByteReader& from) {
  WholeImage whole{};
  const std::size_t axes = from.count(sizeof(std::int64_t), "extents");
  double voxels = 1;
  for (std::size_t k = 0; k < axes; ++k) {
    whole.extents.push_back(static_cast<Index>(from.get<std::int64_t>("extents")));
    if (whole.extents[k] < 1) from.refuse("extents");
    voxels *= static_cast<double>(whole.extents[k]);
  }
  if (voxels > static_cast<double>(GridCell::kMostVoxels)) from.refuse("extents");
  for (std::size_t k = 0; k < axes; ++k) whole.periodic.push_back(from.flag("axis"));
  whole.type = static_cast<VoxelType>(from.get<std::uint8_t>("type"));
  if (whole.type > VoxelType::float64) from.refuse("type");
  whole.voxels_are_vertices = from.flag("construction");
  whole.superlevel = from.flag("sign");
  whole.limit = from.value("threshold");
  for (int* const n : {&whole.parts, &whole.min_dim, &whole.max_dim})
    *n = from.get<std::int32_t>("number");
  whole.cells = from.flag("flag of cells");
  whole.loops = from.flag("flag of loops");
  const CubicalImage image = whole.image();
  if (cubical::GridShape::count_axes(image) > cubical::GridShape::kMostAxes)
    from.refuse("number of axes");
  const cubical::GridShape shape(image);
  if (shape.top_dim() < 2 || whole.parts < 1 ||
      static_cast<std::uint64_t>(whole.parts) > shape.axis(shape.layer_axis()).extent)
    from.refuse("number of parts");
  if (cubical::wants_loops(shape, whole.wanted()) != whole.loops ||
      (whole.loops && shape.top_dim() > 3))
    from.refuse("flag of loops");
  whole.first_layers.resize(from.count(sizeof(std::int64_t), "layers"));
  for (Index& layer : whole.first_layers)
    layer = static_cast<Index>(from.get<std::int64_t>("layer"));
  if (!whole.has_layers(shape)) from.refuse("layers of parts");
  return whole;
}

/// Sorts the cells, which makes the bytes independent of the order of joins.
void put_cells(ByteWriter& to, std::pmr::vector<GridCell> cells) {
  std::ranges::sort(cells);
  to.put_list(cells, [&](const GridCell& cell) {
    to.put(cell.voxel());
    to.put(cell.number());
  });
}

void put_seam(ByteWriter& to, const Seam& seam) {
  to.put_list(seam.roots, [&](std::uint32_t root) { to.put(root); });
  for (const double value : seam.values) to.put(value);
}

template <bool backwards>
void put_forest(ByteWriter& to, const SeamForest<backwards>& forest) {
  to.put_list(forest.roots, [&](const SeamRoot& root) {
    to.put(root.value);
    to.put(root.cell.voxel());
    to.put(root.cell.number());
    to.put(static_cast<std::uint32_t>(root.kind));
  });
  for (const std::uint32_t part : forest.outside) to.put(part);
  put_seam(to, forest.before);
  put_seam(to, forest.after);
  to.put_list(forest.bridges, [&](const SeamBridge& bridge) {
    to.put(bridge.value);
    to.put(bridge.cell.voxel());
    to.put(bridge.cell.number());
    to.put(bridge.from);
    to.put(bridge.to);
  });
}

/// The voxel and the number of a cell, as read from the bytes and not yet checked.
struct CellName {
  std::uint64_t voxel;
  std::uint32_t number;
};
CellName get_name(ByteReader& from) {
  const auto voxel = from.get<std::uint64_t>("cell");
  return {voxel, from.get<std::uint32_t>("cell")};
}
/// Returns the cell with a name that was read, and refuses names that no cell has. @param axes the
/// number of axes of the grid. @param dim the dimension of the cell.
GridCell checked(const ByteReader& from, const CellName& name, int axes, int dim) {
  if (name.voxel >= GridCell::kMostVoxels || !cubical::direction_in_star(axes, dim, name.number))
    from.refuse("cell");
  return {name.voxel, name.number};
}
GridCell get_cell(ByteReader& from, int axes, int dim) {
  return checked(from, get_name(from), axes, dim);
}

void get_cells(ByteReader& from, int axes, int dim, std::pmr::vector<GridCell>& cells) {
  constexpr std::size_t bytes_of_cell = 12;
  cells.resize(from.count(bytes_of_cell, "cells"));
  for (GridCell& cell : cells) cell = get_cell(from, axes, dim);
}

template <bool backwards>
SeamForest<backwards> get_forest(ByteReader& from, int top_dim, const RunContext& context) {
  const int root_dim = backwards ? top_dim : 0, bridge_dim = backwards ? top_dim - 1 : 1;
  SeamForest<backwards> forest(context);
  constexpr std::size_t bytes_of_root = 24, bytes_of_bridge = 28, bytes_of_node = 4;
  forest.roots.resize(from.count(bytes_of_root, "roots"));
  for (SeamRoot& root : forest.roots) {
    root.value = from.value("root");
    const CellName name = get_name(from);
    const auto kind = from.get<std::uint32_t>("root");
    if (kind > static_cast<std::uint32_t>(SeamRoot::Kind::open_after)) from.refuse("root");
    root.kind = static_cast<SeamRoot::Kind>(kind);
    // Roots of other kinds have no cell. Zeros are stored for them.
    root.cell = checked(from, name, top_dim, root.kind == SeamRoot::Kind::critical ? root_dim : 0);
  }
  if (!forest.is_in_order()) from.refuse("order of roots");
  const auto root = [&] {
    const auto number = from.get<std::uint32_t>("root");
    if (number >= forest.roots.size()) from.refuse("root");
    return number;
  };
  for (std::uint32_t& part : forest.outside) part = root();
  for (Seam* const seam : {&forest.before, &forest.after}) {
    seam->roots.resize(from.count(bytes_of_node, "seam"));
    for (std::uint32_t& node : seam->roots) {
      node = from.get<std::uint32_t>("seam");
      if (node != Seam::kNone && node >= forest.roots.size()) from.refuse("seam");
    }
    seam->values.resize(seam->roots.size());
    for (double& value : seam->values) value = from.value("seam");
  }
  forest.bridges.resize(from.count(bytes_of_bridge, "bridges"));
  for (SeamBridge& bridge : forest.bridges) {
    bridge.value = from.value("bridge");
    bridge.cell = get_cell(from, top_dim, bridge_dim);
    bridge.from = root();
    bridge.to = root();
  }
  if (!std::ranges::is_sorted(forest.bridges, {}, &SeamBridge::value))
    from.refuse("order of bridges");
  return forest;
}

}  // namespace

std::uint64_t cubical::WholeImage::hash() const {
  ByteWriter to;
  put_whole(to, *this);
  return crc32(to.bytes());
}

std::vector<std::byte> ImagePart::bytes() const {
  ByteWriter to;
  put_whole(to, state_->whole);
  to.put(std::int32_t{state_->first});
  to.put(std::int32_t{state_->last});
  const cubical::LayerPairs& pairs = state_->pairs;
  to.put(pairs.vertices.has_value());
  if (pairs.vertices) put_forest(to, *pairs.vertices);
  to.put(pairs.tops.has_value());
  if (pairs.tops) put_forest(to, *pairs.tops);
  to.put(std::uint64_t{pairs.around.met_once.size()});
  for (const auto& [edge, value] : pairs.around.met_once) {
    to.put(edge.voxel());
    to.put(edge.number());
    to.put(value);
  }
  put_cells(to, state_->freed.edges);
  put_cells(to, state_->freed.squares);
  Barcode bars = state_->bars;
  bars.sort(state_->context);
  put_bars(to, bars);
  to.put(state_->fingerprint);
  return sealed_part(kImageKind, to.take());
}

ImagePart ImagePart::of_bytes(std::span<const std::byte> bytes, const RunContext& context) {
  ByteReader from(content_of_part(bytes, kImageKind), "part of an image");
  auto state = std::make_unique<State>(get_whole(from), context);
  state->first = from.get<std::int32_t>("number");
  state->last = from.get<std::int32_t>("number");
  if (state->first < 0 || state->last < state->first || state->last >= state->whole.parts)
    from.refuse("number");
  const bool from_end = state->shape.is_t_construction();
  const bool is_first = state->first == 0, is_last = state->last + 1 == state->whole.parts;
  cubical::LayerPairs& pairs = state->pairs;
  pairs.has_begin = from_end ? is_last : is_first;
  pairs.has_end = from_end ? is_first : is_last;
  const int top = state->shape.top_dim();
  if (from.flag("forest") != pairs.wants_vertices()) from.refuse("forest");
  if (pairs.wants_vertices()) pairs.vertices.emplace(get_forest<false>(from, top, context));
  if (from.flag("forest") != pairs.wants_tops()) from.refuse("forest");
  if (pairs.wants_tops()) pairs.tops.emplace(get_forest<true>(from, top, context));
  constexpr std::size_t bytes_of_edge = 20;
  for (std::size_t left = from.count(bytes_of_edge, "edges"); left > 0; --left) {
    const GridCell edge = get_cell(from, top, 1);
    pairs.around.met_once.emplace(edge, from.value("edge"));
  }
  get_cells(from, top, 1, state->freed.edges);
  get_cells(from, top, 2, state->freed.squares);
  get_bars(from, state->bars);
  state->claim.grow_to(state->bars.bytes());
  state->fingerprint = from.get<std::uint64_t>("fingerprint");
  from.expect_end();
  return ImagePart(std::move(state));
}

}  // namespace ph
