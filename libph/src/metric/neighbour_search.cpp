// SPDX-License-Identifier: MIT
#include "libph/src/metric/neighbour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libph/src/metric/leaf_gaps.hpp"
#include "libph/src/metric/plain_squares.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

// The factor that allows for rounding in Gaps::reach.
// mutant: search-slack
double slack(Index axes) { return 1 + 4e-16 * static_cast<double>(axes + 8); }

template <class Gaps, bool kHasBirths>
class Search final : public NeighbourSearch {
 public:
  /// @param is_root_of_sum true if the distance is the square root of the sum of squares.
  Search(const KdTree& tree, const PointMetric& metric, bool is_root_of_sum,
         const PointBirths* births, const RunContext& context)
      : tree_(tree),
        metric_(metric),
        gaps_(tree, context),
        slack_(slack(tree.points().cols())),
        is_root_of_sum_(is_root_of_sum),
        births_(births) {}

  void nearest(const Query& query, std::span<Neighbour> found) const override {
    Asking asking(*this, query, found);
    if (asking.is_nobody()) return;
    if (!asking.is_done_with(query.leaf)) asking.compare_with(query.leaf);
    traverse([&](Node node) { return gaps_.of_boxes(asking.box(), tree_.box(node)); },
             [&](Node node, double gap) {
               return node == query.leaf || gap > asking.farthest() || asking.is_done_with(node);
             },
             [&](Node leaf) { asking.compare_with(leaf); });
  }

  void first_between_parts(const Parts& parts, FirstEdges& first,
                           const RunContext& context) const override {
    // Pairs of subtrees, of which each is compared on one thread.
    const Node roots = std::min<Node>(tree_.first_leaf(), 1 << 7);
    for_each_piece("nearest parts", std::size_t{roots} * roots, 1, context,
                   [&](std::size_t i, std::size_t) {
                     const auto a = static_cast<Node>(roots + i / roots),
                                b = static_cast<Node>(roots + i % roots);
                     if (a <= b) compare_parts(a, b, {parts, first});
                   });
  }

  double distance(Position p, Position q) const override {
    const double *x = tree_.points().row(Index{p}), *y = tree_.points().row(Index{q});
    double norm = 0;
    for (Index k = 0; k < tree_.points().cols(); ++k) Gaps::add(norm, x[k] - y[k]);
    return distance(p, q, norm);
  }

  void pairs_within(double limit, const VisitPair& visit,
                    const RunContext& context) const override {
    Ticker ticker(context, "near pairs", tree_.size());
    visit_pairs(1, 1, {limit, Gaps::reach(limit, slack_), visit, ticker});
  }

 private:
  using Tile = typename LeafGaps<Gaps>::Tile;
  static constexpr double kNothing = -1;  // no gap is so small

  /// The points of a leaf that look for neighbours.
  class Asking {
   public:
    Asking(const Search& search, const Query& query, std::span<Neighbour> found)
        : search_(search),
          query_(query),
          found_(found),
          begin_(search.tree_.begin(query.leaf)),
          end_(search.tree_.end(query.leaf)),
          box_(search.tree_.box(query.leaf)) {
      reach_.fill(kNothing);
      std::size_t count = 0;
      for (Position p = begin_; p < end_; ++p) {
        const double limit = query.limits[p - begin_];
        std::ranges::fill(list_of(p), Neighbour{limit, kNone});
        if (!(limit >= 0)) continue;
        reach_[p - begin_] = Gaps::reach(limit, search.slack_);
        if (query.parts) {
          const std::uint32_t own = query.parts->of_point[p];
          own_ = count == 0 || own == own_ ? own : Parts::kMixed;
        }
        ++count;
      }
      find_farthest();
      if (0 < count && count < end_ - begin_) find_box();
    }
    bool is_nobody() const { return farthest_ == kNothing; }
    const double* box() const { return box_; }
    /// No point looks for neighbours with a larger norm.
    double farthest() const { return farthest_; }
    /// True if no point of a node is wanted.
    bool is_done_with(Node node) const {
      if constexpr (kHasBirths)
        if (search_.births_->least_birth(node) > farthest_distance_) return true;
      return query_.parts && own_ != Parts::kMixed && query_.parts->of_node[node] == own_;
    }
    void compare_with(Node leaf) {
      const Position first = search_.tree_.begin(leaf), last = search_.tree_.end(leaf);
      Tile norms;
      search_.gaps_.of_leaves(query_.leaf, leaf, norms);
      for (Position p = begin_; p < end_; ++p) {
        double& reach = reach_[p - begin_];
        const std::span<Neighbour> list = list_of(p);
        if (reach < 0 || search_.enters_too_late(leaf, p, list.back())) continue;
        const double* const row = &norms[(p - begin_) * KdTree::kLeafSize];
        for (Position q = first; q < last; ++q) {
          const double norm = row[q - first];
          if (norm > reach || !is_wanted(p, q)) continue;
          search_.insert({search_.distance(p, q, norm), q}, list);
          reach = search_.reach_beside(list.back(), query_.ties);
        }
      }
      find_farthest();
    }

   private:
    std::span<Neighbour> list_of(Position p) const {
      return found_.subspan((p - begin_) * query_.k, query_.k);
    }
    bool is_wanted(Position p, Position q) const {
      const Parts* const parts = query_.parts;
      return p != q && !(parts && parts->of_point[p] == parts->of_point[q]);
    }
    void find_farthest() {
      farthest_ = std::ranges::max(reach_);
      if constexpr (kHasBirths) {
        farthest_distance_ = 0;
        for (Position p = begin_; p < end_; ++p)
          farthest_distance_ = std::max(farthest_distance_, list_of(p).back().distance);
      }
    }
    /// Finds the box of the points that ask, if some do not.
    void find_box() {
      const PointsView points = search_.tree_.points();
      for (Position p = begin_; p < end_; ++p) {
        if (reach_[p - begin_] < 0) continue;
        const double* const x = points.row(Index{p});
        const bool is_first = of_some_.empty();
        of_some_.resize(2 * static_cast<std::size_t>(points.cols()));
        for (std::size_t k = 0; k < of_some_.size(); ++k) {
          double& bound = of_some_[k];
          bound = is_first     ? x[k / 2]
                  : k % 2 == 0 ? std::min(bound, x[k / 2])
                               : std::max(bound, x[k / 2]);
        }
      }
      box_ = of_some_.data();
    }

    const Search& search_;
    const Query& query_;
    const std::span<Neighbour> found_;
    const Position begin_, end_;
    std::array<double, KdTree::kLeafSize> reach_;  // by point: no larger norm is wanted
    double farthest_ = kNothing, farthest_distance_ = 0;
    std::uint32_t own_ = Parts::kMixed;  // the part of all points that ask
    const double* box_;
    std::vector<double> of_some_;
  };

  struct PartsToJoin {
    const Parts& parts;
    FirstEdges& first;
  };
  /// Compares the points of `a` with the points of `b`, which does not come before `a`. The nodes
  /// must be on the same level.
  void compare_parts(Node a, Node b, const PartsToJoin& join) const {
    const std::uint32_t of_a = join.parts.of_node[a], of_b = join.parts.of_node[b];
    if (of_a != Parts::kMixed && of_b != Parts::kMixed) {
      if (of_a == of_b) return;
      const double within = join.first.value(of_a, of_b);
      if (gaps_.of_boxes(tree_.box(a), tree_.box(b)) > Gaps::reach(within, slack_)) return;
      if constexpr (kHasBirths)
        if (std::max(births_->least_birth(a), births_->least_birth(b)) > within) return;
    }
    if (tree_.is_leaf(a)) {
      compare_parts_of_leaves(a, b, join);
      return;
    }
    compare_parts(2 * a, 2 * b, join);
    compare_parts(2 * a, 2 * b + 1, join);
    if (a != b) compare_parts(2 * a + 1, 2 * b, join);
    compare_parts(2 * a + 1, 2 * b + 1, join);
  }
  void compare_parts_of_leaves(Node a, Node b, const PartsToJoin& join) const {
    Tile norms;
    gaps_.of_leaves(a, b, norms);
    for (Position p = tree_.begin(a); p < tree_.end(a); ++p) {
      const std::uint32_t own = join.parts.of_point[p];
      for (Position q = tree_.begin(b); q < tree_.end(b); ++q) {
        const std::uint32_t other = join.parts.of_point[q];
        if (own == other) continue;
        const double norm = norms[(p - tree_.begin(a)) * KdTree::kLeafSize + q - tree_.begin(b)];
        if (norm > Gaps::reach(join.first.value(own, other), slack_)) continue;
        const auto [v, u] = std::minmax(tree_.rows()[p], tree_.rows()[q]);
        join.first.offer(own, other, {distance(p, q, norm), u, v});
      }
    }
  }

  struct Pairs {
    double limit, reach;
    const VisitPair& visit;
    Ticker& ticker;
  };
  /// Visits each pair of a point in `a` and a point in `b`. The nodes must be on the same level,
  /// and `b` must not come before `a`.
  void visit_pairs(Node a, Node b, const Pairs& pairs) const {
    if (a != b && gaps_.of_boxes(tree_.box(a), tree_.box(b)) > pairs.reach) return;
    if (tree_.is_leaf(a)) {
      visit_pairs_of_leaves(a, b, pairs);
      return;
    }
    visit_pairs(2 * a, 2 * b, pairs);
    visit_pairs(2 * a, 2 * b + 1, pairs);  // mutant: search-siblings
    if (a != b) visit_pairs(2 * a + 1, 2 * b, pairs);
    visit_pairs(2 * a + 1, 2 * b + 1, pairs);
  }
  void visit_pairs_of_leaves(Node a, Node b, const Pairs& pairs) const {
    const Position last = tree_.end(b);
    Tile norms;
    gaps_.of_leaves(a, b, norms);
    for (Position p = tree_.begin(a); p < tree_.end(a); ++p) {
      for (Position q = a == b ? p + 1 : tree_.begin(b); q < last; ++q) {
        const double norm = norms[(p - tree_.begin(a)) * KdTree::kLeafSize + q - tree_.begin(b)];
        if (norm > pairs.reach) continue;
        const double d = distance(p, q, norm);
        if (d > pairs.limit) continue;  // mutant: search-radius
        const auto [i, j] = std::minmax(tree_.rows()[p], tree_.rows()[q]);
        pairs.visit(Index{i}, Index{j}, d);
      }
    }
    if (a == b)
      pairs.ticker.tick(tree_.end(a) - tree_.begin(a));
    else
      pairs.ticker.work(KdTree::kLeafSize);
  }
  /// @param norm of the gaps between two points. A sum of squares equals the sum that the metric
  /// computes unless digits were lost.
  double distance(Position p, Position q, double norm) const {
    const double length = length_of(p, q, norm);
    if constexpr (kHasBirths) return std::max({length, births_->of_point(p), births_->of_point(q)});
    return length;
  }
  double length_of(Position p, Position q, double norm) const {
    if constexpr (std::same_as<Gaps, EuclideanGaps>)
      if (is_root_of_sum_ && norm >= Gaps::kSmallestPlainSquare) return std::sqrt(norm);
    return metric_(p, q);
  }
  /// True if no point of a node can replace the worst neighbour of p, because the births of the
  /// points or their row numbers are too large. Births are exact, so no slack is needed. Row
  /// numbers must be compared because births make many distances equal: otherwise p would visit all
  /// points at the distance of its own birth.
  bool enters_too_late(Node node, Position p, const Neighbour& worst) const {
    if constexpr (kHasBirths) {
      const double least = std::max(births_->of_point(p), births_->least_birth(node));
      if (least != worst.distance) return least > worst.distance;
      return worst.position != kNone &&
             births_->least_row(node) > tree_.rows()[worst.position];  // mutant: search-birth-tie
    }
    return false;
  }
  /// The largest norm with which a point may still replace the worst neighbour.
  double reach_beside(const Neighbour& worst, Ties ties) const {
    if (ties == Ties::any && worst.distance == 0) return kNothing;  // mutant: search-any-tie
    return Gaps::reach(worst.distance, slack_);
  }
  bool is_nearer(const Neighbour& a, const Neighbour& b) const {
    if (a.distance != b.distance) return a.distance < b.distance;
    // mutant: search-tie
    return b.position == kNone || tree_.rows()[a.position] < tree_.rows()[b.position];
  }
  /// Inserts a neighbour into the sorted list and drops the last one.
  void insert(const Neighbour& neighbour, std::span<Neighbour> list) const {
    if (!is_nearer(neighbour, list.back())) return;
    std::size_t i = list.size() - 1;
    for (; i > 0 && is_nearer(neighbour, list[i - 1]); --i) list[i] = list[i - 1];
    list[i] = neighbour;
  }

  /// Visits the leaves, with the nearer child first. @param gap_to the gap between a node and the
  /// starting point.
  /// @param is_hopeless returns true if a node with that gap can be skipped.
  template <class GapTo, class IsHopeless, class VisitLeaf>
  void traverse(GapTo&& gap_to, IsHopeless&& is_hopeless, VisitLeaf&& visit_leaf) const {
    struct Entry {
      double gap;
      Node node;
    };
    std::array<Entry, 64> stack;  // one per level
    std::size_t height = 0;
    for (Entry at{0, 1};;) {
      if (!is_hopeless(at.node, at.gap)) {
        if (!tree_.is_leaf(at.node)) {
          Entry near{gap_to(2 * at.node), 2 * at.node};
          Entry far{gap_to(2 * at.node + 1), 2 * at.node + 1};
          if (far.gap < near.gap) std::swap(near, far);
          stack[height++] = far;
          at = near;
          continue;
        }
        visit_leaf(at.node);
      }
      if (height == 0) return;
      at = stack[--height];
    }
  }

  const KdTree& tree_;
  const PointMetric& metric_;
  const LeafGaps<Gaps> gaps_;
  const double slack_;
  const bool is_root_of_sum_;
  const PointBirths* const births_;  // null if kHasBirths is false
};

/// True if distinct points are so close that the squares of their gaps are too small for
/// EuclideanGaps. No node in a cluster of such points could be skipped.
bool has_tiny_node(const KdTree& tree) {
  constexpr double tiny = 1e-139;  // above the root of kSmallestPlainSquare
  for (KdTree::Node node = 1; node < tree.node_count(); ++node) {
    double width = 0;
    for (Index k = 0; k < tree.points().cols(); ++k)
      width = std::max(width, tree.box(node)[2 * k + 1] - tree.box(node)[2 * k]);
    if (0 < width && width < tiny) return true;
  }
  return false;
}

}  // namespace

PointBirths::PointBirths(const KdTree& tree, std::span<const double> births,
                         const RunContext& context)
    : of_point_(tree.size(), &context.memory),
      of_node_(tree.node_count(), Least{}, &context.memory) {
  for (Position p = 0; p < tree.size(); ++p) of_point_[p] = births[tree.rows()[p]];
  for (Node node = tree.node_count() - 1; node > 0; --node) {
    Least& least = of_node_[node];
    if (tree.is_leaf(node))
      for (Position p = tree.begin(node); p < tree.end(node); ++p)
        least.add({of_point_[p], tree.rows()[p]});
    else
      for (const std::size_t below : {2 * std::size_t{node}, 2 * std::size_t{node} + 1})
        least.add(of_node_[below]);
  }
}

void NeighbourSearch::Parts::find_nodes(const KdTree& tree, std::span<const std::uint32_t> of_point,
                                        std::span<std::uint32_t> of_node) {
  for (Node node = tree.node_count() - 1; node > 0; --node) {
    if (!tree.is_leaf(node)) {
      const std::size_t below = 2 * std::size_t{node};
      // mutant: parts-node
      of_node[node] = of_node[below] == of_node[below + 1] ? of_node[below] : kMixed;
      continue;
    }
    const Position begin = tree.begin(node), end = tree.end(node);
    of_node[node] = begin < end ? of_point[begin] : kMixed;
    for (Position p = begin; p < end; ++p)
      if (of_point[p] != of_node[node]) of_node[node] = kMixed;  // mutant: forest-leaf
  }
}

std::unique_ptr<NeighbourSearch> NeighbourSearch::make(const KdTree& tree,
                                                       const PointMetric& metric,
                                                       PointDistance distance, double p,
                                                       const PointBirths* births,
                                                       const RunContext& context) {
  // p-norms decrease as p grows. For p below 2, the Euclidean norm is therefore a lower bound. The
  // maximum norm is a lower bound for every p, and needs no squares.
  const double largest = largest_coordinate(tree.points());
  const bool is_euclidean = distance == PointDistance::euclidean;
  const bool are_squares_plain = kSmallestPlain < largest && largest < kLargestPlain;
  const auto search = [&]<class Gaps>(Gaps, bool is_root_of_sum) {
    const auto make = [&]<bool kHasBirths>(std::bool_constant<kHasBirths>) {
      return std::unique_ptr<NeighbourSearch>(std::make_unique<Search<Gaps, kHasBirths>>(
          tree, metric, is_root_of_sum, births, context));
    };
    return births ? make(std::true_type()) : make(std::false_type());
  };
  if (distance == PointDistance::manhattan) return search(ManhattanGaps(), false);
  if (is_euclidean && are_squares_plain && has_tiny_node(tree)) return search(TinyGaps(), false);
  if (are_squares_plain && (is_euclidean || (distance == PointDistance::minkowski && p <= 2)))
    return search(EuclideanGaps(), metric.is_plain_euclidean());
  return search(ChebyshevGaps(), false);
}

}  // namespace ph
