// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <cstring>

#include "libph/src/cubical/slabs/slabs.hpp"
#include "libph/src/cubical/stars/free_edges.hpp"
#include "ph/detail/core/file_pages.hpp"

namespace ph::cubical {

/// The stars of a grid in a temporary file. They can be read in any order once all slabs have been
/// added.
class StoredStars : public GridFrame {
 public:
  explicit StoredStars(const GridFrame& frame)
      : GridFrame(frame), file_(std::size_t{size()} * sizeof(std::uint32_t)) {}

  /// Stores the stars of a slab, except for its ghosts. @param first the first voxel of the slab in
  /// the entire grid, including ghosts.
  void add(const StarGrid& slab, std::uint32_t first) {
    std::uint32_t begin = 0, end = slab.size();
    while (begin < end && slab.is_ghost(begin)) begin += layer_size();
    while (begin < end && slab.is_ghost(end - 1)) end -= layer_size();
    std::uint32_t* const to = stars() + (first + begin);  // modulo 2^32
    std::memcpy(to, slab.stars().data() + begin, std::size_t{end - begin} * sizeof(*to));
    forget_file_pages(to, std::size_t{end - begin} * sizeof(*to));
  }
  /// Marks the critical edges that are not free. These edges kill a component.
  void mark_all_but(const FreeEdges& free, const RunContext& context) {
    Ticker ticker(context, "marks", size());
    constexpr std::uint32_t block = 1 << 20;
    for (std::uint32_t v = 0; v < size(); ++v) {
      ticker.tick();
      if (v % block == 0) forget_file_pages(file_.data(), file_.size());
      std::uint32_t& star = stars()[v];
      if (star == kAbsent) continue;
      const StarTables& tables = this->tables(v);
      const unsigned critical = tables.critical_edges(star);
      if (critical == 0) continue;
      tables.edge_order().for_each(critical & ~free.edges(v),
                                   [&](int edge) { star |= tables.taken_mark(edge); });
    }
  }
  /// Sets the approximate number of bytes of files that may stay in memory while stars and voxels
  /// are read.
  void let_stay(std::size_t bytes) {
    most_ = resident_.bytes() + bytes;
    all_stay_ = file_.size() + voxel_bytes() <= bytes;
  }
  /// True if all stars and voxels may stay in memory. Reading them in any order is then fast.
  bool all_stay() const { return all_stay_; }

  std::uint32_t star(std::uint32_t v) const { return stars()[v]; }
  void expect_star(std::uint32_t v) const { __builtin_prefetch(stars() + v); }
  bool enters(std::uint32_t v) const { return star(v) != kAbsent; }
  /// Removes pages of the files from memory if they occupy too much of it. Threads call this
  /// function from time to time.
  void tidy() const {
    if (resident_.bytes() <= most_) return;
    forget_file_pages(file_.data(), file_.size());
    if (grid_.is_in_file) forget_file_pages(grid_.voxels, voxel_bytes());
  }

 private:
  std::uint32_t* stars() { return reinterpret_cast<std::uint32_t*>(file_.data()); }
  const std::uint32_t* stars() const {
    return reinterpret_cast<const std::uint32_t*>(file_.data());
  }

  std::size_t voxel_bytes() const {
    return grid_.is_in_file ? grid_.size() * bytes_of(grid_.type) : 0;
  }

  ScratchFile file_;
  ResidentFiles resident_;
  std::size_t most_ = SIZE_MAX;
  bool all_stay_ = true;
};

}  // namespace ph::cubical
