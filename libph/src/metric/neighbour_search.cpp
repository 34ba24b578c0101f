// SPDX-License-Identifier: MIT
#include "libph/src/metric/neighbour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libph/src/metric/plain_squares.hpp"

namespace ph {
namespace {

// A Gaps type computes a norm from the gaps between two boxes on each axis. The norm is cheap to
// compute, and it is never larger than the distance that the search uses. Because the norm and the
// distance are rounded, the function `reach` allows for the errors of sums. No point within the
// distance is therefore missed.
// mutant: search-slack
double slack(Index axes) { return 1 + 4e-16 * static_cast<double>(axes + 8); }

struct EuclideanGaps {
  // Smaller sums of squares may have lost digits to underflow.
  static constexpr double kSmallestPlainSquare = 1e-280;
  static double add(double sum, double gap) { return sum + gap * gap; }
  /// The largest sum that can belong to a distance <= d. @param slack a factor that allows for
  /// rounding.
  static double reach(double d, double slack) {
    return std::max(d * d * slack, kSmallestPlainSquare);
  }
};
struct ManhattanGaps {
  static double add(double sum, double gap) { return sum + std::abs(gap); }
  static double reach(double d, double slack) { return d * slack; }
};
struct ChebyshevGaps {
  static double add(double sum, double gap) { return std::max(sum, std::abs(gap)); }
  static double reach(double d, double slack) { return d * slack; }
};

/// The gaps for Euclidean distances whose squares underflow. Searches reach at least 1e-160,
/// because PointMetric computes the distance 0 for points whose squared differences underflow to 0.
struct TinyGaps : ChebyshevGaps {
  static double reach(double d, double slack) { return std::max(d * slack, 1e-160); }
};

/// @tparam Axes the number of coordinates; 0 for any number.
template <class Gaps, int Axes, bool kHasBirths>
class Search final : public NeighbourSearch {
 public:
  /// @param is_root_of_sum true if the distance is the square root of the sum of squares.
  Search(const KdTree& tree, const PointMetric& metric, bool is_root_of_sum,
         const PointBirths* births)
      : tree_(tree),
        metric_(metric),
        axes_(tree.points().cols()),
        slack_(slack(axes_)),
        is_root_of_sum_(is_root_of_sum),
        births_(births) {}

  void nearest(Node leaf, std::size_t k, double limit, Ties ties,
               std::span<Neighbour> found) const override {
    const Position begin = tree_.begin(leaf), end = tree_.end(leaf);
    std::array<double, KdTree::kLeafSize> reach;
    reach.fill(Gaps::reach(limit, slack_));
    double farthest = reach[0], farthest_distance = limit;
    const double* const box = tree_.box(leaf);
    std::fill(found.begin(), found.end(), Neighbour{limit, kNone});
    const auto visit_leaf = [&](Node other) {
      const Position first = tree_.begin(other), last = tree_.end(other);
      for (Position p = begin; p < end; ++p) {
        double& reach_of_p = reach[p - begin];
        if (other != leaf && gap_to_box(p, other) > reach_of_p) continue;
        const std::span<Neighbour> list = found.subspan((p - begin) * k, k);
        if (enters_too_late(other, p, list.back())) continue;
        for (Position q = first; q < last; ++q) {
          const double sum = gap_to_point(p, q);
          if (sum > reach_of_p || p == q) continue;
          insert({distance(p, q, sum), q}, list);
          reach_of_p = reach_beside(list.back(), ties);
        }
      }
      farthest = *std::max_element(reach.begin(), reach.begin() + (end - begin));
      if constexpr (kHasBirths) {
        farthest_distance = 0;
        for (std::size_t i = k - 1; i < k * (end - begin); i += k)
          farthest_distance = std::max(farthest_distance, found[i].distance);
      }
    };
    const auto is_hopeless = [&](Node node, double gap) {
      if constexpr (kHasBirths)
        if (births_->least_birth(node) > farthest_distance) return true;
      return gap > farthest || node == leaf;
    };
    visit_leaf(leaf);
    traverse([&](Node node) { return gap_of_boxes(box, tree_.box(node)); }, is_hopeless,
             visit_leaf);
  }

  using NeighbourSearch::nearest_foreign;
  void nearest_foreign(Position p, const Parts& parts, double limit, Ties ties,
                       std::span<Neighbour> found) const override {
    const std::uint32_t own = parts.of_point[p];
    std::fill(found.begin(), found.end(), Neighbour{limit, kNone});
    double reach = Gaps::reach(limit, slack_);
    const auto visit_leaf = [&](Node leaf) {
      for (Position q = tree_.begin(leaf); q < tree_.end(leaf); ++q) {
        const double sum = gap_to_point(p, q);
        if (sum > reach || parts.of_point[q] == own) continue;
        insert({distance(p, q, sum), q}, found);
        reach = reach_beside(found.back(), ties);
      }
    };
    const auto is_hopeless = [&](Node node, double gap) {
      return gap > reach || parts.of_node[node] == own || enters_too_late(node, p, found.back());
    };
    traverse([&](Node node) { return gap_to_box(p, node); }, is_hopeless, visit_leaf);
  }

  double distance(Position p, Position q) const override {
    return distance(p, q, gap_to_point(p, q));
  }

  void pairs_within(double limit, const VisitPair& visit,
                    const RunContext& context) const override {
    Ticker ticker(context, "near pairs", tree_.size());
    visit_pairs(1, 1, {limit, Gaps::reach(limit, slack_), visit, ticker});
  }

 private:
  struct Pairs {
    double limit, reach;
    const VisitPair& visit;
    Ticker& ticker;
  };
  /// Visits each pair of a point in `a` and a point in `b`. The nodes must be on the same level,
  /// and `b` must not come before `a`.
  void visit_pairs(Node a, Node b, const Pairs& pairs) const {
    if (a != b && gap_of_boxes(tree_.box(a), tree_.box(b)) > pairs.reach) return;
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
    for (Position p = tree_.begin(a); p < tree_.end(a); ++p) {
      for (Position q = a == b ? p + 1 : tree_.begin(b); q < last; ++q) {
        const double sum = gap_to_point(p, q);
        if (sum > pairs.reach) continue;
        const double d = distance(p, q, sum);
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
  Index axes() const {
    if constexpr (Axes > 0) return Axes;
    return axes_;
  }
  const double* coordinates(Position p) const { return tree_.points().row(Index{p}); }
  double gap_to_point(Position p, Position q) const {
    const double *x = coordinates(p), *y = coordinates(q);
    double sum = 0;
    for (Index k = 0; k < axes(); ++k) sum = Gaps::add(sum, x[k] - y[k]);
    return sum;
  }
  double gap_to_box(Position p, Node node) const {
    const double *x = coordinates(p), *box = tree_.box(node);
    double sum = 0;
    for (Index k = 0; k < axes(); ++k)
      sum = Gaps::add(sum, std::max({box[2 * k] - x[k], x[k] - box[2 * k + 1], 0.0}));
    return sum;
  }
  double gap_of_boxes(const double* a, const double* b) const {
    double sum = 0;
    for (Index k = 0; k < axes(); ++k)
      sum = Gaps::add(sum, std::max({a[2 * k] - b[2 * k + 1], b[2 * k] - a[2 * k + 1], 0.0}));
    return sum;
  }
  /// @param sum the result of gap_to_point(p, q), which equals the sum that the metric computes
  /// unless digits were lost.
  double distance(Position p, Position q, double sum) const {
    const double length = length_of(p, q, sum);
    if constexpr (kHasBirths) return std::max({length, births_->of_point(p), births_->of_point(q)});
    return length;
  }
  double length_of(Position p, Position q, double sum) const {
    if constexpr (std::same_as<Gaps, EuclideanGaps>)
      if (is_root_of_sum_ && sum >= Gaps::kSmallestPlainSquare) return std::sqrt(sum);
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
  /// The largest sum with which a point may still replace the worst neighbour.
  double reach_beside(const Neighbour& worst, Ties ties) const {
    constexpr double nothing = -1;
    if (ties == Ties::any && worst.distance == 0) return nothing;  // mutant: search-any-tie
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
  const Index axes_;
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

template <class Gaps>
std::unique_ptr<NeighbourSearch> make_search(const KdTree& tree, const PointMetric& metric,
                                             bool is_root_of_sum, const PointBirths* births) {
  const auto make =
      [&]<int Axes>(std::integral_constant<int, Axes>) -> std::unique_ptr<NeighbourSearch> {
    if (births)
      return std::make_unique<Search<Gaps, Axes, true>>(tree, metric, is_root_of_sum, births);
    return std::make_unique<Search<Gaps, Axes, false>>(tree, metric, is_root_of_sum, births);
  };
  switch (tree.points().cols()) {
    case 2:
      return make(std::integral_constant<int, 2>());
    case 3:
      return make(std::integral_constant<int, 3>());
    default:
      return make(std::integral_constant<int, 0>());
  }
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
                                                       const PointBirths* births) {
  // p-norms decrease as p grows. For p below 2, the Euclidean norm is therefore a lower bound. The
  // maximum norm is a lower bound for every p, and needs no squares.
  const double largest = largest_coordinate(tree.points());
  const bool is_euclidean = distance == PointDistance::euclidean;
  const bool are_squares_plain = kSmallestPlain < largest && largest < kLargestPlain;
  if (distance == PointDistance::manhattan)
    return make_search<ManhattanGaps>(tree, metric, false, births);
  if (is_euclidean && are_squares_plain && has_tiny_node(tree))
    return make_search<TinyGaps>(tree, metric, false, births);
  if (are_squares_plain && (is_euclidean || (distance == PointDistance::minkowski && p <= 2)))
    return make_search<EuclideanGaps>(tree, metric, metric.is_plain_euclidean(), births);
  return make_search<ChebyshevGaps>(tree, metric, false, births);
}

}  // namespace ph
