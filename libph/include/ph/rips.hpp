// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ph/detail/core/engine.hpp"
#include "ph/detail/core/members.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/rips/vertex_weights.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// The graph of the edges of a Vietoris-Rips filtration; see ph/custom.hpp.
class RipsGraph;

/// Options that define a Vietoris-Rips filtration. They do not decide in which form the filtration
/// is stored while its homology is computed: see RipsForm.
struct RipsOptions {
  /// Largest distance at which two points are joined, inclusive. If all distances are known, the
  /// default is the enclosing radius min_i max_j d(i,j). From this value on, the complex is a cone:
  /// only one component is left, and no other class. The barcode is therefore complete. For sparse
  /// distances there is no limit by default.
  std::optional<double> threshold = std::nullopt;
  PointDistance distance = PointDistance::euclidean;  ///< for points
  double minkowski_p = 2;                             ///< exponent of PointDistance::minkowski
  /// The points that are vertices, ascending, numbered as in the input; if empty, all points are.
  /// The filtration is the filtration of these points alone.
  std::vector<std::uint32_t> vertices = {};
  /// The diameter at which each point enters, one per point of the input: finite, >= 0; default: 0,
  /// or the births of a DistanceMatrix that has some. An edge enters when the balls around its two
  /// ends meet (see VertexWeights). A point born after the threshold is left out.
  std::vector<double> births = {};
  /// K: each point is born at twice its distance to the measure of its K nearest points, which
  /// include the point itself (the DTM filtration of Anai et al., see ph/distance_to_measure.hpp).
  /// K is from 1 to the number of points; this option requires all distances and replaces `births`.
  std::optional<Index> dtm_neighbours = std::nullopt;
  /// K: each point is born at its core distance, the distance to its K-th nearest other point. The
  /// values of edges are then the mutual reachability distances of HDBSCAN*, see
  /// ph/distance_to_measure.hpp. K is less than the number of points; this option requires all
  /// distances and replaces `births`; it excludes `dtm_neighbours`.
  std::optional<Index> core_neighbours = std::nullopt;
  /// The law by which balls grow after their births; default: WeightExponent::one with
  /// dtm_neighbours, otherwise WeightExponent::infinity.
  std::optional<WeightExponent> weight_exponent = std::nullopt;
  /// Farthest-point sampling chooses the vertices, instead of `vertices`: see greedy_permutation.
  /// This option requires all distances.
  std::optional<GreedyLimits> subsample = std::nullopt;
  /// Epsilon > 0 selects the sparse Rips filtration instead: it has fewer edges, and its bars are
  /// born and die later by a factor of at most 1 + epsilon, see SparseRips. It needs all distances
  /// and the triangle inequality, and allows no births. Its default threshold is the least value at
  /// which only one component is left.
  std::optional<double> approximation = std::nullopt;
  /// True: equal points become one vertex, named by the first of them, unless they have births. All
  /// bars of positive length stay the same; bars of length zero that copies cause are left out.
  /// Cycles are cycles in the complex of all points; cocycles are cocycles only in the complex of
  /// the distinct points. False: each point is a vertex. Default: points are merged if that does
  /// not change the result.
  std::optional<bool> merge_equal_points = std::nullopt;
  /// With Device::gpu, the GPU finds the spanning forest of H0, which is the same forest as on the
  /// CPU, edge by edge. Only for Euclidean points without births whose largest coordinate is 0 or
  /// between 1e-140 and 1e150.
  Device device = Device::cpu;

  /// True if the births are computed from the distances.
  bool computes_births() const { return dtm_neighbours || core_neighbours; }
};

template <>
inline constexpr std::tuple members_of<RipsOptions>{
    Member{"threshold", &RipsOptions::threshold},
    Member{"dtm_neighbours", &RipsOptions::dtm_neighbours},
    Member{"core_neighbours", &RipsOptions::core_neighbours},
    Member{"weight_exponent", &RipsOptions::weight_exponent},
    Member{"approximation", &RipsOptions::approximation},
    Member{"merge_equal_points", &RipsOptions::merge_equal_points},
    Member{"device", &RipsOptions::device},
};

/// The facts about a Rips filtration that an engine can use before any form of it is made.
struct RipsInput {
  Index size;                        ///< the largest possible number of vertices
  std::optional<PointsView> points;  ///< empty for a filtration of distances
  const RipsOptions& options;
};

/// An estimate of the edges of a Rips filtration from a sample of pairs of points. Births are
/// ignored.
struct RipsSample {
  Index vertices = 0;  ///< an upper bound; equal points are counted separately
  double pairs = 0;    ///< pairs of these vertices, or pairs whose distance is known
  double edges = 0;    ///< approximate number of pairs within the threshold
  /// Ascending: the distances of pairs drawn at random, or all distances of a SparseDistances.
  std::vector<double> distances;
};

/// The Vietoris-Rips filtration of a finite set with distances: a simplex enters at its diameter,
/// the largest distance between two of its vertices. Vertices enter at 0. Vertex i is point i,
/// unless some points are left out or equal points are merged. In weighted Rips filtrations,
/// vertices enter at their births instead of 0, and edges enter when balls meet instead of at their
/// length.
///
/// An object defines a filtration: the constructor checks options and coordinates and makes no
/// edges. Forms are made when a computation needs them, each form once. A Rips object is a value:
/// copies are cheap and share everything that is made; several threads may call const members.
///
/// The context of the constructor counts the memory of the forms and of points that were copied or
/// moved in; it must outlive all copies. The context of a call limits the work of that call,
/// receives its progress and can stop it.
class Rips {
 public:
  /// @param points one point per row, moved in or copied (n * d numbers).
  /// @throws Error (bad_data) as PointMetric; Error (usage) on a NaN or negative threshold, an
  /// epsilon that is not above 0, or births with an approximation; Error (usage, bad_data) as
  /// RipsVertices; Error (resource) if the context's memory limit would be exceeded.
  explicit Rips(Points points, RipsOptions options = {},
                const RunContext& context = default_context());
  explicit Rips(PointsView points, RipsOptions options = {},
                const RunContext& context = default_context());
  /// Shares the numbers without a copy, as does the constructor from SparseDistances.
  explicit Rips(DistanceMatrix distances, RipsOptions options = {},
                const RunContext& context = default_context());
  /// @throws Error (usage) also on options that require all distances.
  explicit Rips(SparseDistances distances, RipsOptions options = {},
                const RunContext& context = default_context());
  /// Any user-defined metric: an object with `size()` and `operator()(Index, Index)`. A copy of the
  /// object is kept; data that it refers to must live as long. A NaN or negative distance is an
  /// error once a form is made.
  template <Metric M>
  explicit Rips(M metric, RipsOptions options = {}, const RunContext& context = default_context())
      : Rips(std::make_shared<const M>(std::move(metric)), std::move(options), context) {}
  /// The flag complex of any graph, which is its only form.
  explicit Rips(RipsGraph&& graph);
  /// The filtration of points that are not copied: the caller keeps them unchanged as long as there
  /// is a copy of the filtration.
  static Rips borrowed(PointsView points, RipsOptions options = {},
                       const RunContext& context = default_context());

  /// Another filtration of the same data, which are shared. @throws as the constructor; Error
  /// (usage) if the data were freed.
  Rips with(RipsOptions options, const RunContext& context = default_context()) const;

  Index size() const;  ///< number of points of the input, or of vertices of the given graph
  const RipsOptions& options() const;
  std::optional<PointsView> points() const;  ///< empty if it was made from distances or a graph
  /// The number of coordinates of each point, and the kind of distance as in BarcodeInfo::metric.
  /// Both stay known after the input is freed. @return no coordinates for distances or a graph.
  std::optional<Index> coordinates() const;
  std::string metric() const;
  /// True if it holds points or distances that were not freed.
  bool has_input() const;
  bool has_births() const;  ///< true if vertices enter at births of their own
  /// The largest distance from a point to the nearest vertex that the subsample chose; empty if
  /// there is no subsample. Chooses the vertices if necessary. @throws Error (resource, cancelled).
  std::optional<double> covering_radius(const RunContext& context = default_context()) const;

  /// True if a form can be made from the input, was made, or is the given graph.
  bool has_form(RipsForm form) const;
  /// The graph of a form, made if necessary; it lives as long as a copy of the filtration. The form
  /// `edges` evaluates O(n^2) distances. For Euclidean points of at most 32 coordinates with a
  /// threshold, a search for near points rules out most larger distances.
  /// @throws Error (usage) if it does not have that form, or if the input was freed before the form
  /// was made; Error (bad_data) on a distance that is negative or NaN; Error (resource, cancelled).
  /// For a forest on another device also: Error (usage) if that device cannot do the task, Error
  /// (not_built_in) if there is no such device, Error (resource) if its memory is too small.
  const RipsGraph& graph(RipsForm form, const RunContext& context = default_context()) const;

  /// Estimates the edges: evaluates about 20 000 distances and, without a threshold, up to all
  /// distances of 32 points. The edges of sparse distances are counted instead.
  /// @throws Error (usage) if the input was freed; Error (bad_data) on a distance that is negative
  ///        or NaN.
  RipsSample sample(const RunContext& context = default_context()) const;

  /// Frees the input, for this object and all copies: only the forms that were made are left.
  /// Meanwhile, no other thread may use any of the copies.
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
