// SPDX-License-Identifier: MIT
#include "libph/src/rips/beta_skeleton/split_lenses.hpp"

#include <algorithm>
#include <cmath>

#include "libph/src/rips/beta_skeleton/spindle.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::beta_skeleton {

/// Examines pairs of nodes and of points. As long as the set of living classes does not change, the
/// result depends only on distances, and pairs may be examined in any order.
template <int D>
class SplitLenses<D>::Opener {
 public:
  Opener(const SplitLenses& of)
      : tree_(of.tree_),
        lenses_(of.tree_),
        limit_(of.limit_),
        classes_(of.classes_),
        context_(of.context_) {}

  /// Handles a pair of nodes: drops the pair, examines its points, or replaces it by pairs of
  /// children.
  void open(NodePair pair, Found& found) {
    const auto [a, b] = pair;
    if (a == b) {
      if (tree_.is_leaf(a)) return look_at_points(a, a, kNone, found);
      for (const NodePair child :
           {NodePair{2 * a, 2 * a}, NodePair{2 * a + 1, 2 * a + 1}, NodePair{2 * a, 2 * a + 1}})
        found.pairs.push_back(child);
      return;
    }
    Position witness = kNone;
    if (is_hopeless(a, b, witness)) return;
    if (tree_.is_leaf(a) && tree_.is_leaf(b)) return look_at_points(a, b, witness, found);
    const bool splits_a = !tree_.is_leaf(a) && (tree_.is_leaf(b) || extent(a) > extent(b));
    const Node child = 2 * (splits_a ? a : b), other = splits_a ? b : a;
    found.pairs.push_back({child, other});
    found.pairs.push_back({child + 1, other});
  }

 private:
  using Point = typename PointTree<D>::Point;

  double extent(Node node) const { return S::extent(tree_.box(node)); }
  /// A node that contains the lens of each pair of a point in node a and a point in node b.
  Node holder_of_lenses(Node a, Node b, const Point& middle, double largest) const {
    const double away = 0.5 * (tree_.radius(a) + tree_.radius(b));
    return tree_.holder_of_ball(
        a, middle, std::sqrt(lenses_.reach(largest * (1 + kBeyondTies))) * (1 + 1e-9) + away);
  }

  /// True if no pair of points of two nodes has to be examined.
  /// @param witness receives a point near the midpoint of the two nodes' centres, or kNone. It is
  /// unchanged if the function does not search for such a point.
  bool is_hopeless(Node a, Node b, Position& witness) const {
    const double least = S::least_of_boxes(tree_.box(a), tree_.box(b)),
                 largest = S::largest_of_boxes(tree_.box(a), tree_.box(b));
    if (classes_.are_none_up_to(std::sqrt(largest)) || std::sqrt(least) > limit_) return true;
    if (least <= 0) return false;
    const Point u = tree_.centre(a), v = tree_.centre(b),
                middle = PointTree<D>::midpoint(u.data(), v.data());
    const double ru = tree_.radius(a), rv = tree_.radius(b),
                 square = S::between(u.data(), v.data()), distance = std::sqrt(square);
    if (distance < 2 * (ru + rv)) return false;
    const Node holder = tree_.holder_of_ball(a, middle, std::sqrt(0.75 * square));
    witness = tree_.nearest(holder, middle, 0.75 * square);
    if (witness == kNone) return false;
    const double* const w = tree_.point(witness);
    if (is_in_spindles<D>(w, u.data(), ru, v.data(), rv, distance)) return true;
    return sees_all_lenses(w, a, b, holder_of_lenses(a, b, middle, largest));
  }
  /// True if w is in the lens of each pair of a point in node a and a point in node b, and is
  /// joined to every other point of the lens by an earlier edge.
  bool sees_all_lenses(const double* w, Node a, Node b, Node holder) const {
    const double *u = tree_.box(a), *v = tree_.box(b);
    const double least = S::least_of_boxes(u, v) * (1 - kBeyondTies),
                 largest = S::largest_of_boxes(u, v) * (1 + kBeyondTies);
    if (S::largest(w, u) >= least || S::largest(w, v) >= least) return false;
    return !tree_.search(
        holder,
        [&](const double* box, Node) {
          return S::largest(w, box) < least || S::least_of_boxes(u, box) > largest ||
                 S::least_of_boxes(v, box) > largest;
        },
        [&](Position p) {
          const double* const x = tree_.point(p);
          return S::between(w, x) >= least && S::least(x, u) <= largest &&
                 S::least(x, v) <= largest;
        });
  }

  void look_at_points(Node a, Node b, Position witness, Found& found) {
    const Point u = tree_.centre(a), v = tree_.centre(b),
                middle = PointTree<D>::midpoint(u.data(), v.data());
    const Node holder =
        holder_of_lenses(a, b, middle, S::largest_of_boxes(tree_.box(a), tree_.box(b)));
    Witnesses witnesses;
    if (witness != kNone) witnesses.add(witness);
    for (Position x = tree_.begin(a); x < tree_.end(a); ++x) {
      context_.poll();
      const Position last = a == b ? x : tree_.end(b);
      for (Position y = tree_.begin(b); y < last; ++y)
        look_at(x, y, a, b, holder, witnesses, found);
    }
  }
  void look_at(Position x, Position y, Node a, Node b, Node holder, Witnesses& witnesses,
               Found& found) {
    const double square = tree_.square(x, y);
    const double *u = tree_.point(x), *v = tree_.point(y);
    const auto is_witness = [&](Position p) {
      return is_in_spindle<D>(tree_.point(p), u, v, square);
    };
    if (witnesses.any(is_witness)) return;
    const Edge e = lenses_.edge(x, y, square);
    if (e.value > limit_ || classes_.are_none_up_to(e.value)) return;
    for (Position p = tree_.begin(a); p < tree_.end(a); ++p)
      if (is_witness(p)) return witnesses.add(p);
    if (a != b)
      for (Position p = tree_.begin(b); p < tree_.end(b); ++p)
        if (is_witness(p)) return witnesses.add(p);
    // The ball of radius 0.134 |uv| around the middle is in the spindle.
    const Position w = lenses_.nearest_to_middle(e, holder, 0.0179 * square);
    if (w == kNone) return;  // the lens is empty
    if (is_witness(w)) return witnesses.add(w);
    lenses_.find_components(e, lenses_.contains(e, w) ? w : kNone, holder, components_);
    if (!components_.others.empty()) found.edges.push_back({e.value, x, y});
  }

  const PointTree<D>& tree_;
  Lenses<D> lenses_;
  const double limit_;
  const Classes& classes_;
  const RunContext& context_;
  LensComponents components_;  // scratch
};

template <int D>
void SplitLenses<D>::run(const OnSplit& on_split) {
  queue_.push(0, {1, 1});
  while (!classes_.are_over() && queue_.open_next()) {
    open_bin();
    sweep_below(queue_.bound(), on_split);
  }
  sweep_below(std::numeric_limits<double>::infinity(), on_split);
}

template <int D>
void SplitLenses<D>::open_bin() {
  constexpr std::size_t round = 4096, piece = 64, crowded = 1 << 15;
  std::pmr::memory_resource* const memory = &context_.memory;
  Pairs pairs(memory);
  std::vector<Found> found;
  std::size_t opened = 0;
  while (queue_.take(round, pairs)) {
    const std::size_t pieces = (pairs.size() + piece - 1) / piece;
    while (found.size() < pieces) found.emplace_back(memory);
    for_each_piece("lenses", pairs.size(), piece, context_,
                   [&](std::size_t begin, std::size_t end) {
                     Found& own = found[begin / piece];
                     own.clear();
                     Opener opener(*this);
                     for (std::size_t i = begin; i < end; ++i) opener.open(pairs[i], own);
                   });
    for (std::size_t i = 0; i < pieces; ++i) {
      for (const NodePair& pair : found[i].pairs)
        if (const double d = distance(pair); d <= limit_) queue_.push(d, pair);
      for (const FoundEdge& e : found[i].edges) {
        split_.push_back(e);
        std::push_heap(split_.begin(), split_.end(),
                       [&](const FoundEdge& x, const FoundEdge& y) { return comes_later(x, y); });
      }
    }
    opened += pairs.size();
    if (opened >= crowded && queue_.can_narrow()) {
      queue_.narrow([&](const NodePair& pair) { return distance(pair); });
      queue_.open_next();
      opened = 0;
    }
  }
}

template <int D>
void SplitLenses<D>::sweep_below(double bound, const OnSplit& on_split) {
  while (!split_.empty() && split_.front().value < bound && !classes_.are_over()) {
    std::pop_heap(split_.begin(), split_.end(),
                  [&](const FoundEdge& x, const FoundEdge& y) { return comes_later(x, y); });
    const Edge e = lenses_.edge(split_.back().u, split_.back().v);
    split_.pop_back();
    on_split(e, lenses_.holder_of(e));
    context_.poll();
  }
  // This counts the classes that are born before `bound` as living.
  while (classes_.born < classes_.births.size() && classes_.births[classes_.born] < bound) {
    ++classes_.born;
    ++classes_.living;
  }
}

template class SplitLenses<2>;
template class SplitLenses<3>;
template class SplitLenses<4>;

}  // namespace ph::beta_skeleton
