// SPDX-License-Identifier: MIT
#include "libph/src/metric/leaf_gaps.hpp"

#include "libph/src/core/for_each_target.hpp"

namespace ph {
namespace {

constexpr std::size_t kLeaf = KdTree::kLeafSize;

/// One number for each point of a leaf.
using Lanes
    [[gnu::vector_size(kLeaf * sizeof(double)), gnu::aligned(alignof(double)), gnu::may_alias]] =
        double;

const Lanes& lanes_at(const double* numbers) { return *reinterpret_cast<const Lanes*>(numbers); }

template <class Gaps>
[[gnu::always_inline]] inline void compare_leaves(const double* a, const double* b, Index axes,
                                                  double* norms) {
  Lanes found[kLeaf] = {};
  for (Index k = 0; k < axes; ++k, a += kLeaf, b += kLeaf) {
    const Lanes of_b = lanes_at(b);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kLeaf; ++i) Gaps::add(found[i], Lanes(a[i] - of_b));
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kLeaf; ++i) *reinterpret_cast<Lanes*>(norms + i * kLeaf) = found[i];
}

template <class Gaps>
[[gnu::always_inline]] inline double compare_boxes(const double* a, const double* b, Index axes) {
  static_assert(kLeaf == 8);
  constexpr Lanes sign = {1, -1, 1, -1, 1, -1, 1, -1}, none = {};
  Lanes found = {};
  Index i = 0;
  for (; i + Index{kLeaf} <= 2 * axes; i += kLeaf) {
    const Lanes of_b = lanes_at(b + i);
    // On each axis, the least of a minus the largest of b, and the least of b minus the largest of
    // a. At most one of them is positive.
    const Lanes gap =
        sign * (lanes_at(a + i) - __builtin_shufflevector(of_b, of_b, 1, 0, 3, 2, 5, 4, 7, 6));
    Gaps::add(found, Lanes(gap > none ? gap : none));
  }
  double norm = 0;
  for (; i < 2 * axes; i += 2) Gaps::add(norm, std::max({a[i] - b[i + 1], b[i] - a[i + 1], 0.0}));
  for (std::size_t j = 0; j < kLeaf; ++j) norm = Gaps::join(norm, found[j]);
  return norm;
}

/// Compares points that are stored one per row.
template <class Gaps, Index kAxes>
void compare_rows(std::span<const double> a, std::span<const double> b, double* norms) {
  for (; !a.empty(); a = a.subspan(kAxes), norms += kLeaf)
    for (std::size_t j = 0; j < b.size() / kAxes; ++j) {
      norms[j] = 0;
      for (std::size_t k = 0; k < kAxes; ++k) Gaps::add(norms[j], a[k] - b[j * kAxes + k]);
    }
}

// A template cannot be compiled for several instruction sets, so each kind of gaps has a function.
PH_FOR_EACH_TARGET
void leaves(EuclideanGaps, const double* a, const double* b, Index axes, double* norms) {
  compare_leaves<EuclideanGaps>(a, b, axes, norms);
}
PH_FOR_EACH_TARGET
void leaves(ManhattanGaps, const double* a, const double* b, Index axes, double* norms) {
  compare_leaves<ManhattanGaps>(a, b, axes, norms);
}
PH_FOR_EACH_TARGET
void leaves(ChebyshevGaps, const double* a, const double* b, Index axes, double* norms) {
  compare_leaves<ChebyshevGaps>(a, b, axes, norms);
}
PH_FOR_EACH_TARGET
double boxes(EuclideanGaps, const double* a, const double* b, Index axes) {
  return compare_boxes<EuclideanGaps>(a, b, axes);
}
PH_FOR_EACH_TARGET
double boxes(ManhattanGaps, const double* a, const double* b, Index axes) {
  return compare_boxes<ManhattanGaps>(a, b, axes);
}
PH_FOR_EACH_TARGET
double boxes(ChebyshevGaps, const double* a, const double* b, Index axes) {
  return compare_boxes<ChebyshevGaps>(a, b, axes);
}

}  // namespace

template <class Gaps>
LeafGaps<Gaps>::LeafGaps(const KdTree& tree, const RunContext& context)
    : tree_(tree), blocks_(&context.memory) {
  // Blocks of so few axes would be no faster than rows.
  if (const Index axes = tree.points().cols(); axes == 2 || axes == 3) return;
  blocks_.resize((tree.node_count() - tree.first_leaf()) * block_size());
  double* out = blocks_.data();
  for (KdTree::Node leaf = tree.first_leaf(); leaf < tree.node_count(); ++leaf, out += block_size())
    for (KdTree::Position p = tree.begin(leaf); p < tree.end(leaf); ++p) {
      const double* const x = tree.points().row(Index{p});
      for (Index k = 0; k < tree.points().cols(); ++k)
        out[static_cast<std::size_t>(k) * kLeaf + p - tree.begin(leaf)] = x[k];
    }
}

template <class Gaps>
void LeafGaps<Gaps>::of_leaves(KdTree::Node a, KdTree::Node b, Tile& norms) const {
  const PointsView points = tree_.points();
  const auto rows = [&](KdTree::Node leaf) {
    const KdTree::Position begin = tree_.begin(leaf), end = tree_.end(leaf);
    return std::span(points.row(Index{begin}),
                     points.row(Index{begin}) + (end - begin) * points.cols());
  };
  if (!blocks_.empty())
    leaves(Gaps(), block(a), block(b), points.cols(), norms.data());
  else if (points.cols() == 2)
    compare_rows<Gaps, 2>(rows(a), rows(b), norms.data());
  else
    compare_rows<Gaps, 3>(rows(a), rows(b), norms.data());
}

template <class Gaps>
double LeafGaps<Gaps>::of_boxes(const double* a, const double* b) const {
  return boxes(Gaps(), a, b, tree_.points().cols());
}

template class LeafGaps<EuclideanGaps>;
template class LeafGaps<ManhattanGaps>;
template class LeafGaps<ChebyshevGaps>;
template class LeafGaps<TinyGaps>;

}  // namespace ph
