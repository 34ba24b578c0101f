// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <limits>
#include <span>

#include "libph/src/gpu/device_points.cuh"

// A hierarchy of boxes over points in the order of a space-filling curve: Karras, "Maximizing
// parallelism in the construction of BVHs, octrees, and k-d trees" (2012).

namespace ph::gpu {

/// A place on the curve, in 128 bits. Even if there are far outliers, these bits are enough to
/// distinguish most points.
struct Code {
  std::uint64_t high, low;
};

/// The space-filling curve through the box of all points. It divides space into cubes, even if the
/// axes have different extents.
struct Curve {
  double origin[8];
  double cells_a_unit;

  template <int Axes>
  static constexpr int kBits = Axes <= 2 ? 52 : 128 / Axes;

  /// @param box the bounding box of all points: the smallest coordinates, then the largest.
  template <int Axes>
  static Curve of(std::span<const double> box) {
    Curve curve{};
    double extent = 0;
    for (std::size_t k = 0; k < Axes; ++k) {
      curve.origin[k] = box[k];
      extent = std::max(extent, box[Axes + k] - box[k]);
    }
    constexpr auto cells = static_cast<double>(std::uint64_t{1} << kBits<Axes>);
    curve.cells_a_unit = std::min(cells / extent, std::numeric_limits<double>::max());
    return curve;
  }
  template <int Axes>
  PH_DEVICE Code code(const double* x) const {
    constexpr std::uint64_t last = (std::uint64_t{1} << kBits<Axes>)-1;
    std::uint64_t cell[Axes];
    for (int k = 0; k < Axes; ++k) {
      const double c = (x[k] - origin[k]) * cells_a_unit;
      cell[k] = c >= static_cast<double>(last) ? last : static_cast<std::uint64_t>(c);
    }
    Code code{0, 0};
    for (int b = kBits<Axes> - 1; b >= 0; --b)
      for (int k = 0; k < Axes; ++k) {
        code.high = code.high << 1 | code.low >> 63;
        code.low = code.low << 1 | (cell[k] >> b & 1);
      }
    return code;
  }
};

/// The arrays of the hierarchy, for use in kernels. Inner nodes have the numbers 0 to size - 2, and
/// the root has the number 0. Leaves are points.
template <int Axes>
struct BvhView {
  static constexpr std::uint32_t kMixed = kNone;
  static constexpr std::uint32_t kFew = 8;  // up to this many points are compared one by one
  // The hierarchy has at most one level for each bit of a code and of a position.
  static constexpr int kMostLevels = 160;

  struct Node {
    // The position at one end of the node's range. The node's own number is the position at the
    // other end.
    std::uint32_t other_end;
    // The last position of the left child, which is also the number of that child.
    std::uint32_t split;
    PH_DEVICE std::uint32_t first(std::uint32_t self) const {
      return self < other_end ? self : other_end;
    }
    PH_DEVICE std::uint32_t last(std::uint32_t self) const {
      return self < other_end ? other_end : self;
    }
  };

  std::uint32_t size;         // the number of points, at least 2
  const double* coordinates;  // indexed by position
  // For each position, the number of the point in the caller's order.
  const std::uint32_t* rows;
  Node* nodes;
  // For each node, the smallest coordinates, then the largest coordinates.
  double* boxes;
  // For each node, the component of all its points, or kMixed.
  std::uint32_t* labels;

  PH_DEVICE const double* point(std::uint32_t p) const {
    return coordinates + std::size_t{p} * Axes;
  }
  PH_DEVICE double* box(std::uint32_t node) const { return boxes + std::size_t{node} * 2 * Axes; }
  PH_DEVICE double distance(std::uint32_t p, std::uint32_t q) const {
    const double *x = point(p), *y = point(q);
    return distance_of_square(square_of_distance(x, y, Axes), x, y, Axes);
  }
  PH_DEVICE double gap(const double* x, std::uint32_t node) const {
    const double* const b = box(node);
    double sum = 0;
    for (int k = 0; k < Axes; ++k) {
      const double g = std::fmax(std::fmax(b[k] - x[k], x[k] - b[Axes + k]), 0.0);
      sum += g * g;
    }
    return sum;
  }

  /// The number of leading bits that the codes of two positions share, or -1 if a position is out
  /// of range.
  PH_DEVICE int shared(const Code* codes, std::int64_t i, std::int64_t j) const {
    if (j < 0 || j >= size) return -1;
    const Code a = codes[i], b = codes[j];
    if (a.high != b.high) return cuda::std::countl_zero(a.high ^ b.high);
    if (a.low != b.low) return 64 + cuda::std::countl_zero(a.low ^ b.low);
    return 128 + cuda::std::countl_zero(static_cast<std::uint32_t>(i ^ j));
  }
  PH_DEVICE Node node_at(const Code* codes, std::int64_t i) const {
    const int d = shared(codes, i, i + 1) > shared(codes, i, i - 1) ? 1 : -1;
    const int outside = shared(codes, i, i - d);
    std::int64_t most = 2, length = 0;
    while (shared(codes, i, i + most * d) > outside) most *= 2;
    for (std::int64_t t = most / 2; t > 0; t /= 2)
      if (shared(codes, i, i + (length + t) * d) > outside) length += t;
    const std::int64_t j = i + length * d;
    const int prefix = shared(codes, i, j);
    std::int64_t s = 0;
    for (std::int64_t t = length; t > 1;) {
      t = (t + 1) / 2;
      if (shared(codes, i, i + (s + t) * d) > prefix) s += t;
    }
    return {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(d > 0 ? i + s : i - s - 1)};
  }
  /// Computes the box of a node from the boxes of its children.
  PH_DEVICE void join_boxes(std::uint32_t self) const {
    const Node node = nodes[self];
    const std::uint32_t left = node.split, right = node.split + 1;
    const bool left_is_leaf = node.first(self) == left, right_is_leaf = node.last(self) == right;
    const double* const l = left_is_leaf ? point(left) : box(left);
    const double* const r = right_is_leaf ? point(right) : box(right);
    double* const joint = box(self);
    for (int k = 0; k < Axes; ++k) {
      joint[k] = std::fmin(l[k], r[k]);
      joint[Axes + k] = std::fmax(l[left_is_leaf ? k : Axes + k], r[right_is_leaf ? k : Axes + k]);
    }
  }

  /// The nearest point of another component. If several points are equally near, returns the point
  /// with the lowest row.
  /// @param within points farther away than this may be ignored.
  PH_DEVICE Nearest nearest_foreign(std::uint32_t p, const std::uint32_t* component,
                                    double within) const {
    double x[Axes];
    for (int k = 0; k < Axes; ++k) x[k] = point(p)[k];
    const std::uint32_t own = component[p];
    Nearest best{within, kNone};
    double reach = reach_of(within, Axes);
    const auto look_at = [&](std::uint32_t q) {
      if (component[q] == own) return;
      const double* const y = point(q);
      const double square = square_of_distance(x, y, Axes);
      if (square > reach) return;
      const double d = distance_of_square(square, x, y, Axes);
      if (d > best.distance) return;
      if (d == best.distance && best.position != kNone && rows[q] > rows[best.position]) return;
      best = {d, q};
      reach = reach_of(d, Axes);
    };
    constexpr double never = HUGE_VAL;
    double gaps[kMostLevels];  // the distances to the postponed nodes, one per level
    std::uint32_t later[kMostLevels];
    int height = 0;
    for (std::uint32_t at = 0;;) {
      const Node node = nodes[at];
      const std::uint32_t first = node.first(at), last = node.last(at);
      if (last - first < kFew) {
        for (std::uint32_t q = first; q <= last; ++q) look_at(q);
      } else {
        std::uint32_t near = node.split, far = near + 1;
        double near_gap = never, far_gap = never;
        if (first == near)
          look_at(near);
        else if (labels[near] != own)
          near_gap = gap(x, near);
        if (last == far)
          look_at(far);
        else if (labels[far] != own)
          far_gap = gap(x, far);
        if (far_gap < near_gap) {
          const std::uint32_t node_before = near;
          const double gap_before = near_gap;
          near = far, near_gap = far_gap;
          far = node_before, far_gap = gap_before;
        }
        if (far_gap <= reach) {
          gaps[height] = far_gap;
          later[height++] = far;
        }
        if (near_gap <= reach) {
          at = near;
          continue;
        }
      }
      do {
        if (height == 0) return best;
        --height;
      } while (gaps[height] > reach);
      at = later[height];
    }
  }
};

}  // namespace ph::gpu
