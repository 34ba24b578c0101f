// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "free_edges.hpp"
#include "ph/core/file_pages.hpp"
#include "star_grid.hpp"

namespace ph::cubical {

/// The stars of a grid of three axes of which only some bricks are in memory at a time, with their
/// voxels: those that were asked for last; others are found again from the image. For one thread.
class StarBricks : public GridFrame {
 public:
  /// @param free which critical edges bear no mark. @param bytes that the bricks may take; a few
  ///        are held in any case.
  StarBricks(const GridFrame& frame, const FreeEdges& free, double bytes, const RunContext& context)
      : GridFrame(frame),
        free_(free),
        cube_pairs_(cube_pair_memos(*this, context)),
        context_(context) {
    std::size_t count = 1, voxels = 1;
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t length = is_periodic(a) ? extent(a) : std::min(extent(a), kEdge);
      by_length_[a] = Divisor(length);
      length_[a] = length;
      counts_[a] = (extent(a) - 1) / length + 1;
      count *= counts_[a];
      voxels *= length + 2;
    }
    bricks_.resize(count);
    const double most = bytes / static_cast<double>(voxels * (4 + bytes_of(grid_.type)));
    most_ = static_cast<std::size_t>(std::clamp(most, 8.0, 8.0 + static_cast<double>(count)));
  }

  std::uint32_t star(std::uint32_t v) {
    const auto [brick, local] = find(v);
    return brick->stars->star(local);
  }
  double value(std::uint32_t v) {
    const auto [brick, local] = find(v);
    return brick->stars->value(local);
  }
  bool enters(std::uint32_t v) { return star(v) != kAbsent; }
  /// Orders voxels so that those of a brick follow each other.
  std::uint32_t brick_of(std::uint32_t v) const { return number_of_brick(bricks_around(v)); }

 private:
  static constexpr std::uint32_t kEdge = 32;  // voxels along an axis that is not periodic
  using Place = std::array<std::uint32_t, 3>;
  struct Brick {
    explicit Brick(std::pmr::memory_resource* memory) : voxels(memory) {}
    std::pmr::vector<std::byte> voxels;
    std::unique_ptr<StarGrid> stars = nullptr;
    Place begin{};  // ghosts included
    std::uint64_t last_use = 0;
  };
  struct Found {
    const Brick* brick;
    std::uint32_t local;
  };

  Place place_of(std::uint32_t v) const {
    return {coordinate(v, 0), coordinate(v, 1), coordinate(v, 2)};
  }
  Place bricks_around(std::uint32_t v) const {
    Place brick = place_of(v);
    for (int a = 0; a < 3; ++a) brick[a] = by_length_[a].divide(brick[a]);
    return brick;
  }
  std::uint32_t number_of_brick(const Place& brick) const {
    return (brick[0] * counts_[1] + brick[1]) * counts_[2] + brick[2];
  }

  Found find(std::uint32_t v) {
    const Place place = place_of(v);
    Place at{};
    for (int a = 0; a < 3; ++a) at[a] = by_length_[a].divide(place[a]);
    const std::uint32_t number = number_of_brick(at);
    auto& brick = bricks_[number];
    if (brick == nullptr) {
      make_room();
      held_.push_back(number);
      brick = load(at);
    }
    if (brick->last_use != now_) brick->last_use = ++now_;
    std::uint32_t local = 0;
    for (int a = 0; a < 3; ++a) local += (place[a] - brick->begin[a]) * brick->stars->stride(a);
    return {brick.get(), local};
  }
  void make_room() {
    if (held_.size() < most_) return;
    const auto oldest =
        std::ranges::min_element(held_, {}, [&](std::uint32_t i) { return bricks_[i]->last_use; });
    bricks_[*oldest].reset();
    *oldest = held_.back();
    held_.pop_back();
  }
  std::unique_ptr<Brick> load(const Place& at) const {
    auto brick = std::make_unique<Brick>(&context_.memory);
    Place end{};
    for (int a = 0; a < 3; ++a) {
      const std::uint32_t first = at[a] * length_[a];
      const bool ghosts = !is_periodic(a);
      brick->begin[a] = first - (ghosts && first > 0 ? 1 : 0);
      end[a] = std::min(first + length_[a] + (ghosts ? 1 : 0), extent(a));
    }
    const CubicalImage part = copy(brick->begin, end, brick->voxels);
    brick->stars = std::make_unique<StarGrid>(part, context_, SlabEnds{.cube_pairs = cube_pairs_});
    mark(*brick->stars, brick->begin);
    return brick;
  }
  // Edges that kill a component are marked: all critical ones that are not free. Ghosts are never
  // asked for.
  void mark(StarGrid& stars, const Place& begin) const {
    for (const std::uint32_t local : stars.critical()) {
      const StarTables& tables = stars.tables(local);
      const unsigned critical = tables.critical_edges(stars.star(local));
      if (critical == 0) continue;
      std::uint32_t v = 0;
      for (int a = 0; a < 3; ++a) v += (begin[a] + stars.coordinate(local, a)) * stride(a);
      tables.edge_order().for_each(critical & ~free_.edges(v),
                                   [&](int edge) { stars.mark(local, tables.taken_mark(edge)); });
    }
  }
  CubicalImage copy(const Place& begin, const Place& end,
                    std::pmr::vector<std::byte>& voxels) const {
    const std::size_t bytes = bytes_of(grid_.type);
    Place from{}, size{};  // in the image: the T-construction counts from the other end
    for (int a = 0; a < 3; ++a) {
      size[a] = end[a] - begin[a];
      from[a] = relative_ ? extent(a) - end[a] : begin[a];
    }
    const std::size_t row = size[2] * bytes;
    voxels.resize(std::size_t{size[0]} * size[1] * row);
    const auto* image = static_cast<const std::byte*>(grid_.voxels);
    std::byte* to = voxels.data();
    for (std::uint32_t z = from[0]; z < from[0] + size[0]; ++z)
      for (std::uint32_t y = from[1]; y < from[1] + size[1]; ++y, to += row)
        std::memcpy(to, image + (z * std::size_t{stride(0)} + y * stride(1) + from[2]) * bytes,
                    row);
    if (grid_.is_in_file)
      forget_file_pages(image + from[0] * std::size_t{stride(0)} * bytes,
                        size[0] * std::size_t{stride(0)} * bytes);
    return with_extents(size, voxels.data());
  }

  const FreeEdges& free_;
  CubePairMemos cube_pairs_;
  const RunContext& context_;
  Place length_{}, counts_{};
  std::array<Divisor, 3> by_length_;
  std::size_t most_ = 0;
  std::vector<std::unique_ptr<Brick>> bricks_;
  std::vector<std::uint32_t> held_;
  std::uint64_t now_ = 0;
};

}  // namespace ph::cubical
