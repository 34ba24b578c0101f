// SPDX-License-Identifier: MIT
#include "libph/src/rips/beta_skeleton/relative_neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "ph/detail/core/parallel.hpp"

namespace ph::beta_skeleton {
namespace {

/// Finds the edges of the graph between the points of two nodes.
template <int D>
class Finder {
 public:
  using S = Squares<D>;

  Finder(const PointTree<D>& tree, double limit, const RunContext& context)
      : tree_(tree), lenses_(tree), limit_(limit), context_(context) {}

  /// Handles a pair of nodes: drops the pair, examines its points, or replaces it by pairs of
  /// children.
  template <class Push>
  void open(NodePair pair, Push&& push, std::pmr::vector<FoundEdge>& found) {
    const auto [a, b] = pair;
    if (a == b) {
      if (tree_.is_leaf(a)) return look_at_points(a, a, found);
      push(NodePair{2 * a, 2 * a});
      push(NodePair{2 * a + 1, 2 * a + 1});
      push(NodePair{2 * a, 2 * a + 1});
      return;
    }
    if (is_hopeless(a, b)) return;
    if (tree_.is_leaf(a) && tree_.is_leaf(b)) return look_at_points(a, b, found);
    const bool splits_a = !tree_.is_leaf(a) && (tree_.is_leaf(b) || extent(a) > extent(b));
    const Node child = 2 * (splits_a ? a : b), other = splits_a ? b : a;
    push(NodePair{child, other});
    push(NodePair{child + 1, other});
  }

 private:
  double extent(Node node) const { return S::extent(tree_.box(node)); }

  /// True if the boxes of nodes a and b show that no pair of a point in a and a point in b is an
  /// edge: one point is in the lenses of all these pairs, or all these pairs are too long.
  bool is_hopeless(Node a, Node b) const {
    const double least = S::least_of_boxes(tree_.box(a), tree_.box(b));
    if (std::sqrt(least) > limit_) return true;
    if (!(4 * least > std::max(extent(a), extent(b)))) return false;
    const auto middle = PointTree<D>::midpoint(tree_.centre(a).data(), tree_.centre(b).data());
    const Node holder = tree_.holder_of_ball(a, middle, std::sqrt(least));
    const Position w = tree_.nearest(holder, middle, least);
    const double most = least * (1 - kBeyondTies);
    return w != kNone && S::largest(tree_.point(w), tree_.box(a)) < most &&
           S::largest(tree_.point(w), tree_.box(b)) < most;
  }
  /// Does the same for all pairs of the point x and a point of node b.
  bool is_hopeless(Position x, Node b, Node holder, Witnesses& witnesses) const {
    const double least = S::least(tree_.point(x), tree_.box(b)) * (1 - kBeyondTies);
    if (least == 0) return false;
    const auto middle = PointTree<D>::midpoint(tree_.point(x), tree_.centre(b).data());
    const Position w = tree_.nearest(holder, middle, least, 0, [&](Position p) { return p != x; });
    if (w == kNone || tree_.square(w, x) >= least ||
        S::largest(tree_.point(w), tree_.box(b)) >= least)
      return false;
    witnesses.add(w);
    return true;
  }

  void look_at_points(Node a, Node b, std::pmr::vector<FoundEdge>& found) {
    const double largest = S::largest_of_boxes(tree_.box(a), tree_.box(b));
    const auto middle = PointTree<D>::midpoint(tree_.centre(a).data(), tree_.centre(b).data());
    const double away = 0.5 * (tree_.radius(a) + tree_.radius(b));
    const Node holder =
        tree_.holder_of_ball(a, middle, std::sqrt(lenses_.reach(largest)) * (1 + 1e-9) + away);
    Witnesses witnesses;
    for (Position x = tree_.begin(a); x < tree_.end(a); ++x) {
      context_.poll();
      if (a != b && is_hopeless(x, b, holder, witnesses)) continue;
      const Position last = a == b ? x : tree_.end(b);
      for (Position y = tree_.begin(b); y < last; ++y)
        look_at(x, y, a, b, holder, witnesses, found);
    }
  }
  void look_at(Position x, Position y, Node a, Node b, Node holder, Witnesses& witnesses,
               std::pmr::vector<FoundEdge>& found) {
    const double square = tree_.square(x, y), before = square * (1 - kBeyondTies);
    const auto is_in_lens = [&](Position p) {
      return tree_.square(p, x) < before && tree_.square(p, y) < before && p != x && p != y;
    };
    if (witnesses.any(is_in_lens)) return;
    for (Position p = tree_.begin(a); p < tree_.end(a); ++p)
      if (is_in_lens(p)) return witnesses.add(p);
    for (Position p = tree_.begin(b); p < tree_.end(b); ++p)
      if (is_in_lens(p)) return witnesses.add(p);
    const Edge e = lenses_.edge(x, y, square);
    if (e.value > limit_) return;
    // Every point whose distance to the middle is at most half the length of the edge is in the
    // lens.
    const Position w = lenses_.middle(e, holder, 0.2 * square);
    if (w != kNone) return witnesses.add(w);
    found.push_back({e.value, x, y});
  }

  const PointTree<D>& tree_;
  Lenses<D> lenses_;
  const double limit_;
  const RunContext& context_;
};

}  // namespace

template <int D>
std::pmr::vector<FoundEdge> relative_neighbours(const PointTree<D>& tree, double limit,
                                                const RunContext& context) {
  constexpr std::size_t few = 1 << 12;  // so few points do not justify a thread
  const std::size_t pieces = tree.size() < few ? 1 : 1024;
  std::pmr::memory_resource* const memory = &context.memory;
  std::pmr::vector<FoundEdge> edges(memory);
  // The loop starts with the root paired with itself, and splits pairs until there are enough for
  // all threads. Each thread then takes a pair and handles everything below it.
  std::pmr::vector<NodePair> pairs({{1, 1}}, memory), next(memory);
  Finder<D> finder(tree, limit, context);
  while (!pairs.empty() && pairs.size() < pieces) {
    next.clear();
    for (const NodePair& pair : pairs)
      finder.open(
          pair, [&](NodePair child) { next.push_back(child); }, edges);
    pairs.swap(next);
  }
  std::pmr::vector<std::pmr::vector<FoundEdge>> found(pairs.size(), memory);
  for_each_piece("neighbours", pairs.size(), 1, context, [&](std::size_t i, std::size_t) {
    Finder<D> own(tree, limit, context);
    std::pmr::vector<NodePair> stack({pairs[i]}, memory);
    while (!stack.empty()) {
      const NodePair pair = stack.back();
      stack.pop_back();
      own.open(
          pair, [&](NodePair child) { stack.push_back(child); }, found[i]);
    }
  });
  std::size_t count = edges.size();
  for (const auto& some : found) count += some.size();
  edges.reserve(count);
  for (auto& some : found) {
    edges.insert(edges.end(), some.begin(), some.end());
    std::pmr::vector<FoundEdge>(memory).swap(some);
  }
  const Lenses<D> lenses(tree);
  std::sort(edges.begin(), edges.end(), [&](const FoundEdge& a, const FoundEdge& b) {
    return a.value != b.value ? a.value < b.value : lenses.edge(a.u, a.v) < lenses.edge(b.u, b.v);
  });
  return edges;
}

template std::pmr::vector<FoundEdge> relative_neighbours<2>(const PointTree<2>&, double,
                                                            const RunContext&);
template std::pmr::vector<FoundEdge> relative_neighbours<3>(const PointTree<3>&, double,
                                                            const RunContext&);
template std::pmr::vector<FoundEdge> relative_neighbours<4>(const PointTree<4>&, double,
                                                            const RunContext&);

}  // namespace ph::beta_skeleton
