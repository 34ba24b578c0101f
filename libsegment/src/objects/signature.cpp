// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "libsegment/src/scene/options.hpp"
#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/segment.hpp"
#include "ph/voxel_image.hpp"

namespace ph::segment {

Barcode signature(const SceneTree& scene, const SceneCut& cut,
                  std::span<const std::uint32_t> labels, const RunContext& context) {
  validate(scene, cut);
  std::vector<bool> wanted(cut.segments.size() + 1);
  for (const std::uint32_t label : labels) {
    if (label == 0 || label > cut.segments.size())
      throw Error(ErrorKind::usage, fmt::format("segment: found {}, expected one of 1 to {}", label,
                                                cut.segments.size()));
    wanted[label] = true;
  }
  const auto is_wanted = [&](std::uint32_t label) { return wanted[label]; };
  Points voxels(std::ranges::count_if(cut.vertex_labels, is_wanted), 3);
  if (voxels.rows() == 0)
    throw Error(ErrorKind::usage, "signature: found no segments, expected at least one");
  Index row = 0;
  for (std::size_t v = 0; v < cut.vertex_labels.size(); ++v) {
    if (!is_wanted(cut.vertex_labels[v])) continue;
    std::ranges::copy(scene.cells[v], voxels.row(row++).begin());
  }
  // Lengths are in voxels, so that the grid of the image equals the grid of the scene.
  PointImage image = voxel_image(voxels, 1, VoxelValue::distance, 1, context);
  const CubicalOptions touching{.construction = CubicalOptions::Construction::cells};
  const Options options{.max_dim = 2, .min_persistence = 1};
  const Barcode in_voxels = persistence(Cubical(image.image, touching, context), options, context);
  Barcode bars(in_voxels.cell_kind());
  for (std::size_t i = 0; i < in_voxels.size(); ++i) {
    const Bar& bar = in_voxels[i];
    const auto death = in_voxels.death_cell(i);
    bars.add({bar.dim, bar.birth * scene.voxel, bar.death * scene.voxel},
             in_voxels.birth_cell(i).numbers,
             death ? std::span<const Index>(death->numbers) : std::span<const Index>());
  }
  return bars;
}

}  // namespace ph::segment
