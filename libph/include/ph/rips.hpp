// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ph/detail/core/engine.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/rips/vertex_weights.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The edges under a Vietoris-Rips filtration; see ph/custom.hpp.
class RipsGraph;

/// Which Vietoris-Rips filtration is meant. How it is held while its homology is computed is
/// planned: see RipsForm.
struct RipsOptions {
  /// Largest distance at which two points are joined, inclusive. Default: the enclosing radius
  /// min_i max_j d(i,j) if all distances are known (beyond it nothing but one component is left,
  /// so the barcode is complete), no limit for sparse distances.
  std::optional<double> threshold = std::nullopt;
  PointDistance distance = PointDistance::euclidean;  ///< for points
  double minkowski_p = 2;                             ///< exponent of PointDistance::minkowski
  /// The points that are vertices, ascending and named as in the input; empty: all. The filtration
  /// is that of these points alone.
  std::vector<std::uint32_t> vertices = {};
  /// The diameter at which each point enters, by point of the input: finite, >= 0; default: 0, or
  /// the births of a DistanceMatrix that has some. An edge enters when the balls of its ends meet,
  /// see VertexWeights. A point born after the threshold is left out.
  std::vector<double> births = {};
  /// K: each point is born at twice its distance to the measure of its K nearest points, itself
  /// included (the DTM filtration of Anai et al., see ph/distance_to_measure.hpp). From 1 to the
  /// number of points; needs all distances, and takes the place of `births`.
  std::optional<Index> dtm_neighbours = std::nullopt;
  /// How balls grow from a birth on; default: WeightExponent::one with dtm_neighbours, else
  /// WeightExponent::infinity.
  std::optional<WeightExponent> weight_exponent = std::nullopt;
  /// Farthest-point sampling chooses the vertices, in the place of `vertices`: see
  /// greedy_permutation. Needs all distances.
  std::optional<GreedyLimits> subsample = std::nullopt;
  /// Epsilon > 0: the sparse Rips filtration in its place, with fewer edges and bars that are born
  /// and die later by a factor of 1 + epsilon at most, see SparseRips. Needs all distances, the
  /// triangle inequality and no births. The default threshold is where one component is left.
  std::optional<double> approximation = std::nullopt;
  /// True: equal points become one vertex, named by the first of them, unless they have births.
  /// All bars of positive length stay the same; the bars of length zero that copies cause are left
  /// out. Cycles stay cycles of all points; cocycles are those of the distinct points. False: each
  /// point is a vertex. Default: points are merged where that changes nothing that is asked for.
  std::optional<bool> merge_equal_points = std::nullopt;
  /// Device::gpu: the spanning forest of H0 is found there, the same one, edge for edge. For
  /// Euclidean points without births, whose largest coordinate is 0 or of a size from 1e-140 to
  /// 1e150.
  Device device = Device::cpu;
};

/// What an engine sees of a Rips filtration before any form of it is made.
struct RipsInput {
  Index size;                        ///< at most so many points become vertices
  std::optional<PointsView> points;  ///< none: it is a filtration of distances
  const RipsOptions& options;
};

/// What a sample of pairs of points says of the edges of a Rips filtration.
struct RipsSample {
  Index vertices = 0;             ///< at most so many, equal points counted one by one
  double pairs = 0;               ///< of these vertices, or those whose distance is known
  double edges = 0;               ///< about so many pairs are within the threshold
  std::vector<double> distances;  ///< of pairs taken at random, ascending
};

/// The Vietoris-Rips filtration of a finite set with distances: a simplex enters at its diameter,
/// the largest distance between two of its vertices. Vertices enter at 0. Vertex i is point i,
/// unless some points are no vertices or equal points are merged. Weighted Rips filtrations have
/// births of vertices and edges at which balls meet in the place of 0 and distances.
///
/// It is a question: the constructor looks at options and coordinates and makes no edge. Forms are
/// made when a computation needs them, each one once. A value: copies are cheap and share all that
/// is made; const members may be called by several threads.
///
/// The context of the constructor counts the memory of the forms, and of points that were copied or
/// moved in; it outlives all copies. The context of a call bounds, watches and stops what that call
/// makes.
class Rips {
 public:
  /// @param points one point a row; moved in, or copied: n * d numbers.
  /// @throws Error (bad_data) as PointMetric; Error (usage) on a NaN or negative threshold, an
  /// epsilon that is not above 0, or births with an approximation; Error (usage, bad_data) as
  /// RipsVertices; Error (resource) if the context's memory limit would be exceeded.
  explicit Rips(Points points, RipsOptions options = {},
                const RunContext& context = default_context());
  explicit Rips(PointsView points, RipsOptions options = {},
                const RunContext& context = default_context());
  /// The numbers are shared, not copied, here and with SparseDistances.
  explicit Rips(DistanceMatrix distances, RipsOptions options = {},
                const RunContext& context = default_context());
  /// @throws Error (usage) also on options that need all distances.
  explicit Rips(SparseDistances distances, RipsOptions options = {},
                const RunContext& context = default_context());
  /// Any metric of the user's own: `size()` and `operator()(Index, Index)`. A copy of the object is
  /// kept; what it refers to has to live as long. A NaN or negative distance is an error once a
  /// form is made.
  template <Metric M>
  explicit Rips(M metric, RipsOptions options = {}, const RunContext& context = default_context())
      : Rips(std::make_shared<const M>(std::move(metric)), std::move(options), context) {}
  /// The flag complex of any graph, which is the only form that it has.
  explicit Rips(RipsGraph&& graph);
  /// Of points that the caller keeps as they are while there is a copy of the filtration.
  static Rips borrowed(PointsView points, RipsOptions options = {},
                       const RunContext& context = default_context());

  /// Another question about the same data, which are shared. @throws as the constructor; Error
  /// (usage) if the data are not there any more.
  Rips with(RipsOptions options, const RunContext& context = default_context()) const;

  Index size() const;  ///< points of the input, or vertices of the graph that was given
  const RipsOptions& options() const;
  std::optional<PointsView> points() const;  ///< none: it is of distances or of a graph
  bool has_input() const;                    ///< points or distances that were not given back
  bool has_births() const;                   ///< vertices enter at births of their own
  /// Each point is at most so far from a vertex that the subsample has chosen; nothing if there is
  /// no subsample. Chooses them if need be. @throws Error (resource, cancelled).
  std::optional<double> covering_radius(const RunContext& context = default_context()) const;

  /// True if a form can be made of the input, was made, or is the graph that was given.
  bool has_form(RipsForm form) const;
  /// The graph of a form, made if need be; lives as long as a copy of the filtration does. `edges`
  /// evaluates O(n^2) distances, or the distances within reach for Euclidean points with a
  /// threshold.
  /// @throws Error (usage) if it does not have that form, or the input was forgotten before the
  /// form was made; Error (bad_data) on a distance that is negative or NaN; Error (resource,
  /// cancelled); for the forest of another device Error (usage) if that cannot do what is asked
  /// for, Error (not_built_in) also if there is none, Error (resource) if its memory is too small.
  const RipsGraph& graph(RipsForm form, const RunContext& context = default_context()) const;

  /// Evaluates some 20 000 distances, and without a threshold all distances of 32 points.
  /// @throws Error (usage) if there is no input any more; Error (bad_data) as a metric.
  RipsSample sample(const RunContext& context = default_context()) const;

  /// Gives the input back: only what was made is left, of this and of all copies. No other thread
  /// uses one of them at the time.
  void forget_input();
  /// True if nobody else holds the filtration or its input.
  bool is_only_copy() const;

 private:
  struct State;
  explicit Rips(std::shared_ptr<State> state) : state_(std::move(state)) {}
  Rips(std::shared_ptr<const void> owner, const AnyMetric& metric, RipsOptions options,
       const RunContext& context);
  template <Metric M>
  Rips(const std::shared_ptr<const M>& metric, RipsOptions options, const RunContext& context)
      : Rips(metric, AnyMetric(*metric), std::move(options), context) {}

  std::shared_ptr<State> state_;
};

}  // namespace ph
