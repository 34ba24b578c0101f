// SPDX-License-Identifier: MIT
#include <thrust/sequence.h>
#include <thrust/sort.h>

#include <algorithm>

#include "libph/src/gpu/boruvka.cuh"

// Finds nearest foreign points by comparing all pairs of points. This search is used in spaces with
// so many dimensions that boxes rule out nothing.

namespace ph::gpu {
namespace {

struct PairPoints {
  std::uint32_t size;
  const double* coordinates;  // indexed by position, which is the row
  int axes;

  PH_DEVICE const double* point(std::uint32_t p) const {
    return coordinates + std::size_t{p} * static_cast<std::size_t>(axes);
  }
  PH_DEVICE double distance(std::uint32_t p, std::uint32_t q) const {
    const double *x = point(p), *y = point(q);
    return distance_of_square(square_of_distance(x, y, axes), x, y, axes);
  }
};

// The number of points on each side of a tile, which is a square of pairs.
inline constexpr int kTile = 64;
// The number of axes that a thread block loads at a time.
inline constexpr int kSlab = 16;
// The number of threads on each side of a thread block, which is square.
inline constexpr int kSide = 16;
inline constexpr int kEach = kTile / kSide;

/// Finds the nearest foreign points of the points in `asked`, 64 per thread block (grid axis x).
/// Each thread block searches one of several ranges that together cover all points (grid axis y).
/// Points are sorted by component. A pair of tiles whose points all belong to the same component is
/// skipped.
/// @param order all points, sorted by component. @param answers receives an answer for each point
/// in `asked` and each range.
__global__ void __launch_bounds__(kSide* kSide)
    nearest_of_tiles(PairPoints points, const std::uint32_t* asked, std::uint32_t asked_count,
                     const std::uint32_t* order, std::uint32_t range,
                     const std::uint32_t* component, double limit, Nearest* answers) {
  __shared__ double of_asked[kSlab][kTile + 1], of_others[kSlab][kTile + 1];
  const int tx = static_cast<int>(threadIdx.x) % kSide, ty = static_cast<int>(threadIdx.x) / kSide;
  const std::uint32_t asked_first = blockIdx.x * kTile;
  const std::uint32_t asked_last = min(asked_first + kTile, asked_count) - 1;
  const bool is_one = component[asked[asked_first]] == component[asked[asked_last]];
  std::uint32_t p[kEach], own[kEach];
  Nearest best[kEach];
  double reach[kEach];
  for (int i = 0; i < kEach; ++i) {
    p[i] = asked[min(asked_first + ty + kSide * i, asked_last)];
    own[i] = component[p[i]];
    best[i] = {limit, kNone};
    reach[i] = reach_of(limit, points.axes);
  }
  const std::uint32_t begin = blockIdx.y * range, end = min(begin + range, points.size);
  for (std::uint32_t first = begin; first < end; first += kTile) {
    const std::uint32_t last = min(first + kTile, end) - 1;
    const std::uint32_t label = component[order[first]];
    if (is_one && label == own[0] && component[order[last]] == label) continue;
    double sums[kEach][kEach] = {};
    for (int axis = 0; axis < points.axes; axis += kSlab) {
      const int k = axis + tx;
      for (int i = 0; i < kEach; ++i) {
        const std::uint32_t row = ty + kSide * i;
        const std::uint32_t a = asked[min(asked_first + row, asked_last)];
        const std::uint32_t b = order[min(first + row, last)];
        of_asked[tx][row] = k < points.axes ? points.point(a)[k] : 0;
        of_others[tx][row] = k < points.axes ? points.point(b)[k] : 0;
      }
      __syncthreads();
      // Entries beyond the last axis are 0 and therefore do not change the sums.
#pragma unroll
      for (int s = 0; s < kSlab; ++s) {
        double x[kEach], y[kEach];
        for (int i = 0; i < kEach; ++i) x[i] = of_asked[s][ty + kSide * i];
        for (int j = 0; j < kEach; ++j) y[j] = of_others[s][tx + kSide * j];
        for (int i = 0; i < kEach; ++i)
          for (int j = 0; j < kEach; ++j) sums[i][j] += (x[i] - y[j]) * (x[i] - y[j]);
      }
      __syncthreads();
    }
#pragma unroll
    for (int j = 0; j < kEach; ++j) {
      if (first + tx + kSide * j > last) continue;
      const std::uint32_t q = order[first + tx + kSide * j], label_of_q = component[q];
#pragma unroll
      for (int i = 0; i < kEach; ++i) {
        if (label_of_q == own[i] || sums[i][j] > reach[i]) continue;
        const double d =
            distance_of_square(sums[i][j], points.point(p[i]), points.point(q), points.axes);
        if (d > best[i].distance || (d == best[i].distance && q > best[i].position)) continue;
        best[i] = {d, q};
        reach[i] = reach_of(d, points.axes);
      }
    }
  }
  for (int i = 0; i < kEach; ++i) {
    for (int step = kSide / 2; step > 0; step /= 2) {
      const Nearest o{__shfl_xor_sync(~0U, best[i].distance, step),
                      __shfl_xor_sync(~0U, best[i].position, step)};
      if (o.distance < best[i].distance ||
          (o.distance == best[i].distance && o.position < best[i].position))
        best[i] = o;
    }
    const std::uint32_t row = asked_first + ty + kSide * i;
    if (tx == 0 && row <= asked_last) answers[std::size_t{row} * gridDim.y + blockIdx.y] = best[i];
  }
}

class PairSearch final : public Search {
 public:
  PairSearch(const double* coordinates, std::uint32_t size, int axes, double limit)
      : coordinates_(coordinates), axes_(axes), limit_(limit), rows_(size), order_(size) {
    thrust::sequence(thrust::device, rows_.begin(), rows_.end());
  }
  std::uint32_t size() const override { return static_cast<std::uint32_t>(rows_.size()); }
  const std::uint32_t* rows() const override { return thrust::raw_pointer_cast(rows_.data()); }
  PairPoints view() const { return {size(), coordinates_, axes_}; }

  static void sort_by_component(Positions& positions, const std::uint32_t* component) {
    Positions keys(positions.size());
    const auto key = raw(keys), position = raw(positions);
    for_each_index(static_cast<std::uint32_t>(positions.size()),
                   [=] __host__ __device__(std::uint32_t i) { key[i] = component[position[i]]; });
    thrust::stable_sort_by_key(thrust::device, keys.begin(), keys.end(), positions.begin());
  }

  void see(const BoruvkaView& v) override {
    order_ = rows_;
    sort_by_component(order_, v.component);
  }
  void bound_by_followers(const BoruvkaView& v) override {
    const PairPoints points = view();
    for_each_index(size() - 1, [=] __host__ __device__(std::uint32_t p) {
      if (v.component[p] != v.component[p + 1]) v.bound(p, p + 1, points.distance(p, p + 1));
    });
  }

  void ask(Positions& asked, const BoruvkaView& v, const RunContext& context) override {
    sort_by_component(asked, v.component);
    const std::uint32_t least = 16 * kTile, most_ranges = 32;
    const std::uint32_t share = (size() + most_ranges - 1) / most_ranges;
    const std::uint32_t range = std::max(least, (share + kTile - 1) / kTile * kTile);
    const std::uint32_t ranges = (size() + range - 1) / range;
    // The number of query points per launch is chosen so that a launch takes a few tenths of a
    // second.
    const double terms_a_point = static_cast<double>(size()) * axes_;
    const auto batch = static_cast<std::uint32_t>(
        std::clamp(1e12 / terms_a_point, 16.0 * kTile, 1e6) / kTile * kTile);
    const auto count = static_cast<std::uint32_t>(asked.size());
    thrust::device_vector<Nearest> answers(std::size_t{std::min(batch, count)} * ranges);
    for (std::uint32_t begin = 0; begin < count; begin += batch) {
      context.poll();
      const std::uint32_t now = std::min(batch, count - begin);
      const std::uint32_t* const ask = raw(asked) + begin;
      Nearest* const answer = raw(answers);
      nearest_of_tiles<<<dim3((now + kTile - 1) / kTile, ranges), kSide * kSide>>>(
          view(), ask, now, raw(order_), range, v.component, limit_, answer);
      check(cudaGetLastError());
      for_each_index(now, [=] __host__ __device__(std::uint32_t i) {
        Nearest best = answer[std::size_t{i} * ranges];
        for (std::uint32_t r = 1; r < ranges; ++r) {
          const Nearest o = answer[std::size_t{i} * ranges + r];
          if (o.distance < best.distance ||
              (o.distance == best.distance && o.position < best.position))
            best = o;
        }
        v.answer(ask[i], best);
      });
    }
  }

 private:
  const double* const coordinates_;
  const int axes_;
  const double limit_;
  Positions rows_, order_;
};

}  // namespace

std::unique_ptr<Search> search_by_pairs(const double* x, std::uint32_t size, int axes,
                                        double limit) {
  return std::make_unique<PairSearch>(x, size, axes, limit);
}

}  // namespace ph::gpu
