// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "libph/src/rips/beta_skeleton/lenses.hpp"
#include "libph/src/rips/beta_skeleton/node_pairs.hpp"

namespace ph::beta_skeleton {

/// The last points that ruled out a pair. They often rule out nearby pairs as well.
class Witnesses {
 public:
  void add(Position p) { last_[next_++ % kCount] = p; }
  template <class Decides>
  bool any(Decides&& decides) const {
    return std::any_of(last_.begin(), last_.end(),
                       [&](Position p) { return p != kNone && decides(p); });
  }

 private:
  static constexpr std::size_t kCount = 4;
  std::array<Position, kCount> last_ = [] {
    std::array<Position, kCount> none;
    none.fill(kNone);
    return none;
  }();
  std::size_t next_ = 0;
};

/// An edge of the graph. It is kept small because there are many edges.
struct FoundEdge {
  double value;
  Position u, v;
};

/// Computes the relative neighbourhood graph (Toussaint 1980). It consists of the edges of length
/// up to `limit` with an empty lens, in sorted order.
template <int D>
std::pmr::vector<FoundEdge> relative_neighbours(const PointTree<D>& tree, double limit,
                                                const RunContext& context);

extern template std::pmr::vector<FoundEdge> relative_neighbours<2>(const PointTree<2>&, double,
                                                                   const RunContext&);
extern template std::pmr::vector<FoundEdge> relative_neighbours<3>(const PointTree<3>&, double,
                                                                   const RunContext&);
extern template std::pmr::vector<FoundEdge> relative_neighbours<4>(const PointTree<4>&, double,
                                                                   const RunContext&);

}  // namespace ph::beta_skeleton
