// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "libph/src/core/bytes/crc32.hpp"
#include "libph/src/cubical/columns/ordered_cell.hpp"
#include "libph/src/cubical/grid/star_tables.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/error.hpp"

namespace ph::cubical {

/// A message, as bytes, from one part of a grid to another while both parts reduce columns. It
/// contains the stars of the layers that are ghosts of the receiver, and columns whose pivots
/// belong to the receiver.
template <Field K>
class LoopMessage {
 public:
  using Term = Entry<LoopEdge, K>;

  struct Header {
    std::uint64_t image;  ///< distinguishes images, fields and options
    std::int32_t from, to;
    std::uint64_t number;  ///< counts messages from sender to receiver
  };
  struct Layer {
    std::uint64_t layer;  ///< the layer in the stars' grid
    std::vector<std::uint32_t> stars;
  };
  struct Column {
    LoopSquare square;             ///< the square whose boundary was reduced to this column
    std::pmr::vector<Term> terms;  ///< sorted from young to old
  };

  /// A message to one part, while it is being written.
  class Writer {
   public:
    bool is_empty() const { return layers_ == 0 && columns_ == 0; }
    void add_layer(std::uint64_t layer, std::span<const std::uint32_t> stars) {
      ++layers_;
      layer_bytes_.put(layer);
      layer_bytes_.put_list(stars, [&](std::uint32_t star) { layer_bytes_.put(star); });
    }
    void add_column(const LoopSquare& square, const Term& pivot, std::span<const Term> below) {
      ++columns_;
      put(square);
      column_bytes_.put(std::uint64_t{below.size() + 1});
      put(pivot);
      for (const Term& term : below) put(term);
    }
    /// Returns the bytes that were added since the last call.
    std::vector<std::byte> take(std::uint64_t image, std::int32_t from, std::int32_t to) {
      ByteWriter all;
      all.put(image);
      all.put(from);
      all.put(to);
      all.put(number_++);
      all.put(std::exchange(layers_, 0));
      all.put_bytes(layer_bytes_.take());
      all.put(std::exchange(columns_, 0));
      all.put_bytes(column_bytes_.take());
      all.put(crc32(all.bytes()));
      return all.take();
    }

   private:
    template <unsigned bits>
    void put(const OrderedCell<bits>& cell) {
      column_bytes_.put(cell.key);
      column_bytes_.put(cell.name);
    }
    void put(const Term& term) {
      put(term.cell);
      if constexpr (!std::same_as<K, Z2>) column_bytes_.put(term.coefficient());
    }

    std::uint32_t layers_ = 0;
    std::uint64_t columns_ = 0, number_ = 0;
    ByteWriter layer_bytes_, column_bytes_;
  };

  Header header;
  std::vector<Layer> layers;
  std::vector<Column> columns;

  /// @param voxels the number of voxels of the entire grid. @param memory allocates the columns.
  /// @throws Error (bad_data) if the bytes were not made by Writer, or are for another part.
  LoopMessage(std::span<const std::byte> bytes, const K& field, std::uint64_t image, int to,
              int parts, std::uint64_t voxels, std::pmr::memory_resource* memory)
      : field_(field), voxels_(voxels), from_(bytes, "loops of another part") {
    header.image = from_.get<std::uint64_t>("image");
    if (header.image != image)
      throw Error(
          ErrorKind::bad_data,
          "loops of another part: found extents, type, options, field or number of parts "
          "that differ from those of this part, expected loops of the same image and field");
    header.from = from_.get<std::int32_t>("sender");
    if (header.from < 0 || header.from >= parts || header.from == to) from_.refuse("sender");
    header.to = from_.get<std::int32_t>("receiver");
    if (header.to != to) from_.refuse("receiver");
    header.number = from_.get<std::uint64_t>("number");
    for (auto left = from_.get<std::uint32_t>("count"); left > 0; --left) {
      Layer& layer = layers.emplace_back();
      layer.layer = from_.get<std::uint64_t>("layer");
      layer.stars.resize(from_.count(sizeof(std::uint32_t), "layer"));
      for (std::uint32_t& star : layer.stars) star = from_.get<std::uint32_t>("star");
    }
    constexpr std::size_t bytes_of_cell = 16;
    const std::size_t count = from_.count(2 * bytes_of_cell, "columns");
    columns.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
      columns.push_back({get_cell<LoopSquare>(kSquareCount), std::pmr::vector<Term>(memory)});
      Column& column = columns.back();
      column.terms.resize(from_.count(bytes_of_cell, "column"));
      if (column.terms.empty()) from_.refuse("column");
      for (std::size_t i = 0; i < column.terms.size(); ++i) {
        column.terms[i] = get_term();
        if (i > 0 && !LoopEdge::precedes(column.terms[i].cell, column.terms[i - 1].cell))
          from_.refuse("order");
      }
    }
    const std::uint32_t checksum = crc32(bytes.first(from_.at()));
    if (from_.get<std::uint32_t>("checksum") != checksum) from_.refuse("byte");
    from_.expect_end();
  }

 private:
  template <class Cell>
  Cell get_cell(int in_star) {
    Cell cell{};
    cell.key = from_.get<std::uint64_t>("cell");
    cell.name = from_.get<std::uint64_t>("cell");
    const double value = cell.value();
    if (cell.voxel() >= voxels_ || cell.rank() >= in_star || value != value) from_.refuse("cell");
    return cell;
  }
  Term get_term() {
    const auto cell = get_cell<LoopEdge>(kEdgeCount);
    if constexpr (std::same_as<K, Z2>) {
      return {cell, true};
    } else {
      const auto a = from_.get<typename K::Element>("coefficient");
      if (field_.is_zero(a) || a >= static_cast<std::uint64_t>(field_.characteristic()))
        from_.refuse("coefficient");
      return {cell, a};
    }
  }

  const K& field_;
  std::uint64_t voxels_;
  ByteReader from_;
};

}  // namespace ph::cubical
