// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <string_view>
#include <vector>

#include "libsegment/src/objects/objects.hpp"
#include "libsegment/src/supports/containers.hpp"
#include "libsegment/src/supports/stages.hpp"
#include "libsegment/src/supports/surfaces.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/scene_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// Fills the stage table. Between stages, it reports progress and obeys a stop request. A stage
/// that is repeated keeps its row: its times are added up, and its last count is kept.
class StageClock {
 public:
  StageClock(const RunContext& context, std::vector<Stage>& stages)
      : context_(context), stages_(stages) {}
  void finish(std::string_view name, Index points);

 private:
  const RunContext& context_;
  std::vector<Stage>& stages_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The graph that a method makes of a scene. The vertices of `grid` belong to `points`.
struct VoxelFiltration {
  double voxel;  ///< the edge of a voxel of the grid, in metres
  VoxelGrid grid;
  std::vector<Index> points;
  FilteredGraph graph;         ///< its vertices are the voxels
  Surface surface;             ///< empty if the method does not need it
  std::vector<NoiseAt> noise;  ///< used by method surface, see Segmentation
};

/// For method surface, the pairs of voxels that are in each other's neighbourhood (see Surface).
VoxelPairs near_voxels(const VoxelGrid& grid, double voxel, const RunContext& context);
/// For method surface, the distance in metres below which an edge of the graph joins two voxels.
double adjacent_radius(double voxel);

/// The filtration of the methods surface and supervoxels. A voxel enters at the concavity of the
/// surface around it or, with supervoxels, at its distance to the seeds. An edge between adjacent
/// voxels enters together with the later of its ends.
VoxelFiltration surface_filtration(const Scene& scene, const SegmentOptions& options,
                                   const RunContext& context, StageClock& clock);
/// The 1-skeleton of the Vietoris-Rips complex of the voxels.
VoxelFiltration rips_filtration(const Scene& scene, const SegmentOptions& options,
                                const RunContext& context, StageClock& clock);

/// The components that a cut leaves, including small components.
struct Components {
  std::vector<Index> of;  ///< for each vertex, one of the vertices of its component
  std::vector<Container> containers = {};
};

/// The components of a cut. The method, the voxel and the tree are read from `scene`.
/// @param grid its centroids are the vertices. @param surface empty in method paper.
Components components_of(const SceneTree& scene, const VoxelGrid& grid, const Surface& surface,
                         const CutOptions& options, const RunContext& context);

/// Makes the segments of a cut from its components.
SceneCut cut_into(const SceneTree& scene, const Components& components, const Surface& surface,
                  const CutOptions& options, const RunContext& context);

}  // namespace ph::segment
