// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "libph/src/rips/beta_skeleton/point_tree.hpp"

namespace ph::beta_skeleton {

/// An edge of the Rips filtration between two positions in the tree, and its place in the order
/// (value, larger vertex, smaller vertex).
struct Edge {
  double value = 0;
  std::uint32_t larger = 0, smaller = 0;  ///< the vertices of the edge
  Position u = kNone, v = kNone;

  /// A squared distance below `certainly_before` belongs to an earlier edge. A squared distance
  /// above `certainly_after` belongs to a later edge. For squared distances between these bounds,
  /// roots must be compared, and then vertices.
  double certainly_before = 0, certainly_after = 0;

  friend bool operator<(const Edge& a, const Edge& b) {
    if (a.value != b.value) return a.value < b.value;
    return a.larger != b.larger ? a.larger < b.larger : a.smaller < b.smaller;
  }
};

/// The components of the graph on the lens of an edge.
struct LensComponents {
  struct Component {
    Position any = kNone;  ///< one of the points of the component
    /// The smallest vertex of the component, as far as it is known.
    std::uint32_t smallest = UINT32_MAX;
  };
  std::vector<Component> others;  ///< all components except the component of `first`
  /// A point of the lens near the middle of the edge, or kNone if the lens is empty.
  Position first = kNone;
  std::vector<Position> of_others;  ///< all points of `others`
};

/// The lens of an edge e = (u,v) consists of the points w for which (u,w) and (v,w) come before e.
template <int D>
class Lenses {
 public:
  using S = Squares<D>;
  using Point = typename PointTree<D>::Point;

  explicit Lenses(const PointTree<D>& tree) : tree_(tree) {}

  const PointTree<D>& tree() const { return tree_; }
  Edge edge(Position u, Position v) const { return edge(u, v, tree_.square(u, v)); }
  Edge edge(Position u, Position v, double square) const {
    const auto [smaller, larger] = std::minmax({tree_.row(u), tree_.row(v)});
    return {std::sqrt(square),         larger, smaller, u, v, square * (1 - kBeyondTies),
            square * (1 + kBeyondTies)};
  }

  bool precedes(Position x, Position y, const Edge& e) const {
    const double square = tree_.square(x, y);
    if (square < e.certainly_before) return true;
    if (square > e.certainly_after) return false;
    const double value = std::sqrt(square);
    if (value != e.value) return value < e.value;  // mutant: beta-distances
    const auto [smaller, larger] = std::minmax({tree_.row(x), tree_.row(y)});
    return larger < e.larger || (larger == e.larger && smaller < e.smaller);  // mutant: beta-tie
  }
  bool contains(const Edge& e, Position w) const {
    return w != e.u && w != e.v && precedes(w, e.u, e) && precedes(w, e.v, e);
  }

  /// The squared radius of a ball that contains the lens of an edge and has its centre at the
  /// computed middle of the edge. A point at distance at most |uv| from both ends is within
  /// sqrt(3/4) |uv| of the true middle.
  double reach(double square) const {
    // mutant: beta-lens-radius
    const double radius = std::sqrt(0.75 * square) * (1 + 1e-9) + tree_.midpoint_error();
    return radius * radius;
  }
  /// The lowest node that contains the entire lens. The search starts at the node of u and goes up.
  Node holder_of(const Edge& e) const {
    const Point middle = PointTree<D>::midpoint(tree_.point(e.u), tree_.point(e.v));
    return tree_.holder_of_ball(tree_.leaf_of(e.u), middle,
                                std::sqrt(reach(e.certainly_after)) * (1 + 1e-9));
  }

  /// The point other than u and v nearest to the middle of the edge, or the first point found whose
  /// squared distance from the middle is below `near_enough`. If the result is kNone, the lens is
  /// empty.
  Position nearest_to_middle(const Edge& e, Node holder, double near_enough) const {
    const Point m = PointTree<D>::midpoint(tree_.point(e.u), tree_.point(e.v));
    return tree_.nearest(holder, m, reach(e.certainly_after), near_enough,
                         [&](Position p) { return p != e.u && p != e.v; });
  }
  /// A point of the lens, if possible near the middle of the edge, or kNone if the lens is empty.
  /// @param near_enough as for nearest_to_middle.
  Position middle(const Edge& e, Node holder, double near_enough = 0) const {
    const Position w = nearest_to_middle(e, holder, near_enough);
    if (w == kNone || contains(e, w)) return w;
    Position any = kNone;
    search(e, holder, [&](Position p) {
      if (!contains(e, p)) return false;
      any = p;
      return true;
    });
    return any;
  }

  /// Finds the components of the graph on the lens of e.
  /// @param near a point of the lens near the middle; if it is kNone, the function searches for
  /// such a point.
  /// @param holder a node that contains the entire lens.
  void find_components(const Edge& e, Position near, Node holder, LensComponents& found) {
    found.others.clear();
    found.of_others.clear();
    found.first = near != kNone ? near : middle(e, holder);
    if (found.first == kNone) return;
    list_far(e, found.first, holder);
    while (!far_.empty()) take_component(e, holder, found);
  }
  /// The smallest vertex in the component of `first`.
  std::uint32_t smallest_of_first(const Edge& e, Node holder, LensComponents& components) const {
    std::vector<Position>& excluded = components.of_others;
    std::sort(excluded.begin(), excluded.end());
    std::uint32_t smallest = tree_.row(components.first);
    search(e, holder, [&](Position p) {
      if (tree_.row(p) < smallest && contains(e, p) &&
          !std::binary_search(excluded.begin(), excluded.end(), p))
        smallest = tree_.row(p);
      return false;
    });
    return smallest;
  }

 private:
  template <class Visit>
  bool search(const Edge& e, Node holder, Visit&& visit) const {
    const double *u = tree_.point(e.u), *v = tree_.point(e.v);
    return tree_.search(
        holder,
        [&](const double* box, Node) {
          return S::least(u, box) > e.certainly_after || S::least(v, box) > e.certainly_after;
        },
        visit);
  }
  /// Lists the points of the lens that w does not see, that is, no edge before e joins them to w.
  void list_far(const Edge& e, Position w, Node holder) {
    far_.clear();
    const double *u = tree_.point(e.u), *v = tree_.point(e.v), *m = tree_.point(w);
    tree_.search(
        holder,
        [&](const double* box, Node) {
          return S::largest(m, box) < e.certainly_before || S::least(u, box) > e.certainly_after ||
                 S::least(v, box) > e.certainly_after;
        },
        [&](Position p) {
          if (p != w && !precedes(p, w, e) && contains(e, p)) far_.push_back(p);
          return false;
        });
  }
  /// Takes a component out of far_. Adds the component to the other components, unless a point of
  /// the lens joins it to the component of `first`.
  void take_component(const Edge& e, Node holder, LensComponents& found) {
    part_.assign(1, far_.back());
    far_.pop_back();
    for (std::size_t i = 0; i < part_.size() && !far_.empty(); ++i)
      std::erase_if(far_, [&](Position q) {
        const bool is_joined = precedes(part_[i], q, e);
        if (is_joined) part_.push_back(q);
        return is_joined;
      });
    std::uint32_t smallest = UINT32_MAX;
    for (const Position p : part_) {
      if (has_bridge(e, found.first, p, holder)) return;  // mutant: beta-bridge
      smallest = std::min(smallest, tree_.row(p));
    }
    found.others.push_back({part_.front(), smallest});
    found.of_others.insert(found.of_others.end(), part_.begin(), part_.end());
  }
  /// True if a point of the lens sees both w and x, that is, edges before e join it to w and to x.
  bool has_bridge(const Edge& e, Position w, Position x, Node holder) const {
    const double *u = tree_.point(e.u), *v = tree_.point(e.v), *a = tree_.point(w),
                 *b = tree_.point(x);
    const double most = e.certainly_after;
    return tree_.search(
        holder,
        [&](const double* box, Node) {
          return S::least(b, box) > most || S::least(a, box) > most || S::least(u, box) > most ||
                 S::least(v, box) > most;
        },
        [&](Position p) {
          return p != w && p != x && precedes(p, x, e) && precedes(p, w, e) && contains(e, p);
        });
  }

  const PointTree<D>& tree_;
  std::vector<Position> far_, part_;  // scratch
};

}  // namespace ph::beta_skeleton
