// SPDX-License-Identifier: MIT
// This file defines the module libph._core. Its functions take buffers and plain numbers, and
// return blocks that own their data. The Python modules around it handle shapes, names, words and
// defaults.
#include "python/src/calls/bindings.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace ph::python;
  m.doc() = "The C++ part of libph. Use the functions of the package libph instead.";
  m.attr("version") = PH_VERSION;
  bind_errors(m);
  bind_run(m);
  bind_arrays(m);
  bind_metric_spaces(m);
  bind_flags(m);
  bind_bars(m);
  bind_layouts(m);
  bind_complexes(m);
  bind_alpha(m);
  bind_computations(m);
  bind_image_loops(m);
  bind_image_parts(m);
  bind_cloud_parts(m);
  bind_distances(m);
  bind_significance(m);
  bind_vectors(m);
  bind_kernels(m);
  bind_euler_curves(m);
  bind_merge_trees(m);
  bind_clusters(m);
  bind_files(m);
  bind_clouds(m);
  bind_segmentations(m);
  bind_reports(m);
}
