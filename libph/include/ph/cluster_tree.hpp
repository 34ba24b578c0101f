// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

class Rips;
struct FlagEdge;
struct MergeTree;
struct WeightedEdge;

/// The measure of the life of a cluster: a function of the value that falls as the value grows. It
/// is 0 at the end of the filtration, and the same for a value of infinity.
enum class ClusterScale {
  inverse,      ///< 1 / value, the density of HDBSCAN*; for values >= 0
  linear,       ///< the largest finite value of an edge minus the value: persistence
  logarithmic,  ///< the logarithm of the quotient of these two; for values >= 0
};

template <>
inline constexpr std::array names_of<ClusterScale>{
    Named{ClusterScale::inverse, "inverse"},
    Named{ClusterScale::linear, "linear"},
    Named{ClusterScale::logarithmic, "log"},
};

enum class ClusterMethod {
  eom,   ///< the clusters with the largest total stability, none of them inside another
  leaf,  ///< the clusters without clusters inside them
};

template <>
inline constexpr std::array names_of<ClusterMethod>{
    Named{ClusterMethod::eom, "eom"},
    Named{ClusterMethod::leaf, "leaf"},
};

/// The choice of clusters from a ClusterTree.
struct ClusterOptions {
  ClusterMethod method = ClusterMethod::eom;
  /// A chosen cluster that joins others at a value below `epsilon` is replaced by the first cluster
  /// around it that does not (Malzer, Baum, A hybrid approach to hierarchical density-based cluster
  /// selection, 2020).
  double epsilon = 0;
  /// True: the root may be chosen. Its points are then those that leave it at a value <= its
  /// bottom, or <= epsilon if epsilon > 0.
  bool allow_single = false;
  /// ClusterMethod::eom chooses no cluster with more points; 0: any. It is not applied to the
  /// clusters that `epsilon` chooses.
  Index max_size = 0;
};

/// The place of a new point in a hierarchy: the point that it joins first.
struct Attachment {
  Index point = -1;          ///< a point of the hierarchy; -1 if there is none
  double value = kInfinity;  ///< the value of the edge
};

/// A partition of the points into clusters and noise.
struct Clusters {
  /// The cluster of each point, 0, 1, … in the order of the first point of each cluster; -1 is
  /// noise.
  std::vector<Index> labels;
  /// For each point, the time until it leaves its cluster as a share of the time until the cluster
  /// splits or ends, at most 1, on the scale of the tree: for ClusterScale::inverse, bottom /
  /// value, where `value` is the value at which the point leaves. 0 for noise.
  std::vector<double> probabilities;
  /// By label: the position of the cluster in ClusterTree::clusters.
  std::vector<std::uint32_t> chosen;
};

/// The clusters of a hierarchy of components that have at least `min_size` points: the condensed
/// tree of HDBSCAN* (Campello, Moulavi, Sander, Density-based clustering based on hierarchical
/// density estimates, 2013).
///
/// Consider the components of sublevel sets as the value falls. When a component breaks, by the
/// removal of all edges of one value at once, its parts with at least `min_size` points are real.
/// If there are several real parts, they are new clusters. If there is one, the cluster goes on as
/// that part. If there is none, the cluster ends. The points of all other parts leave the cluster
/// at that value. Components that no edge joins are joined at infinity.
///
/// Because equal values are treated at once, the tree is a function of the distances: it does not
/// depend on the order of the points. Stabilities are the same to the last bit.
///
/// A ClusterTree is a value; copies share their data.
class ClusterTree {
 public:
  struct Cluster {
    std::int64_t parent = -1;  ///< the cluster that it splits from; -1: it is the root
    double top = kInfinity;    ///< value at which it joins other clusters; infinity for the root
    /// Value at which it splits; for a cluster without children, the least value at which it has
    /// `min_size` points.
    double bottom = 0;
    double least = 0;  ///< the least bottom of the cluster and all clusters inside it
    Index size = 0;    ///< number of points just below `top`
    /// Stability, also called excess of mass: the sum over the points of the lengths of time that
    /// they spend in the cluster itself, on the scale of the tree.
    double mass = 0;
  };

  /// The clusters of a Rips filtration. If its births are core distances, this is HDBSCAN*. Makes
  /// the form RipsForm::forest of the filtration, and then takes O(n) time after a sort.
  /// @param min_size at least 2.
  /// @throws Error (usage) on another min_size, if not all points are vertices, or on negative
  /// values with a scale that needs values >= 0; Error (resource, cancelled) and errors of
  /// Rips::graph.
  ClusterTree(const Rips& rips, Index min_size, const RunContext& context = default_context());
  /// The clusters of any merge tree: of an image, a graph or points. A vertex that never enters is
  /// noise.
  ClusterTree(const MergeTree& tree, Index min_size, ClusterScale scale = ClusterScale::inverse,
              const RunContext& context = default_context());

  /// The clusters of a graph, for example of a spanning forest that was stored.
  /// @param edges in any order. @throws Error (usage) also on an edge whose ends are not points, or
  /// whose value is NaN.
  ClusterTree(Index points, std::span<const WeightedEdge> edges, Index min_size,
              ClusterScale scale = ClusterScale::inverse,
              const RunContext& context = default_context());

  /// The same tree with another least size, in time O(n) and without the edges.
  /// @throws Error (usage) if `min_size` is less than the size with which the first tree was made.
  ClusterTree with_min_size(Index min_size, const RunContext& context = default_context()) const;

  Index size() const;  ///< number of points
  Index min_size() const;
  ClusterScale scale() const;
  /// Children come before their parents, and the root is the last one. Empty if there are no
  /// points.
  std::span<const Cluster> clusters() const;
  /// For each point, the cluster that it leaves, and the value at which it leaves.
  std::span<const std::uint32_t> cluster_of() const;
  std::span<const double> leaves_at() const;

  /// Chooses clusters. O(n). @throws Error (usage) if epsilon is negative or NaN, or max_size is
  /// negative.
  Clusters select(const ClusterOptions& options = {}) const;
  /// The clusters of points that are added to those that `select` chooses. A point that joins the
  /// hierarchy stays with the point that it joins; the clusters do not change. A point without an
  /// edge is noise.
  /// @return labels and probabilities of the added points; `chosen` is as in `select`.
  /// @throws Error (usage) as `select`, and on a point that the tree does not have.
  Clusters locate(std::span<const Attachment> added, const ClusterOptions& options = {}) const;
  /// GLOSH, for each point (Campello, Moulavi, Zimek, Sander, Hierarchical density estimates for
  /// data clustering, visualization, and outlier detection, 2015): 1 minus the quotient of the life
  /// of the point and the life of the last point of the cluster that it leaves, from 0 to 1.
  std::vector<double> outlier_scores() const;

 private:
  struct Data;
  class Growth;
  class Condenser;
  class Recutter;
  /// @param edges ascending.
  static std::shared_ptr<const Data> condensed(std::span<const FlagEdge> edges, Index points,
                                               Index min_size, ClusterScale scale,
                                               const RunContext& context);
  ClusterTree(std::shared_ptr<const Data> data, std::shared_ptr<const Data> finest)
      : data_(std::move(data)), finest_(std::move(finest)) {}

  std::shared_ptr<const Data> data_;
  std::shared_ptr<const Data> finest_;  // the tree with the least size, from which others are made
};

/// For each added point, the first edge to a point of a hierarchy of points with births.
/// @param points the points of the hierarchy, one per row. @param births one per point.
/// @param added_births one per added point: for HDBSCAN*, its core_distances_among the points.
/// @param p exponent of PointDistance::minkowski.
/// @throws Error (usage) if rows have different numbers of coordinates, or births are missing;
/// Error (bad_data) as PointMetric.
std::vector<Attachment> attachments(PointsView points, std::span<const double> births,
                                    PointsView added, std::span<const double> added_births,
                                    PointDistance distance = PointDistance::euclidean, double p = 2,
                                    const RunContext& context = default_context());

/// For each added point, the distance to the point of rank `neighbours` + 1 among `points`. A copy
/// of one of the points therefore has the core distance of this point. Infinite if there are fewer
/// points.
std::vector<double> core_distances_among(PointsView points, PointsView added, Index neighbours,
                                         PointDistance distance = PointDistance::euclidean,
                                         double p = 2,
                                         const RunContext& context = default_context());

}  // namespace ph
