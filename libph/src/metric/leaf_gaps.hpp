// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/metric/kd_tree.hpp"

namespace ph {

// A Gaps type computes a norm from the gaps between two points or boxes on each axis. `add` takes
// numbers, or vectors of them. `join` makes one norm of the norms of two sets of axes. The norm is
// cheap to compute, and it is never larger than the distance that a search uses. Because the norm
// and the distance are rounded, the function `reach` allows for the errors of sums: it gives the
// largest norm that can belong to a distance <= d. No point within the distance is therefore
// missed.

struct EuclideanGaps {
  // Smaller sums of squares may have lost digits to underflow.
  static constexpr double kSmallestPlainSquare = 1e-280;
  template <class T>
  static void add(T& sum, const T& gap) {
    sum += gap * gap;
  }
  static double join(double a, double b) { return a + b; }
  /// @param slack a factor that allows for rounding.
  static double reach(double d, double slack) {
    return std::max(d * d * slack, kSmallestPlainSquare);
  }
};

struct ManhattanGaps {
  template <class T>
  static void add(T& sum, const T& gap) {
    sum += gap < 0 ? -gap : gap;
  }
  static double join(double a, double b) { return a + b; }
  static double reach(double d, double slack) { return d * slack; }
};

struct ChebyshevGaps {
  template <class T>
  static void add(T& largest, const T& gap) {
    const T size = gap < 0 ? -gap : gap;
    largest = size > largest ? size : largest;
  }
  static double join(double a, double b) { return std::max(a, b); }
  static double reach(double d, double slack) { return d * slack; }
};

/// The gaps for Euclidean distances whose squares underflow. Searches reach at least 1e-160,
/// because PointMetric computes the distance 0 for points whose squared differences underflow to 0.
struct TinyGaps : ChebyshevGaps {
  static double reach(double d, double slack) { return std::max(d * slack, 1e-160); }
};

/// Compares the leaves and the boxes of a k-d tree. All pairs of points of two leaves are compared
/// at once, with one coordinate of all points of a leaf per vector of the processor. It keeps a
/// reference to the tree.
template <class Gaps>
class LeafGaps {
 public:
  static constexpr std::size_t kLeaf = KdTree::kLeafSize;
  /// The norm for the point at place i of one leaf and the point at place j of another is at
  /// i * kLeaf + j. Each norm has the terms in the order of the axes.
  using Tile = std::array<double, kLeaf * kLeaf>;

  LeafGaps(const KdTree& tree, const RunContext& context);
  void of_leaves(KdTree::Node a, KdTree::Node b, Tile& norms) const;
  /// @param a, b boxes as in KdTree::box.
  double of_boxes(const double* a, const double* b) const;

 private:
  std::size_t block_size() const { return kLeaf * static_cast<std::size_t>(tree_.points().cols()); }
  const double* block(KdTree::Node leaf) const {
    return &blocks_[(leaf - tree_.first_leaf()) * block_size()];
  }
  const KdTree& tree_;
  // Leaf by leaf, axis by axis; unused places are 0. Empty: the rows of the tree are compared.
  std::pmr::vector<double> blocks_;
};

}  // namespace ph
