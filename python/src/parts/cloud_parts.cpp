// SPDX-License-Identifier: MIT
// This file computes and joins parts of a cloud, and computes bars from them. Python passes parts
// as bytes.
#include "ph/parts/cloud_part.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/parts/part_bytes.hpp"
#include "python/src/results/bars.hpp"

namespace ph::python {
namespace {

py::bytes cloud_part(const py::buffer& points, int part, int parts, std::optional<double> threshold,
                     const RunOptions& options) {
  const py::buffer_info array = points.request();
  const PointsView view = points_of(array);
  return to_python(run(options, false, [&](const RunContext& context) {
    return CloudPart(view, part, parts, {.threshold = threshold}, context).bytes();
  }));
}

py::bytes join_cloud_parts(const std::vector<py::bytes>& parts, const RunOptions& options) {
  const auto views = views_of(parts);
  return to_python(run(options, false, [&](const RunContext& context) {
    CloudPart all = CloudPart::of_bytes(views.front(), context);
    for (std::size_t i = 1; i < views.size(); ++i)
      all.join(CloudPart::of_bytes(views[i], context), context);
    return all.bytes();
  }));
}

/// @param cells true if bars have cells, which need more memory.
Bars cloud_part_bars(const py::bytes& bytes, bool cells, const RunOptions& options) {
  const auto view = view_of(bytes);
  return run(options, false, [&](const RunContext& context) {
    CloudPart part = CloudPart::of_bytes(view, context);
    if (!part.is_whole())
      throw Error(ErrorKind::bad_data, fmt::format("parts of a cloud: found {} of {}, expected all",
                                                   part.present().size(), part.parts()));
    BarcodeInfo info = part.info();
    Bars bars{cells ? persistence(std::move(part).rips(context), {.max_dim = 0}, context)
                    : part.barcode(context)};
    bars.barcode.set_info(std::move(info));
    return bars;
  });
}

py::dict cloud_part_facts(const py::bytes& bytes) {
  const CloudPart part = CloudPart::of_bytes(view_of(bytes));
  py::dict facts;
  facts["parts"] = part.parts();
  facts["present"] = py::tuple(py::cast(part.present()));
  facts["points"] = part.points();
  facts["coordinates"] = part.coordinates();
  facts["threshold"] = part.threshold();
  return facts;
}

}  // namespace

void bind_cloud_parts(py::module_& m) {
  m.def("cloud_part", &cloud_part, py::arg("points"), py::arg("part"), py::arg("parts"),
        py::arg("threshold"), py::arg("run"));
  m.def("join_cloud_parts", &join_cloud_parts, py::arg("parts"), py::arg("run"));
  m.def("cloud_part_bars", &cloud_part_bars, py::arg("part"), py::arg("cells"), py::arg("run"));
  m.def("cloud_part_facts", &cloud_part_facts, py::arg("part"));
}

}  // namespace ph::python
