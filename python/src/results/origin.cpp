// SPDX-License-Identifier: MIT
#include "python/src/results/origin.hpp"

#include <cstdlib>
#include <optional>
#include <string>

#include "ph/rips.hpp"

namespace ph::python {
namespace {

constexpr const char* kMinkowski = "minkowski";

}  // namespace

BarcodeInfo info_of(const py::dict& meta) {
  const auto take = [&]<class T>(const char* name, T& value) {
    if (meta.contains(name) && !meta[name].is_none()) value = meta[name].cast<T>();
  };
  BarcodeInfo info;
  const auto take_if_known = [&]<class T>(const char* name, std::optional<T>& value) {
    if (meta.contains(name) && !meta[name].is_none()) value = meta[name].cast<T>();
  };
  take("program", info.program);
  take("input", info.input);
  take("input_description", info.input_description);
  take("shape", info.shape);
  take("dims", info.dims);
  take_if_known("affine", info.affine);
  info.nan_dropped = meta.contains("nan");
  take("collapsed", info.collapsed);
  take("complex", info.complex);
  take("field", info.field);
  take("max_dim", info.max_dim);
  take("metric", info.metric);
  if (info.metric == kMinkowski && meta.contains("minkowski_p"))
    info.metric = metric_name(PointDistance::minkowski, meta["minkowski_p"].cast<double>());
  take("construction", info.construction);
  take("periodic", info.periodic);
  take("vertex_weights", info.vertex_weights);
  take("superlevel", info.superlevel);
  take("min_dim", info.min_dim);
  take("engine", info.engine);
  take_if_known("points", info.points);
  take_if_known("coordinates", info.coordinates);
  take_if_known("vertices", info.vertices);
  take_if_known("edges", info.edges);
  take_if_known("threshold", info.threshold);
  take_if_known("approximation", info.approximation);
  take_if_known("min_persistence", info.min_persistence);
  if (meta.contains("covering_radius") && !meta["covering_radius"].is_none()) {
    info.subsample.emplace();
    take("vertices", info.subsample->points);
    take("points", info.subsample->of);
    take("covering_radius", info.subsample->covering_radius);
  }
  if (meta.contains("squared")) {
    info.alpha.emplace();
    take("squared", info.alpha->squared);
    take("period", info.alpha->period);
    take("hidden", info.alpha->hidden);
  }
  if (meta.contains("voxel")) {
    info.voxels.emplace();
    take("voxel", info.voxels->voxel);
    take("first", info.voxels->first);
    take("voxel_value", info.voxels->value);
  }
  take("timings", info.timings);
  take("peak_memory", info.peak_memory);
  return info;
}

py::dict meta_of(const BarcodeInfo& info) {
  py::dict meta;
  const auto put = [&](const char* name, const auto& value) { meta[name] = value; };
  // Python states the program by its version alone, if the program is the package.
  const std::size_t space = info.program.rfind(' ');
  if (space != std::string::npos) put("version", info.program.substr(space + 1));
  if (!info.program.starts_with("libph ")) put("program", info.program);
  put("input", info.input);
  put("points", info.points);
  put("coordinates", info.coordinates);
  if (!info.shape.empty()) put("shape", py::tuple(py::cast(info.shape)));
  if (info.affine) {
    const auto& [x, y, z] = *info.affine;
    put("affine",
        py::make_tuple(py::tuple(py::cast(x)), py::tuple(py::cast(y)), py::tuple(py::cast(z))));
  }
  if (info.nan_dropped) put("nan", "drop");
  if (!info.dims.empty()) put("dims", py::tuple(py::cast(info.dims)));
  put("complex", info.complex);
  put("field", info.field);
  put("max_dim", info.max_dim);
  put("threshold", info.threshold);
  put("vertices", info.vertices);
  put("edges", info.edges);
  if (info.collapsed) put("collapsed", true);
  if (const std::string start = std::string(kMinkowski) + ":"; info.metric.starts_with(start)) {
    put("metric", kMinkowski);
    put("minkowski_p", std::strtod(info.metric.c_str() + start.size(), nullptr));
  } else {
    put("metric", info.metric);
  }
  put("construction", info.construction);
  if (!info.construction.empty()) put("periodic", py::tuple(py::cast(info.periodic)));
  if (!info.construction.empty() || info.superlevel) put("superlevel", info.superlevel);
  put("vertex_weights", info.vertex_weights);
  put("approximation", info.approximation);
  put("min_persistence", info.min_persistence);
  if (info.min_dim > 0) put("min_dim", info.min_dim);
  put("engine", info.engine);
  put("input_description", info.input_description);
  if (info.subsample) {
    put("vertices", info.subsample->points);
    put("points", info.subsample->of);
    put("subsample", info.subsample->points);
    put("covering_radius", info.subsample->covering_radius);
  }
  if (info.alpha) {
    put("squared", info.alpha->squared);
    if (!info.alpha->period.empty()) put("period", py::tuple(py::cast(info.alpha->period)));
    if (!info.alpha->hidden.empty()) put("hidden", py::tuple(py::cast(info.alpha->hidden)));
  }
  if (info.voxels) {
    put("voxel", info.voxels->voxel);
    put("first", py::tuple(py::cast(info.voxels->first)));
    put("voxel_value", info.voxels->value);
  }
  if (!info.timings.empty()) put("timings", py::tuple(py::cast(info.timings)));
  if (info.peak_memory > 0) put("peak_memory", info.peak_memory);
  return meta;
}

}  // namespace ph::python
