// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "ph/detail/metric/metric.hpp"
#include "ph/detail/rips/vertex_weights.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The edges under a Vietoris-Rips filtration; see ph/custom.hpp.
class RipsGraph;

/// How a Vietoris-Rips filtration is built.
struct RipsOptions {
  /// Largest distance at which two points are joined, inclusive. Default: the enclosing radius
  /// min_i max_j d(i,j) if all distances are known (beyond it nothing but one component is left,
  /// so the barcode is complete), no limit for sparse distances.
  std::optional<double> threshold = std::nullopt;
  PointDistance distance = PointDistance::euclidean;  ///< for points
  double minkowski_p = 2;                             ///< exponent of PointDistance::minkowski
  /// Points that are vertices, ascending and named as in the input; empty: all. The rest is as if
  /// it were not there. Read while the filtration is built, as are births.
  std::span<const std::uint32_t> vertices = {};
  /// The diameter at which each point enters, by point of the input: finite, >= 0; default: 0, or
  /// those of a DistanceMatrix that has some. An edge enters when the balls of its ends meet, see
  /// VertexWeights; who is born beyond the threshold is no vertex.
  std::span<const double> births = {};
  WeightExponent weight_exponent = WeightExponent::infinity;  ///< how balls grow from a birth on
  /// Points only: equal ones become one vertex, named by the first of them; not where they have
  /// births. All bars of positive length stay the same, those of length zero that the copies cause
  /// are left out; many copies cost nothing, where each pair of them would be an edge. Cycles stay
  /// cycles of all points; cocycles are those of the distinct points and say nothing about the
  /// copies.
  bool merge_equal_points = false;
  /// Epsilon > 0: the sparse Rips filtration in its place, with fewer edges and bars that are born
  /// and die later by a factor of 1 + epsilon at most, see SparseRips. Needs all distances and the
  /// triangle inequality; neither births nor only_components. The default threshold is where one
  /// component is left.
  std::optional<double> approximation = std::nullopt;
  /// Only a minimum spanning forest is held: enough for H0, cell by cell, and for merge trees, and
  /// nothing else can be computed. Points of few dimensions take near-linear time (Euclidean,
  /// Manhattan, Chebyshev, Minkowski), all else O(n) memory beside the input. Without a threshold
  /// there is none: no enclosing radius is looked for.
  bool only_components = false;
  /// Only the points are held, no edges: enough for bars of positive length of H0 and H1, without
  /// representatives, by Engine::beta_skeleton, and nothing else can be computed. Euclidean points
  /// of 1 to 4 coordinates, all zero or of a size from 1e-120 to 1e150, without births. Without a
  /// threshold there is none. `holds_points_alone` in ph/persistence.hpp says where this pays.
  bool only_points = false;
  /// Device::gpu: the forest of only_components is found there, the same one, edge for edge. For
  /// Euclidean points without births, whose largest coordinate is 0 or of a size from 1e-140 to
  /// 1e150.
  Device device = Device::cpu;
};

/// The Vietoris-Rips filtration of a finite set with distances: a simplex enters at its diameter,
/// the largest distance between two of its vertices. Vertices enter at 0. Vertex i is point i,
/// unless some points are no vertices or equal points are merged. Weighted Rips filtrations have
/// births of vertices and edges at which balls meet in the place of 0 and distances.
///
/// Holds the graph of all edges up to the threshold, no simplices. A value, cheap to copy.
class Rips {
 public:
  /// @param points one point a row. O(n^2) distances, or only those within reach for Euclidean
  /// points with a threshold. @throws Error (bad_data) as PointMetric; Error (usage) on a NaN or
  /// negative threshold; Error (usage, bad_data) as RipsVertices; Error (resource) if the context's
  /// memory limit would be exceeded; with a device other than the CPU Error (usage) if it cannot do
  /// what is asked for, Error (not_built_in) also if there is none, Error (resource) if its memory
  /// is too small.
  explicit Rips(PointsView points, const RipsOptions& options = {},
                const RunContext& context = default_context());
  explicit Rips(const DistanceMatrix& distances, const RipsOptions& options = {},
                const RunContext& context = default_context());
  explicit Rips(const SparseDistances& distances, const RipsOptions& options = {},
                const RunContext& context = default_context());
  /// Any metric of the user's own: `size()` and `operator()(Index, Index)`. Read here, not later.
  template <Metric M>
  explicit Rips(const M& metric, const RipsOptions& options = {},
                const RunContext& context = default_context())
      : Rips(AnyMetric(metric), options, context) {}
  explicit Rips(const AnyMetric& metric, const RipsOptions& options = {},
                const RunContext& context = default_context());

  /// The flag complex of any graph.
  explicit Rips(RipsGraph&& graph);

  Index size() const;  ///< vertices
  /// The largest distance at which two points are joined: the given one or the enclosing radius.
  double threshold() const;
  std::size_t edge_count() const;
  /// As asked for in RipsOptions.
  bool has_only_components() const;
  bool has_only_points() const;

  // With ph/custom.hpp: what engines see.

  const RipsGraph& graph() const { return *graph_; }
  /// Calls `use(filtration)` with the representation whose cells are small enough for homology up
  /// to `max_dim`. @throws Error (resource) if simplices of dimension max_dim + 1 have too many
  /// vertices for any representation.
  template <class Use>
  decltype(auto) with_filtration(int max_dim, Use&& use) const {
    return with_rips_filtration(graph(), max_dim, std::forward<Use>(use));
  }

 private:
  std::shared_ptr<const RipsGraph> graph_;
};

}  // namespace ph
