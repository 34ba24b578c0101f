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
  take("program", info.program);
  take("input", info.input);
  take("input_description", info.input_description);
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
  const auto take_if_known = [&](const char* name, std::optional<double>& value) {
    if (meta.contains(name) && !meta[name].is_none()) value = meta[name].cast<double>();
  };
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
  return info;
}

py::dict meta_of(const BarcodeInfo& info) {
  py::dict meta;
  const auto put = [&](const char* name, const auto& value) { meta[name] = value; };
  put("complex", info.complex);
  put("field", info.field);
  put("max_dim", info.max_dim);
  put("threshold", info.threshold);
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
    put("covering_radius", info.subsample->covering_radius);
  }
  if (info.alpha) {
    put("squared", info.alpha->squared);
    if (!info.alpha->period.empty()) put("period", py::tuple(py::cast(info.alpha->period)));
    if (!info.alpha->hidden.empty()) put("hidden", py::tuple(py::cast(info.alpha->hidden)));
  }
  return meta;
}

}  // namespace ph::python
