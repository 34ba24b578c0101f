// SPDX-License-Identifier: MIT
#pragma once
// Checks sets of voxels that represent bars of images. The expected sets are found by flood fill
// from the definition.
#include <cstdlib>
#include <set>

#include "tests/support/representatives.hpp"

namespace ph::test {

using Place = std::size_t;
using PlaceSet = std::set<Place>;

/// An image as a graph. Its nodes are the voxels and the outside. An axis has two ends if
/// has_axis() is true and it is not periodic. If exactly one axis has ends, the outside has two
/// nodes, and otherwise one.
class VoxelNeighbours {
 public:
  VoxelNeighbours(const std::vector<Index>& extents, std::vector<bool> periodic,
                  CubicalOptions::Construction construction)
      : extents_(extents),
        periodic_(std::move(periodic)),
        is_vertices_(construction == CubicalOptions::Construction::vertices) {
    periodic_.resize(extents_.size());
    for (const Index n : extents_) size_ *= static_cast<Place>(n);
    for (std::size_t k = 0; k < extents_.size(); ++k)
      if (has_axis(k) && !periodic_[k]) ++open_axes_;
  }
  Place size() const { return size_; }
  Place outside(bool upper) const { return size_ + (open_axes_ == 1 && upper ? 1 : 0); }
  /// True if axis k has several voxels or, in the T-construction, is not periodic.
  bool has_axis(std::size_t k) const { return extents_[k] > 1 || (!is_vertices_ && !periodic_[k]); }
  int axes() const {
    int count = 0;
    for (std::size_t k = 0; k < extents_.size(); ++k) count += has_axis(k) ? 1 : 0;
    return count;
  }
  /// True if a periodic axis has only one voxel.
  bool has_loop() const {
    for (std::size_t k = 0; k < extents_.size(); ++k)
      if (extents_[k] == 1 && periodic_[k]) return true;
    return false;
  }
  Place place(std::span<const Index> voxel) const {
    Place result = 0;
    for (std::size_t k = 0; k < voxel.size(); ++k)
      result = result * static_cast<Place>(extents_[k]) + static_cast<Place>(voxel[k]);
    return result;
  }

  /// The nodes that can be reached from `from` through open nodes, that is, nodes for which `open`
  /// returns true. Includes `from`. Empty if `from` is not open.
  /// @param wide if true, voxels that share a corner are neighbours; if false, only voxels that
  /// share a facet.
  template <class IsOpen>
  PlaceSet flood(Place from, bool wide, IsOpen&& open) const {
    PlaceSet met;
    std::vector<Place> queue;
    const auto meet = [&](Place p) {
      if (open(p) && met.insert(p).second) queue.push_back(p);
    };
    meet(from);
    while (!queue.empty()) {
      const Place p = queue.back();
      queue.pop_back();
      if (p < size_) {
        for_each_neighbour(p, wide, meet);
        continue;
      }
      for (Place v = 0; v < size_; ++v)
        for_each_neighbour(v, false, [&](Place u) {
          if (u == p) meet(v);
        });
    }
    return met;
  }

 private:
  template <class Use>
  void for_each_neighbour(Place p, bool wide, Use&& use) const {
    std::vector<Index> at(extents_.size());
    for (std::size_t k = extents_.size(), rest = p; k-- > 0;) {
      at[k] = static_cast<Index>(rest % static_cast<Place>(extents_[k]));
      rest /= static_cast<Place>(extents_[k]);
    }
    std::vector<int> step(extents_.size(), -1);
    for (bool more = true; more;) {
      int axes = 0;
      for (const int s : step) axes += std::abs(s);
      if (axes == 1 || (wide && axes > 1)) use(moved(at, step));
      std::size_t k = step.size();
      while (k > 0 && ++step[k - 1] == 2) step[--k] = -1;
      more = k > 0;
    }
  }
  Place moved(const std::vector<Index>& at, const std::vector<int>& step) const {
    std::vector<Index> to = at;
    for (std::size_t k = 0; k < to.size(); ++k) {
      if (step[k] == 0) continue;
      to[k] += step[k];
      if (periodic_[k]) to[k] = (to[k] + extents_[k]) % extents_[k];
      // In the V-construction, an axis of one voxel has no outside.
      if (!has_axis(k)) return place(at);
      if (to[k] < 0) return outside(false);
      if (to[k] == extents_[k]) return outside(true);
    }
    return place(to);
  }

  std::vector<Index> extents_;
  std::vector<bool> periodic_;
  bool is_vertices_;
  Place size_ = 1;
  int open_axes_ = 0;
};

/// Checks bars whose representatives were requested as sets of voxels: which bars have a set, and
/// which voxels are in each set. The other bars must have a cycle.
inline void check_voxel_sets(const Image& image, const CubicalOptions& options, const Barcode& bars,
                             std::int64_t field) {
  const VoxelNeighbours grid(image.extents, options.periodic, options.construction);
  const bool is_vertices = options.construction == CubicalOptions::Construction::vertices;
  const double sign = options.superlevel ? -1 : 1;
  const auto value = [&](Place p) { return sign * image.values[p] + 0.0; };
  const auto enters = [&](Place p) {
    return value(p) < kInfinity && (!options.threshold || value(p) <= *options.threshold);
  };
  const Cubical cubical(image, options);
  const OrderedCells<Cubical> cells(cubical, cubical.top_dim() + 1, field);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    SCOPED_TRACE("bar " + std::to_string(i));
    const Bar& bar = bars[i];
    ASSERT_EQ(bars.birth_voxel(i).size(), image.extents.size());
    EXPECT_EQ(value(grid.place(bars.birth_voxel(i))), bar.birth);
    ASSERT_EQ(bars.death_voxel(i).empty(), bar.is_infinite());
    if (!bar.is_infinite()) {
      EXPECT_EQ(value(grid.place(bars.death_voxel(i))), bar.death);
    }
    const auto span = bars.voxels(i);
    const PlaceSet found(span.begin(), span.end());
    ASSERT_EQ(found.size(), span.size()) << "a voxel occurs twice";
    const bool has_chain = bars.representative(i).size() > 0;
    if (bar.dim == 0) {
      EXPECT_FALSE(has_chain);
      EXPECT_EQ(found, grid.flood(grid.place(bars.birth_voxel(i)), !is_vertices, [&](Place p) {
        return p < grid.size() && enters(p) && value(p) < bar.death;
      }));
      continue;
    }
    // Only classes of the highest dimension but one can surround voxels. If such a class is never
    // filled, its set may still be empty, and then the bar has a cycle.
    const bool may_be_hollow = !grid.has_loop() && bar.dim == grid.axes() - 1;
    if (!may_be_hollow || (bar.is_infinite() && has_chain)) {
      EXPECT_TRUE(found.empty());
      check_cycle(cells, bars, i);
      continue;
    }
    EXPECT_FALSE(has_chain);
    ASSERT_FALSE(found.empty());
    const auto is_open = [&](Place p) {
      return p >= grid.size() || !enters(p) || value(p) > bar.birth;
    };
    // A void that is never filled contains a voxel that never enters, or the outside beyond one end
    // of an axis. It does not contain the outside beyond the other end.
    const Place beyond = grid.outside(is_vertices), other = grid.outside(!is_vertices);
    const Place inside = bar.is_infinite() ? *found.begin() : grid.place(bars.death_voxel(i));
    PlaceSet filled = grid.flood(inside, is_vertices, is_open);
    if (bar.is_infinite()) {
      EXPECT_TRUE(
          std::ranges::any_of(filled, [&](Place p) { return p >= grid.size() || !enters(p); }));
    }
    if (bar.is_infinite() && beyond != other) filled.erase(beyond);
    EXPECT_EQ(found, filled);
  }
}

}  // namespace ph::test
