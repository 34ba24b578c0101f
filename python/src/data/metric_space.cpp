// SPDX-License-Identifier: MIT
#include "python/src/data/metric_space.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/distance_to_measure.hpp"
#include "ph/error.hpp"
#include "ph/voxel_image.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {
namespace {

/// The number of points that have this many pairs. @throws Error (bad_data) if there is no such
/// number.
Index points_of_pairs(Index pairs) {
  const auto n =
      static_cast<Index>(std::llround((1 + std::sqrt(1 + 8 * static_cast<double>(pairs))) / 2));
  if (n * (n - 1) / 2 != pairs)
    throw Error(ErrorKind::bad_data,
                fmt::format("condensed distances: found {} numbers, expected n(n-1)/2 for a number "
                            "n of points",
                            pairs));
  return n;
}

}  // namespace

MetricSpace::MetricSpace(const py::buffer& points, PointDistance distance, double p) {
  const PointsView view = points_of(arrays_.emplace_back(points.request()));
  size_ = view.rows();
  numbers_ = PointSet{view, distance, p};
}

MetricSpace::MetricSpace(const py::buffer& distances, Symmetrise symmetrise, NanPolicy nan,
                         bool has_zero_diagonal, bool has_nan_option) {
  const py::buffer_info& info = arrays_.emplace_back(distances.request());
  is_single_ = holds<float>(info);
  if (!is_single_ && !holds<double>(info))
    throw Error(ErrorKind::internal, "distances of the wrong type reached _core");
  DistanceArray array;
  array.data = static_cast<const char*>(info.ptr);
  array.is_condensed = info.ndim == 1;
  array.points = array.is_condensed ? points_of_pairs(info.size) : info.shape[0];
  array.row_stride = info.strides.front();
  array.column_stride = info.strides.back();
  array.symmetrise = symmetrise;
  array.nan = nan;
  array.has_zero_diagonal = has_zero_diagonal;
  array.has_nan_option = has_nan_option;
  size_ = array.points;
  numbers_ = array;
}

MetricSpace::MetricSpace(Index size, const py::buffer& i, const py::buffer& j,
                         const py::buffer& distances)
    : size_(size) {
  for (const py::buffer& array : {i, j, distances}) arrays_.push_back(array.request());
  numbers_ = Pairs{numbers_of<std::int64_t>(arrays_[0]), numbers_of<std::int64_t>(arrays_[1]),
                   numbers_of<double>(arrays_[2])};
}

SparseDistances MetricSpace::sparse_distances(const Pairs& pairs) const {
  std::vector<WeightedEdge> edges;
  edges.reserve(pairs.distances.size());
  for (std::size_t k = 0; k < pairs.distances.size(); ++k)
    edges.push_back({pairs.i[k], pairs.j[k], pairs.distances[k]});
  return SparseDistances(size_, std::move(edges));
}

namespace {

[[noreturn]] void fail_incomplete() {
  throw Error(ErrorKind::usage,
              "distances: found a sparse matrix, expected the distances of all pairs");
}

py::tuple farthest_points(const MetricSpace& space, Index points, double radius,
                          const RunOptions& options) {
  const GreedyLimits limits{points, radius};
  GreedyPermutation order = run(options, false, [&](const RunContext& context) {
    return space.visit(context, [&]<class Data>(const Data& data) -> GreedyPermutation {
      if constexpr (std::same_as<Data, SparseDistances>)
        fail_incomplete();
      else
        return greedy_permutation(data, limits, context);
    });
  });
  std::vector<std::int64_t> indices(order.points.begin(), order.points.end());
  return py::make_tuple(Block::of(std::move(indices)), Block::of(std::move(order.radii)),
                        order.covering_radius);
}

Block measure_distances(const MetricSpace& space, Index neighbours, const RunOptions& options) {
  return Block::of(run(options, false, [&](const RunContext& context) {
    return space.visit(context, [&]<class Data>(const Data& data) -> std::vector<double> {
      if constexpr (std::same_as<Data, SparseDistances>)
        fail_incomplete();
      else
        return distance_to_measure(data, neighbours, context);
    });
  }));
}

Block measure_core_distances(const MetricSpace& space, Index neighbours,
                             const RunOptions& options) {
  return Block::of(run(options, false, [&](const RunContext& context) {
    return space.visit(context, [&]<class Data>(const Data& data) -> std::vector<double> {
      if constexpr (std::same_as<Data, SparseDistances>)
        fail_incomplete();
      else
        return core_distances(data, neighbours, context);
    });
  }));
}

py::tuple image_of_points(const py::buffer& points, double voxel, VoxelValue value, Index margin,
                          const RunOptions& options) {
  const py::buffer_info info = points.request();
  const PointsView view = points_of(info);
  const PointImage made = run(options, false, [&](const RunContext& context) {
    return voxel_image(view, voxel, value, margin, context);
  });
  return py::make_tuple(Block::of(made.image), Block::of(std::vector<double>(made.first)));
}

}  // namespace

void bind_metric_spaces(py::module_& m) {
  py::class_<MetricSpace, std::shared_ptr<MetricSpace>>(m, "MetricSpace")
      .def_static(
          "of_points",
          [](const py::buffer& points, PointDistance distance, double p) {
            return std::make_shared<MetricSpace>(points, distance, p);
          },
          py::arg("points"), py::arg("distance"), py::arg("p"))
      .def_static(
          "of_distances",
          [](const py::buffer& distances, Symmetrise symmetrise, NanPolicy nan,
             bool has_zero_diagonal, bool has_nan_option) {
            return std::make_shared<MetricSpace>(distances, symmetrise, nan, has_zero_diagonal,
                                                 has_nan_option);
          },
          py::arg("distances"), py::arg("symmetrise"), py::arg("nan"), py::arg("has_zero_diagonal"),
          py::arg("has_nan_option") = true)
      .def_static(
          "of_pairs",
          [](Index size, const py::buffer& i, const py::buffer& j, const py::buffer& distances) {
            return std::make_shared<MetricSpace>(size, i, j, distances);
          },
          py::arg("size"), py::arg("i"), py::arg("j"), py::arg("distances"))
      .def_property_readonly("size", &MetricSpace::size)
      .def_property_readonly("is_complete", &MetricSpace::is_complete);
  m.def("farthest_points", &farthest_points, py::arg("space"), py::arg("points"), py::arg("radius"),
        py::arg("run"));
  m.def("distance_to_measure", &measure_distances, py::arg("space"), py::arg("neighbours"),
        py::arg("run"));
  m.def("core_distances", &measure_core_distances, py::arg("space"), py::arg("neighbours"),
        py::arg("run"));
  m.def("point_image", &image_of_points, py::arg("points"), py::arg("voxel"), py::arg("value"),
        py::arg("margin"), py::arg("run"));
}

}  // namespace ph::python
