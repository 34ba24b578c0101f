// SPDX-License-Identifier: MIT
#include "results/origin.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace ph::python {

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
  take("vertex_weights", info.vertex_weights);
  take("superlevel", info.superlevel);
  take("engine", info.engine);
  double number = std::numeric_limits<double>::quiet_NaN();
  take("threshold", number);
  if (!std::isnan(number)) info.threshold = number;
  number = std::numeric_limits<double>::quiet_NaN();
  take("approximation", number);
  if (!std::isnan(number)) info.approximation = number;
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
  put("vertex_weights", info.vertex_weights);
  put("superlevel", info.superlevel);
  put("approximation", info.approximation);
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
