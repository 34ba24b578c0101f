// SPDX-License-Identifier: MIT
// This file makes clouds from arrays, from depth images and from files.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/detail/segment/depth_scene.hpp"
#include "ph/io/cloud.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/scenes/scene.hpp"

namespace ph::python {
namespace {

/// An array of bytes with `channels` bytes per pixel, in C order.
struct Colours {
  const std::uint8_t* data = nullptr;
  int channels = 0;
};
Colours colours_of(const py::buffer_info& array) {
  if (!holds<std::uint8_t>(array) || array.ndim < 2)
    throw Error(ErrorKind::internal, "colours of the wrong type reached _core");
  return {static_cast<const std::uint8_t*>(array.ptr), static_cast<int>(array.shape.back())};
}

/// Adds a field to a cloud from arrays. The cloud gets the fields that the same cloud in a .npy
/// file would have. These are numbers and, if there are colours, red, green and blue.
void add_field(Cloud& cloud, const char* name, FieldType type) {
  cloud.fields.push_back({name, type, 1, cloud.stride});
  cloud.stride += size_of(type);
}

/// @param xyz float64 in C order, as one row of points or as rows and columns of points.
/// @param colours the colour of each point, as bytes; if not given, the cloud has no colours.
/// @param scale units per metre; if not given, the points are in metres.
std::shared_ptr<SceneCloud> cloud_of_points(const py::buffer& xyz,
                                            const std::optional<py::buffer>& colours,
                                            std::optional<double> scale,
                                            const RunOptions& options) {
  const py::buffer_info array = xyz.request();
  if (!holds<double>(array) || array.ndim < 2 || array.shape.back() != 3)
    throw Error(ErrorKind::internal, "points of the wrong type or shape reached _core");
  std::optional<py::buffer_info> colour_array;
  if (colours) colour_array = colours->request();
  const Colours of_points = colour_array ? colours_of(*colour_array) : Colours{};
  auto scene = std::make_shared<SceneCloud>();
  Cloud& cloud = scene->cloud;
  const bool is_organised = array.ndim == 3;
  cloud.width = array.shape[is_organised ? 1 : 0];
  cloud.height = is_organised ? array.shape[0] : 1;
  for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::float64);
  if (of_points.data)
    for (const char* name : {"red", "green", "blue"}) add_field(cloud, name, FieldType::uint8);
  const auto points = static_cast<std::size_t>(cloud.size());
  run_task(options, points < 10'000, [&](const SharedContext& context) {
    context->memory.require(points * cloud.stride);
    cloud.data.resize(points * cloud.stride);
    const auto* from = static_cast<const std::byte*>(array.ptr);
    for (std::size_t i = 0; i < points; ++i) {
      constexpr std::size_t size = 3 * sizeof(double);
      std::byte* record = cloud.data.data() + i * cloud.stride;
      std::memcpy(record, from + i * size, size);
      if (of_points.data)
        std::memcpy(record + size,
                    of_points.data + i * static_cast<std::size_t>(of_points.channels), 3);
    }
    if (scale) cloud.to_metres(*scale);
  });
  return scene;
}

Cloud cloud_of(const DepthImage& depth, const std::optional<Raster>& colour,
               std::optional<double> scale, SceneCloud& scene) {
  return segment::cloud_of_depth(depth, colour, scene.camera->camera, scene.camera->calibration,
                                 scale, note_into(scene.notes, scene.guesses));
}

/// @param image an array of two axes in C order, with one of the voxel types.
/// @param usual the scale of such arrays, which is used if neither `scale` nor the camera gives
/// one.
std::shared_ptr<SceneCloud> cloud_of_depth(const py::buffer& image,
                                           const std::optional<py::buffer>& colours,
                                           std::shared_ptr<NamedCamera> camera, double usual,
                                           std::optional<double> scale, const RunOptions& options) {
  const py::buffer_info array = image.request();
  std::optional<py::buffer_info> colour_array;
  if (colours) colour_array = colours->request();
  auto scene = std::make_shared<SceneCloud>();
  scene->notes = camera->notes;
  scene->camera = std::move(camera);
  run_task(options, false, [&](const SharedContext& context) {
    const auto pixels = static_cast<std::size_t>(array.size);
    context->memory.require(pixels * 4 * sizeof(float));
    const std::vector<Index> extents(array.shape.begin(), array.shape.end());
    const DepthImage depth{
        {extents, Voxels(BorrowedVoxels{voxel_type_of(array), array.ptr, pixels})}, usual};
    std::optional<Raster> colour;
    if (colour_array) {
      const Colours of_pixels = colours_of(*colour_array);
      colour = Raster{extents[1], extents[0], of_pixels.channels, 8, {}};
      const auto samples = static_cast<std::size_t>(colour_array->size);
      context->memory.require(samples * sizeof(std::uint16_t));
      colour->samples.assign(of_pixels.data, of_pixels.data + samples);
    }
    scene->cloud = cloud_of(depth, colour, scale, *scene);
  });
  return scene;
}

/// @param colour_path empty if there are no colours. @param scale if not given, guessed from the
/// image.
std::shared_ptr<SceneCloud> read_depth(const std::string& path, const std::string& colour_path,
                                       std::shared_ptr<NamedCamera> camera,
                                       std::optional<double> scale, const RunOptions& options) {
  auto scene = std::make_shared<SceneCloud>();
  scene->notes = camera->notes;
  scene->camera = std::move(camera);
  run_task(options, false, [&](const SharedContext& context) {
    const Input input = Input::open(std::filesystem::path(path), context.get(),
                                    Input::Excess::refused, depth_start_check());
    const DepthImage depth = ph::read_depth(input, {.context = context.get()});
    std::optional<Raster> colour;
    if (!colour_path.empty()) colour = read_png(std::filesystem::path(colour_path), context.get());
    scene->cloud = cloud_of(depth, colour, scale, *scene);
  });
  return scene;
}

std::shared_ptr<NamedCamera> camera_of_name(const std::string& name) {
  auto camera = std::make_shared<NamedCamera>();
  const auto known = segment::camera_named(name, note_into(camera->notes));
  if (!known) return nullptr;
  camera->camera = *known;
  camera->calibration = name;
  return camera;
}

std::shared_ptr<NamedCamera> read_camera(const std::string& path, const RunOptions& options) {
  auto camera = std::make_shared<NamedCamera>();
  camera->calibration = path;
  run_task(options, false, [&](const SharedContext& context) {
    camera->camera = segment::calibrated_camera(path, note_into(camera->notes), *context);
  });
  return camera;
}

std::vector<std::string> camera_names() {
  std::vector<std::string> names;
  for (const CameraPreset& preset : camera_presets()) names.emplace_back(preset.name);
  return names;
}

}  // namespace

void bind_clouds(py::module_& m) {
  py::class_<NamedCamera, std::shared_ptr<NamedCamera>>(m, "Camera")
      .def(py::init([](double fx, double fy, double cx, double cy) {
             return std::make_shared<NamedCamera>(NamedCamera{{{fx, fy, cx, cy}}, {}});
           }),
           py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"));
  m.def("camera_names", &camera_names);
  m.def("camera_named", &camera_of_name, py::arg("name"));
  m.def("read_camera", &read_camera, py::arg("path"), py::arg("run"));
  py::class_<SceneCloud, std::shared_ptr<SceneCloud>>(m, "Cloud")
      .def_readonly("notes", &SceneCloud::notes)
      .def_readonly("guesses", &SceneCloud::guesses);
  m.def("cloud_of_points", &cloud_of_points, py::arg("xyz"), py::arg("colours"), py::arg("scale"),
        py::arg("run"));
  m.def("cloud_of_depth", &cloud_of_depth, py::arg("image"), py::arg("colours"), py::arg("camera"),
        py::arg("usual"), py::arg("scale"), py::arg("run"));
  m.def("read_depth", &read_depth, py::arg("path"), py::arg("colour_path"), py::arg("camera"),
        py::arg("scale"), py::arg("run"));
}

}  // namespace ph::python
