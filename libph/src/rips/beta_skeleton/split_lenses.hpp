// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/beta_skeleton/node_pairs.hpp"
#include "libph/src/rips/beta_skeleton/relative_neighbours.hpp"

namespace ph::beta_skeleton {

/// The data about classes of H1 that decide which pairs of points must be examined.
struct Classes {
  std::span<const double> births;  ///< births of all classes that there will be, ascending
  std::size_t born = 0, living = 0;

  /// True if no class is alive between now and the given value.
  bool are_none_up_to(double value) const {
    return living == 0 && (born == births.size() || births[born] > value);  // mutant: beta-pairs-go
  }
  bool are_over() const { return living == 0 && born == births.size(); }  // mutant: beta-over
};

/// Finds the edges whose lens has several components, in their order, until no classes are left.
template <int D>
class SplitLenses {
 public:
  using S = Squares<D>;
  /// A function that receives each edge whose lens has several components, and updates the classes.
  using OnSplit = std::function<void(const Edge&, Node holder)>;

  /// @param classes the data of classes; the counts of born and living classes change while edges
  /// are found. @param limit the length of the longest edge.
  SplitLenses(const PointTree<D>& tree, double limit, Classes& classes, const RunContext& context)
      : tree_(tree),
        lenses_(tree),
        limit_(limit),
        classes_(classes),
        context_(context),
        queue_(classes.births.empty() ? 0 : classes.births.front(), &context.memory),
        split_(&context.memory) {}

  void run(const OnSplit& on_split);

 private:
  using Pairs = NodePairQueue::Pairs;
  struct Found {
    explicit Found(std::pmr::memory_resource* memory) : pairs(memory), edges(memory) {}
    Pairs pairs;
    std::pmr::vector<FoundEdge> edges;
    void clear() {
      pairs.clear();
      edges.clear();
    }
  };
  class Opener;

  void open_bin();
  void sweep_below(double bound, const OnSplit& on_split);
  double distance(NodePair pair) const {
    return std::sqrt(S::least_of_boxes(tree_.box(pair.a), tree_.box(pair.b)));
  }
  bool comes_later(const FoundEdge& a, const FoundEdge& b) const {
    return a.value != b.value ? a.value > b.value : lenses_.edge(b.u, b.v) < lenses_.edge(a.u, a.v);
  }

  const PointTree<D>& tree_;
  Lenses<D> lenses_;
  const double limit_;
  Classes& classes_;
  const RunContext& context_;
  NodePairQueue queue_;
  std::pmr::vector<FoundEdge> split_;  // a heap with the first edge on top
};

extern template class SplitLenses<2>;
extern template class SplitLenses<3>;
extern template class SplitLenses<4>;

}  // namespace ph::beta_skeleton
