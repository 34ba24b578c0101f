// SPDX-License-Identifier: MIT
#include "python/src/alpha.hpp"

#include <string>
#include <utility>

#include "ph/error.hpp"
#include "ph/io/write.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {

Alpha AlphaRecipe::alpha(const RunContext& context) const {
  return Alpha(space_->point_set()->points, options_, context);
}

Built AlphaRecipe::build(const RunContext& context) const { return {alpha(context)}; }

bool AlphaRecipe::is_short(const Options& task) const {
  constexpr Index few = 200;
  return task.engine == Engine::automatic && space_->size() <= few;
}

namespace {

std::unique_ptr<AlphaRecipe> recipe_of(std::shared_ptr<MetricSpace> space,
                                       AlphaOptions::Value value, bool squared,
                                       const std::optional<py::buffer>& weights,
                                       std::vector<double> period, double threshold,
                                       const std::optional<py::buffer>& ids) {
  AlphaOptions options;
  options.value = value;
  options.unit = squared ? AlphaOptions::Unit::squared : AlphaOptions::Unit::radius;
  if (weights) options.weights = vector_of<double>(*weights);
  options.period = std::move(period);
  options.threshold = threshold;
  return std::make_unique<AlphaRecipe>(std::move(space), std::move(options),
                                       ids ? vector_of<Index>(*ids) : std::vector<Index>());
}

/// The corners of the triangles, three per triangle, and the number of regular triangles.
py::tuple surface_of(const AlphaRecipe& recipe, double value, bool is_wrap,
                     const RunOptions& options) {
  SurfaceMesh mesh = run(options, false, [&](const RunContext& context) {
    const Alpha alpha = recipe.alpha(context);
    return is_wrap ? wrap(alpha, value, context) : alpha_shape(alpha, value);
  });
  const std::vector<Index>& ids = recipe.vertex_ids();
  std::vector<std::int64_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (const Index v : triangle)
      corners.push_back(ids.empty() ? v : ids[static_cast<std::size_t>(v)]);
  return py::make_tuple(Block::of(std::move(corners)), mesh.regular);
}

void write_surface_file(const std::string& path, const py::buffer& points, Index columns,
                        const py::buffer& corners, std::size_t regular, const RunOptions& options) {
  const std::vector<double> numbers = vector_of<double>(points);
  const std::vector<std::int64_t> all = vector_of<std::int64_t>(corners);
  SurfaceMesh mesh;
  for (std::size_t i = 0; i + 2 < all.size(); i += 3)
    mesh.triangles.push_back({all[i], all[i + 1], all[i + 2]});
  mesh.regular = regular;
  run(options, false, [&](const RunContext&) {
    OutputFile file(path);
    write_surface(file,
                  PointsView(numbers.data(), static_cast<Index>(numbers.size()) / columns, columns),
                  mesh, surface_format_of_path(path).value_or(SurfaceFormat::ply));
    file.commit();
    return 0;
  });
}

}  // namespace

void bind_alpha(py::module_& m) {
  py::class_<AlphaRecipe, Recipe>(m, "AlphaRecipe")
      .def(py::init(&recipe_of), py::arg("space"), py::arg("value"), py::arg("squared"),
           py::arg("weights"), py::arg("period"), py::arg("threshold"), py::arg("ids"));
  m.def("alpha_support", &alpha_support);
  m.def("surface", &surface_of, py::arg("recipe"), py::arg("value"), py::arg("is_wrap"),
        py::arg("run"));
  m.def("write_surface", &write_surface_file, py::arg("path"), py::arg("points"),
        py::arg("columns"), py::arg("corners"), py::arg("regular"), py::arg("run"));
}

}  // namespace ph::python
