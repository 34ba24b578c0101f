// SPDX-License-Identifier: MIT
#include "ph/detail/metric/spanning_forest.hpp"

#include <array>
#include <atomic>
#include <optional>

#include "libph/src/metric/distinct_points.hpp"
#include "libph/src/metric/known_neighbours.hpp"
#include "libph/src/metric/neighbour_search.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

/// True if boxes rule out few points (measured).
bool has_many_axes(PointsView points) { return points.cols() > 8; }

// Runs Borůvka's algorithm. In each round, every component takes its first edge to another
// component, in the order of the filtration. A point of another component is called foreign. Rounds
// are cheap because the distance from a point to its nearest foreign point never decreases. Each
// point stores a few nearest neighbours, which are found once. The first foreign point among them
// is its nearest foreign point. If none of them is foreign, the last of them gives a lower bound.
// The tree is searched only if this bound does not exceed the best edge that the component already
// has. If boxes rule out few points, all pairs of points of the last components are compared at
// once instead.
class Boruvka {
 public:
  /// @param search a search with these births; null if there are none.
  Boruvka(const KdTree& tree, const NeighbourSearch& search, const PointBirths* births,
          KnownNeighbours known, double limit, const RunContext& context)
      : tree_(tree),
        search_(search),
        births_(births),
        limit_(limit),
        context_(context),
        components_(tree.size()),
        known_(std::move(known)),
        points_(tree.size(), &context.memory),
        component_(tree.size(), &context.memory),
        node_component_(tree.node_count(), Parts::kMixed, &context.memory),
        sets_(tree.size(), &context.memory),
        best_(tree.size(), kNone, &context.memory),
        reach_(tree.size(), &context.memory),
        asking_(&context.memory) {
    std::iota(component_.begin(), component_.end(), 0U);
  }

  /// Appends the edges of the forest. The ends of an edge are row numbers of points.
  void run(FlagEdges& forest) {
    take_first_neighbours();
    while (true) {
      propose();
      ask();
      if (!join(forest)) return;
      if (has_many_axes(tree_.points()) && components_ <= kFewComponents) return join_all(forest);
    }
  }

 private:
  static constexpr std::size_t kKnown = KnownNeighbours::kCount;
  using Parts = NeighbourSearch::Parts;
  using Neighbour = NeighbourSearch::Neighbour;
  using Position = NeighbourSearch::Position;
  static constexpr Position kNone = NeighbourSearch::kNone;
  static constexpr std::size_t kPiece = 1 << 12;
  // There is one edge for each pair of this many components.
  static constexpr std::size_t kFewComponents = 512;

  enum class Knows : std::uint8_t {
    nearest,      // `first` is the nearest foreign point
    lower_bound,  // the nearest foreign point comes after `first`; if `first` is only a distance,
                  // it comes after all points at this distance
  };
  struct Point {
    Neighbour first;
    // The position of `first` among the known neighbours, or kKnown if the search in the tree found
    // it.
    std::uint8_t place = 0;
    Knows knows = Knows::lower_bound;
  };

  FlagEdge edge_of(Position p) const {
    const Neighbour& q = points_[p].first;
    const auto [v, u] = std::minmax(tree_.rows()[p], tree_.rows()[q.position]);
    return {q.distance, u, v};
  }
  /// True if the edge of p comes before the edge of q.
  bool precedes(Position p, Position q) const {
    const double of_p = points_[p].first.distance, of_q = points_[q].first.distance;
    return of_p != of_q ? of_p < of_q : ph::precedes(edge_of(p), edge_of(q));
  }

  void take_first_neighbours() {
    for (Position p = 0; p < points_.size(); ++p) {
      const Position q = known_.positions[p * kKnown];
      if (q == kNone)
        points_[p].first = {bound(p), kNone};
      else
        points_[p] = {{search_.distance(p, q), q}, 0, Knows::nearest};
    }
  }
  /// The least value of an edge of p to a point that is not known.
  double bound(Position p) const {
    return known_.others_after.empty() ? limit_ : known_.others_after[p];
  }

  /// Finds each component's best edge among the edges that its points know.
  void propose() {
    for_each_piece("spanning forest", points_.size(), kPiece, context_,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t p = begin; p < end; ++p) advance(static_cast<Position>(p));
                   });
    std::fill(best_.begin(), best_.end(), kNone);
    for (Position p = 0; p < points_.size(); ++p) offer(p);
  }
  /// Makes `first` of point p the first known neighbour that is foreign.
  void advance(Position p) {
    Point& point = points_[p];
    const std::uint32_t own = component_[p];
    if (point.knows == Knows::lower_bound || component_[point.first.position] != own) return;
    Position last = point.first.position;
    if (point.place < kKnown) ++point.place;
    for (; point.place < kKnown; ++point.place) {
      const Position q = known_.positions[p * kKnown + point.place];
      if (q == kNone) {
        point.first = {bound(p), kNone};
        point.knows = Knows::lower_bound;
        return;
      }
      last = q;
      if (component_[q] != own) break;
    }
    if (last != point.first.position) point.first = {search_.distance(p, last), last};
    if (point.place == kKnown) point.knows = Knows::lower_bound;  // mutant: forest-known
  }
  void offer(Position p) {
    if (points_[p].knows == Knows::lower_bound) return;
    Position& best = best_[component_[p]];
    if (best == kNone || precedes(p, best)) best = p;
  }

  /// Searches the tree, but only for points that may have a better edge than the best edge that
  /// their component knows.
  void ask() {
    for (Position c = 0; c < points_.size(); ++c)
      if (component_[c] == c)
        reach_[c] = best_[c] == kNone ? limit_ : points_[best_[c]].first.distance;
    // Points that follow each other in the tree are near each other, so their distances give a
    // first bound.
    for (Position p = 1; p < points_.size(); ++p) {
      const std::uint32_t a = component_[p - 1], b = component_[p];
      if (a == b || (best_[a] != kNone && best_[b] != kNone)) continue;
      const double d = search_.distance(p - 1, p);
      reach_[a] = std::min<double>(reach_[a], d);
      reach_[b] = std::min<double>(reach_[b], d);
    }
    asking_.clear();
    for (Position p = 0; p < points_.size(); ++p)
      if (is_worth_asking(p)) asking_.push_back(p);
    const auto ask_tree = [&](std::size_t begin, std::size_t end) {
      while (begin < end) {
        const KdTree::Node leaf = tree_.leaf_of(asking_[begin]);
        std::size_t next = begin + 1;
        while (next < end && asking_[next] < tree_.end(leaf)) ++next;
        ask_for(leaf, std::span(asking_).subspan(begin, next - begin));
        begin = next;
      }
    };
    for_each_piece("spanning forest", asking_.size(), 256, context_, ask_tree);
    for (const Position p : asking_) offer(p);
  }
  /// Searches the tree for points of one leaf.
  void ask_for(KdTree::Node leaf, std::span<const Position> points) {
    const Parts parts{component_, node_component_};
    NeighbourSearch::Query query{.leaf = leaf, .parts = &parts};
    query.limits.fill(-1);
    const auto reach_of = [&](Position p) -> std::atomic<double>& { return reach_[component_[p]]; };
    for (const Position p : points) {
      const double within = reach_of(p).load(std::memory_order_relaxed);
      if (least_distance(p) <= within) query.limits[p - tree_.begin(leaf)] = within;
    }
    std::array<Neighbour, KdTree::kLeafSize> all;
    search_.nearest(query, all);
    for (const Position p : points) {
      if (query.limits[p - tree_.begin(leaf)] < 0) continue;
      const Neighbour& found = all[p - tree_.begin(leaf)];
      const bool is_none = found.position == kNone;
      points_[p] = {found, kKnown, is_none ? Knows::lower_bound : Knows::nearest};
      double within = reach_of(p).load(std::memory_order_relaxed);
      while (found.distance < within && !reach_of(p).compare_exchange_weak(
                                            within, found.distance, std::memory_order_relaxed)) {
      }
    }
  }
  double birth(Position p) const { return births_ ? births_->of_point(p) : 0; }
  /// No foreign point is nearer to p.
  double least_distance(Position p) const { return std::max(points_[p].first.distance, birth(p)); }
  bool is_worth_asking(Position p) const {
    if (points_[p].knows == Knows::nearest) return false;
    const auto& [distance, position] = points_[p].first;
    const double reach = reach_[component_[p]].load(std::memory_order_relaxed);
    if (birth(p) > reach) return false;  // mutant: forest-birth
    if (position == kNone || distance != reach) return distance < reach;
    const Position best = best_[component_[p]];
    return best == kNone || precedes(p, best);  // mutant: forest-bound-tie
  }

  /// Adds the best edge of each component to the forest. @return true if there are still components
  /// that may join.
  bool join(FlagEdges& forest) {
    const std::size_t before = components_;
    for (Position c = 0; c < best_.size(); ++c) {
      if (best_[c] == kNone) continue;
      const std::uint32_t a = sets_.find(c),
                          b = sets_.find(component_[points_[best_[c]].first.position]);
      if (a == b) continue;  // the other component also took this edge
      sets_.link(a, b);
      --components_;
      forest.push_back(edge_of(best_[c]));
    }
    if (components_ == before || components_ == 1) return false;
    for (Position p = 0; p < component_.size(); ++p) component_[p] = sets_.find(p);
    Parts::find_nodes(tree_, component_, node_component_);
    return true;
  }

  /// Kruskal's algorithm with the first edge between each pair of components.
  void join_all(FlagEdges& forest) {
    std::pmr::vector<std::uint32_t> part(component_.size(), &context_.memory);
    std::uint32_t parts = 0;
    for (Position p = 0; p < part.size(); ++p)  // numbers the roots
      if (component_[p] == p) part[p] = parts++;
    const std::pmr::vector<std::uint32_t> of_root(part, &context_.memory);
    for (Position p = 0; p < part.size(); ++p) part[p] = of_root[component_[p]];
    Parts::find_nodes(tree_, part, node_component_);
    FirstEdges first(parts, limit_, context_);
    search_.first_between_parts({part, node_component_}, first, context_);
    struct Edge : FlagEdge {
      std::uint32_t a, b;  // parts
    };
    std::pmr::vector<Edge> edges(&context_.memory);
    for (std::uint32_t a = 0; a < parts; ++a)
      for (std::uint32_t b = 0; b < a; ++b)
        if (const std::optional<FlagEdge> edge = first.edge(a, b)) edges.push_back({*edge, a, b});
    std::ranges::sort(edges, ph::precedes);
    DisjointSets sets(parts, &context_.memory);
    for (const Edge& e : edges) {
      const std::uint32_t a = sets.find(e.a), b = sets.find(e.b);
      if (a == b) continue;
      sets.link(a, b);
      forest.push_back(e);
    }
  }

  const KdTree& tree_;
  const NeighbourSearch& search_;
  const PointBirths* const births_;
  const double limit_;
  const RunContext& context_;
  std::size_t components_;
  KnownNeighbours known_;
  std::pmr::vector<Point> points_;
  std::pmr::vector<std::uint32_t> component_;       // component of each position: a root of sets_
  std::pmr::vector<std::uint32_t> node_component_;  // component of each node of the tree
  DisjointSets sets_;
  std::pmr::vector<Position> best_;  // for each component, the point with its best edge
  // For each component, an upper bound for the length of its best edge.
  std::pmr::vector<std::atomic<double>> reach_;
  std::pmr::vector<Position> asking_;
};

/// For each point, the first point that equals it and has no birth, if the point has none either;
/// otherwise the point itself.
std::pmr::vector<std::uint32_t> first_copies(PointsView points, std::span<const double> births,
                                             const RunContext& context) {
  std::pmr::vector<std::uint32_t> first = first_equal_points(points, context);
  if (births.empty()) return first;
  std::pmr::vector<std::uint32_t> first_at_zero(first.size(), UINT32_MAX, &context.memory);
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    std::uint32_t& at_zero = first_at_zero[first[i]];
    if (births[i] == 0 && at_zero == UINT32_MAX) at_zero = i;
    first[i] = births[i] == 0 ? at_zero : i;  // mutant: forest-born-copies
  }
  return first;
}

}  // namespace

bool has_fast_spanning_forest(PointsView points, PointDistance distance) {
  constexpr Index most_axes = 128;  // with more, a search saves no time, and it copies the points
  return points.cols() <= most_axes && NeighbourSearch::can_search(distance);
}

FlagEdges spanning_forest(PointsView points, PointDistance distance, double p,
                          std::span<const double> births, double limit, const RunContext& context,
                          double largest) {
  const PointMetric checked(points, distance, p);
  points = checked.points();  // now the rows are contiguous
  FlagEdges forest(&context.memory);
  const std::pmr::vector<std::uint32_t> first = first_copies(points, births, context);
  // Each copy is joined to the first point that equals it. No other edge of a copy comes before the
  // corresponding edge of that first point.
  for (std::uint32_t i = 0; i < first.size(); ++i)
    if (first[i] != i) forest.push_back({0.0, i, first[i]});  // mutant: forest-copies
  const std::pmr::vector<std::uint32_t> distinct = distinct_points(first, context);
  if (distinct.size() > 1) {
    const KdTree tree(points, distinct, context);
    const PointMetric metric(tree.points(), distance, p, largest);
    std::optional<PointBirths> of_tree;
    if (!births.empty()) of_tree.emplace(tree, births, context);
    const PointBirths* const born = of_tree ? &*of_tree : nullptr;
    const auto search = NeighbourSearch::make(tree, metric, distance, p, born, context);
    Boruvka(tree, *search, born, known_neighbours(tree, *search, limit, context), limit, context)
        .run(forest);
  }
  return forest;
}

ForestWithBirths core_forest(PointsView points, Index k, PointDistance distance, double p,
                             double limit, const RunContext& context) {
  const PointMetric checked(points, distance, p);
  points = checked.points();  // now the rows are contiguous
  ForestWithBirths result{FlagEdges(&context.memory),
                          std::pmr::vector<double>(points.rows(), &context.memory)};
  std::pmr::vector<std::uint32_t> rows(result.births.size(), &context.memory);
  std::iota(rows.begin(), rows.end(), 0U);
  std::optional<KdTree> tree(std::in_place, points, rows, context);
  const PointMetric metric(tree->points(), distance, p);
  std::optional<NearestLists> lists(
      std::in_place, *tree, *NeighbourSearch::make(*tree, metric, distance, p, nullptr, context),
      static_cast<std::size_t>(k), result.births, context);
  if (std::ranges::min(result.births) == 0) {  // copies, which are joined at 0
    lists.reset();
    tree.reset();
    result.edges = spanning_forest(points, distance, p, result.births, limit, context);
    return result;
  }
  const PointBirths births(*tree, result.births, context);
  const auto search = NeighbourSearch::make(*tree, metric, distance, p, &births, context);
  KnownNeighbours known = lists->by_value(*search, limit, context);
  lists.reset();
  Boruvka(*tree, *search, &births, std::move(known), limit, context).run(result.edges);
  return result;
}

}  // namespace ph
