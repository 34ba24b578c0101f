// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/objects.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory_resource>
#include <utility>

#include "libsegment/src/objects/view.hpp"
#include "libsegment/src/scene/close_boxes.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/surface/concavity.hpp"
#include "libsegment/src/vessels/stages.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

constexpr std::uint32_t kSmall = Parts::kSmall;

/// Finds parts whose surfaces continue behind an occluder.
class HiddenJoins {
  /// A voxel next to an occluder.
  struct BorderVoxel {
    std::uint32_t number;
    Eigen::Vector3d place, normal;
  };
  using Border = std::vector<BorderVoxel>;

  double nearer() const {
    constexpr double voxels = 2;
    return voxels * voxel_;
  }
  auto kind() const {
    return [this](std::uint32_t v) {
      return parts_.of[v] == kSmall ? kSmall : object_of_[parts_.of[v]];
    };
  }

 public:
  /// @param object_of for each part, its object as far as it is known. Parts of one object do not
  /// hide each other.
  HiddenJoins(const VoxelGrid& grid, const Surface& surface, double voxel, const Parts& parts,
              std::vector<std::uint32_t> object_of)
      : voxel_(voxel),
        parts_(parts),
        object_of_(std::move(object_of)),
        view_(grid.centroids, voxel, surface.viewpoint),
        borders_(parts.count()) {
    for (std::uint32_t v = 0; v < parts.of.size(); ++v)
      if (parts.of[v] != kSmall && std::isfinite(surface.normals(v, 0)) &&
          view_.is_at_occluder(v, nearer(), kind()))
        borders_[parts.of[v]].push_back(
            {v, as_matrix(grid.centroids).row(v), as_matrix(surface.normals).row(v)});
    for (Border& border : borders_) thin_out(border);
  }

  template <class Join>
  void find(const RunContext& context, Join&& join) const {
    // The shares of the borders.
    constexpr double least_of_each = 0.1, least_of_both = 0.34;
    std::vector<PartBox<3>> boxes;
    for (std::uint32_t p = 0; p < borders_.size(); ++p)
      if (!borders_[p].empty()) boxes.push_back({p, box_of(borders_[p])});
    for_each_close_pair(
        boxes, [](const PartBox<3>&) { return kLongestGap; }, context,
        [&](std::uint32_t p, std::uint32_t q) {
          const double a = share_that_goes_on(p, q);
          if (a < least_of_each) return;
          const double b = share_that_goes_on(q, p);
          if (b >= least_of_each && a + b >= least_of_both) join(p, q);
        });
  }

 private:
  // In metres; behind a wider occluder, a join would only be a guess.
  static constexpr double kLongestGap = 0.15;

  /// Keeps a limited number of evenly spread voxels, because the decision about parts depends only
  /// on shares of the voxels.
  static void thin_out(Border& border) {
    constexpr std::size_t most = 60;
    const std::size_t step = border.size() / most + 1;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < border.size(); i += step) border[kept++] = border[i];
    border.erase(border.begin() + static_cast<std::ptrdiff_t>(kept), border.end());
  }
  static Eigen::AlignedBox3d box_of(const Border& border) {
    Eigen::AlignedBox3d box;
    for (const BorderVoxel& v : border) box.extend(v.place);
    return box;
  }
  double share_that_goes_on(std::uint32_t p, std::uint32_t q) const {
    const auto count = std::ranges::count_if(borders_[p], [&](const BorderVoxel& a) {
      return std::ranges::any_of(borders_[q], [&](const BorderVoxel& b) { return goes_on(a, b); });
    });
    return static_cast<double>(count) / static_cast<double>(borders_[p].size());
  }
  /// True if one smooth surface through both voxels is hidden between them.
  bool goes_on(const BorderVoxel& a, const BorderVoxel& b) const {
    constexpr double cosine = 0.966;                 // the cosine of 15 degrees between the normals
    constexpr double thickness = 0.6, slope = 0.05;  // in voxels, and a share of the gap
    if (a.normal.dot(b.normal) < cosine) return false;
    const Eigen::Vector3d d = b.place - a.place;
    const double gap = d.norm(), tolerance = thickness * voxel_ + slope * gap;
    if (gap > kLongestGap || std::abs(a.normal.dot(d)) > tolerance ||
        std::abs(b.normal.dot(d)) > tolerance)
      return false;
    constexpr int fewest_cells = 2;
    constexpr double share = 0.85;
    const View::Cover cover = view_.cover(a.number, b.number, nearer() / 2, kind());
    return cover.hidden >= fewest_cells && cover.hidden >= share * cover.cells;
  }

  double voxel_;
  const Parts& parts_;
  std::vector<std::uint32_t> object_of_;
  View view_;
  std::vector<Border> borders_;  // the border of each part
};

}  // namespace

std::vector<Index> join_parts(const VoxelGrid& grid, const Surface& surface, double voxel,
                              const std::vector<Index>& part_of, Index min_size,
                              const RunContext& context) {
  const Parts parts = number_parts(part_of, min_size);
  if (parts.count() < 2) return part_of;
  DisjointSets objects(parts.count(), std::pmr::get_default_resource());
  const auto join = [&](std::uint32_t p, std::uint32_t q) {
    const std::uint32_t a = objects.find(p), b = objects.find(q);
    objects.link(std::max(a, b), std::min(a, b));
  };
  // The inside of a mug is not the continuation of the box below it, although the wall of the mug
  // hides the place between them. Therefore, rims are joined first.
  if (surface.support)
    join_around_rims(grid.centroids, voxel, surface.support->normal, parts, join, context);
  std::vector<std::uint32_t> around_rims;
  for (std::uint32_t p = 0; p < parts.count(); ++p) around_rims.push_back(objects.find(p));
  HiddenJoins(grid, surface, voxel, parts, std::move(around_rims)).find(context, join);
  std::vector<Index> object_of = part_of;
  for (std::size_t v = 0; v < object_of.size(); ++v)
    if (parts.of[v] != kSmall) object_of[v] = part_of[parts.example[objects.find(parts.of[v])]];
  return object_of;
}

}  // namespace ph::segment
