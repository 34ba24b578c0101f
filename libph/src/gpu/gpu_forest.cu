// SPDX-License-Identifier: MIT
#include "libph/src/gpu/gpu_forest.hpp"

#include <thrust/copy.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/remove.h>
#include <thrust/sort.h>
#include <thrust/transform_reduce.h>

#include <limits>
#include <string>
#include <vector>

#include "libph/src/gpu/boruvka.cuh"
#include "ph/error.hpp"

namespace ph::gpu {
namespace {

// With more axes, boxes rule out few points. The CPU code has the same limit.
constexpr int kMostAxesOfBoxes = 8;

void require_device(std::size_t points, std::size_t axes) {
  cudaDeviceProp device;
  std::size_t free = 0, total = 0;
  cudaError_t error = cudaGetDeviceProperties(&device, 0);
  if (error == cudaSuccess) error = cudaMemGetInfo(&free, &total);
  if (error != cudaSuccess)
    throw Error(ErrorKind::not_built_in,
                std::string("device gpu: CUDA says: ") + cudaGetErrorString(error));
  const std::size_t per_point = axes <= kMostAxesOfBoxes ? 100 + 32 * axes : 140 + 8 * axes;
  const std::size_t needed = points * per_point + (std::size_t{256} << 20);
  if (needed > free)
    throw Error(ErrorKind::resource, "device gpu: " + std::to_string(points) + " points of " +
                                         std::to_string(axes) + " coordinates need " +
                                         std::to_string(needed) + " bytes, but only " +
                                         std::to_string(free) + " of the " + std::to_string(total) +
                                         " bytes of " + device.name + " are free");
}

struct Cloud {
  std::uint32_t size;
  int axes;
  thrust::device_vector<double> coordinates;  // indexed by row

  explicit Cloud(PointsView points)
      : size(static_cast<std::uint32_t>(points.rows())),
        axes(static_cast<int>(std::max<Index>(points.cols(), 1))),
        coordinates(std::size_t{size} * static_cast<std::size_t>(axes)) {
    if (size == 0 || points.cols() == 0) return;
    const bool is_whole = size == 1 || points.row(1) - points.row(0) == points.cols();
    const Points copy = is_whole ? Points() : Points(points);
    const double* const from = is_whole ? points.row(0) : copy.data();
    thrust::copy(from, from + coordinates.size(), coordinates.begin());
  }
  /// The box consists of the smallest coordinates, then the largest coordinates.
  std::vector<double> box() {
    std::vector<double> box;
    for (const double sign : {1.0, -1.0})
      for (int axis = 0; axis < axes; ++axis) {
        const double* const x = raw(coordinates) + axis;
        const auto d = static_cast<std::size_t>(axes);
        const auto coordinate = [=] __host__ __device__(std::uint32_t row) {
          return sign * x[row * d];
        };
        const thrust::counting_iterator<std::uint32_t> first(0);
        box.push_back(sign * thrust::transform_reduce(thrust::device, first, first + size,
                                                      coordinate,
                                                      std::numeric_limits<double>::infinity(),
                                                      thrust::minimum<double>()));
      }
    return box;
  }
};

struct Precedes {
  PH_DEVICE bool operator()(const FlagEdge& a, const FlagEdge& b) const {
    if (a.value != b.value) return a.value < b.value;
    return ends_of(a.u, a.v) < ends_of(b.u, b.v);
  }
};

FlagEdges forest_of(PointsView points, double limit, const RunContext& context) {
  Cloud cloud(points);
  const FlagEdge none{-1, 0, 0};
  thrust::device_vector<FlagEdge> edges(cloud.size, none);
  const double* const x = raw(cloud.coordinates);
  if (cloud.size > 1) {
    const std::unique_ptr<Search> search =
        cloud.axes <= kMostAxesOfBoxes
            ? search_by_boxes(x, cloud.size, cloud.axes, cloud.box(), raw(edges))
            : search_by_pairs(x, cloud.size, cloud.axes, limit);
    if (search) find_forest(*search, limit, raw(edges), context);
  }
  const auto end =
      thrust::remove_if(thrust::device, edges.begin(), edges.end(),
                        [] __host__ __device__(const FlagEdge& e) { return e.value < 0; });
  thrust::sort(thrust::device, edges.begin(), end, Precedes());
  FlagEdges forest(static_cast<std::size_t>(end - edges.begin()), &context.memory);
  thrust::copy(edges.begin(), end, forest.begin());
  return forest;
}

}  // namespace

FlagEdges spanning_forest(const PointMetric& metric, double limit, const RunContext& context) {
  if (!metric.is_plain_euclidean())
    throw Error(
        ErrorKind::usage,
        "device gpu: found coordinates whose squares leave the range of doubles, expected "
        "the largest between 1e-140 and 1e150 in absolute value; scale them, or use the CPU");
  const PointsView points = metric.points();
  require_device(static_cast<std::size_t>(points.rows()), static_cast<std::size_t>(points.cols()));
  try {
    return forest_of(points, limit, context);
  } catch (const thrust::system_error& error) {
    throw Error(ErrorKind::resource, std::string("device gpu: CUDA says: ") + error.what());
  } catch (const std::bad_alloc& error) {
    throw Error(ErrorKind::resource, std::string("device gpu: ") + error.what());
  }
}

}  // namespace ph::gpu
