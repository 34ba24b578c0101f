// SPDX-License-Identifier: MIT
// This file computes segmentations of clouds, cuts them again, and stores them.
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/io/output_file.hpp"
#include "ph/detail/segment/cloud_files.hpp"
#include "ph/detail/segment/cloud_legend.hpp"
#include "ph/detail/segment/colouring.hpp"
#include "ph/detail/segment/label_files.hpp"
#include "ph/detail/segment/notes.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/plot.hpp"
#include "ph/label_tracker.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/results/bars.hpp"
#include "python/src/scenes/scene.hpp"
#include "python/src/scenes/scene_state.hpp"

namespace ph::python {
namespace {

using segment::SegmentOptions, segment::Vec3;

constexpr std::size_t kFewPoints = 2000;

SegmentedScene segment_cloud(std::shared_ptr<SceneCloud> cloud, const SegmentOptions& given,
                             const RunOptions& options) {
  SegmentedScene scene{std::move(cloud)};
  const auto points = static_cast<std::size_t>(scene.cloud()->size());
  run_task(options, points < kFewPoints, [&](const SharedContext& context) {
    scene.result = segment::segment(*scene.cloud(), given, *context);
    if (!scene.result.difference.empty())
      throw Error(ErrorKind::internal, "check: " + scene.result.difference);
    const NamedCamera* camera = scene.input->camera.get();
    std::optional<segment::DepthSource> depth;
    if (camera)
      depth.emplace(segment::DepthSource{
          camera->camera, camera->calibration.empty() ? Setting::intrinsics : Setting::camera});
    const segment::Note keep = note_into(scene.notes);
    for (const Message& note :
         segment::notes(scene.result, given, scene.cloud(), depth ? &*depth : nullptr))
      keep(note);
  });
  return scene;
}

/// Reads a cloud, or a stored tree of a cloud.
/// @param scale units per metre of the cloud; if not given, it is in metres.
py::object read_scene(const std::string& path, std::optional<double> scale,
                      const RunOptions& options) {
  std::shared_ptr<SceneCloud> cloud;
  std::optional<SegmentedScene> stored;
  run_task(options, false, [&](const SharedContext& context) {
    const Input input = Input::open(std::filesystem::path(path), context.get(),
                                    Input::Excess::refused, [](const Input& start) {
                                      if (!segment::is_tree(start)) cloud_start_check()(start);
                                    });
    if (!segment::is_tree(input)) {
      cloud = std::make_shared<SceneCloud>();
      ReadOptions how;
      how.context = context.get();
      how.allow_empty = true;
      how.note = note_into(cloud->notes);
      cloud->cloud = ph::read_cloud(input, how);
      if (scale) cloud->cloud.to_metres(*scale);
      return;
    }
    if (scale)
      throw Error(ErrorKind::usage,
                  mark(Setting::depth_scale) + ": does nothing for a stored tree");
    stored.emplace().result = segmentation_of_tree(input, *context);
  });
  return stored ? py::cast(std::move(*stored)) : py::cast(std::move(cloud));
}

/// Cuts the tree again. Values that are not given do not change.
SegmentedScene cut(const SegmentedScene& scene, std::optional<double> value,
                   std::optional<Index> min_part, std::optional<Index> min_size,
                   std::optional<bool> objects, const RunOptions& options) {
  const segment::CutOptions& old = scene.result.tree.first_cut;
  const segment::CutOptions asked{value.value_or(old.value), min_part.value_or(old.min_part),
                                  min_size.value_or(old.min_size), objects.value_or(old.objects)};
  SegmentedScene other{scene.input};
  run_task(options, scene.result.tree.points.size() < kFewPoints,
           [&](const SharedContext& context) {
             segment::SceneCut found = segment::cut(scene.result.tree, asked, *context);
             other.result = scene.result;
             other.result.cut = std::move(found);
             other.result.tree.first_cut = asked;
           });
  return other;
}

// ---- results, as arrays and plain values

std::vector<py::ssize_t> raster_of(const segment::SceneTree& scene) {
  if (scene.height > 1) return {scene.height, scene.width};
  return {static_cast<py::ssize_t>(scene.cloud_size())};
}

Block labels(const SegmentedScene& scene) {
  return Block::of(scene.result.cut.labels, raster_of(scene.result.tree));
}

Block voxel_of_point(const SegmentedScene& scene) {
  const segment::SceneTree& tree = scene.result.tree;
  std::vector<std::int64_t> voxels(tree.cloud_size(), -1);
  for (std::size_t k = 0; k < tree.points.size(); ++k)
    voxels[static_cast<std::size_t>(tree.points[k])] = tree.vertex_of_point[k];
  return Block::of(std::move(voxels), raster_of(tree));
}

std::map<std::string, py::object> segment_of(const segment::Segment& s) {
  std::vector<std::pair<std::uint32_t, double>> neighbours;
  for (const segment::Neighbour& n : s.neighbours) neighbours.emplace_back(n.label, n.meets_at);
  return {{"label", py::cast(s.label)},
          {"points", py::cast(s.points)},
          {"voxels", py::cast(s.voxels)},
          {"persistence", py::cast(s.persistence)},
          {"neighbour", py::cast(s.neighbour)},
          {"meets_at", py::cast(s.meets_at)},
          {"centroid", py::cast(s.centroid)},
          {"box", py::cast(std::array{s.box.min, s.box.max})},
          {"centre", py::cast(s.oriented_box.centre)},
          {"axes", py::cast(s.oriented_box.axes)},
          {"size", py::cast(s.oriented_box.size)},
          {"role", py::cast(std::string(role_name(s.role)))},
          {"on", py::cast(std::array{s.on.surface, s.on.segment})},
          {"neighbours", py::cast(neighbours)}};
}

std::vector<std::map<std::string, py::object>> segments(const SegmentedScene& scene) {
  std::vector<std::map<std::string, py::object>> all;
  for (const segment::Segment& s : scene.result.cut.segments) all.push_back(segment_of(s));
  return all;
}

/// For each surface, its role, its plane a x + b y + c z + d = 0, and the centre, the axes and the
/// size of its box.
std::vector<py::tuple> surfaces(const SegmentedScene& scene) {
  std::vector<py::tuple> all;
  for (const segment::SceneSurface& s : scene.result.tree.surfaces) {
    const auto& [a, b, c] = s.plane.normal;
    const segment::OrientedBox& box = s.oriented_box;
    const auto row = [](const segment::Vec3& v) { return py::make_tuple(v[0], v[1], v[2]); };
    all.push_back(py::make_tuple(
        std::string(segment::role_name(s.role)), py::make_tuple(a, b, c, s.plane.offset),
        row(box.centre), py::make_tuple(row(box.axes[0]), row(box.axes[1]), row(box.axes[2])),
        row(box.size)));
  }
  return all;
}

py::dict facts(const SegmentedScene& scene) {
  const segment::Segmentation& s = scene.result;
  py::dict meta;
  meta["method"] = std::string(segment::kMethodNames[static_cast<std::size_t>(s.tree.method)]);
  meta["voxel"] = s.tree.voxel;
  if (s.tree.method == segment::Method::paper) {
    meta["distance"] = s.tree.distance;
    meta["steps"] = s.tree.steps == 0 ? py::cast("exact") : py::cast(s.tree.steps);
  }
  meta["voxels"] = s.tree.vertices.rows();
  meta["edges"] = s.tree.edges;
  meta["viewpoint"] = py::tuple(py::cast(s.tree.viewpoint));
  if (s.tree.plane) {
    meta["plane"] = py::make_tuple(s.tree.plane->normal[0], s.tree.plane->normal[1],
                                   s.tree.plane->normal[2], s.tree.plane->offset);
    meta["plane_share"] = s.tree.plane->share;
  } else {
    meta["plane_note"] = s.plane_note;
  }
  py::list noise;
  for (const segment::NoiseAt& n : s.tree.noise) noise.append(py::make_tuple(n.range, n.concavity));
  meta["noise"] = py::tuple(noise);
  meta["cut"] = s.tree.first_cut.value;
  if (s.tree.method != segment::Method::paper) meta["min_part"] = s.tree.first_cut.min_part;
  meta["min_size"] = s.tree.first_cut.min_size;
  if (s.tree.method == segment::Method::surface) {
    meta["objects"] = s.tree.first_cut.objects;
  }
  meta["checked"] = s.checked;
  return meta;
}

Bars barcode(const SegmentedScene& scene) {
  Bars bars{scene.result.barcode};
  BarcodeInfo info;
  info.engine = "union-find";
  bars.barcode.set_info(std::move(info));
  return bars;
}

Bars signature(const SegmentedScene& scene, const std::vector<std::uint32_t>& labels,
               const RunOptions& options) {
  Bars bars = run(options, false, [&](const RunContext& context) {
    return Bars{segment::signature(scene.result.tree, scene.result.cut, labels, context)};
  });
  bars.set_max_dim(2);
  return bars;
}

std::optional<std::pair<double, Vec3>> first_meeting(const SegmentedScene& scene, std::uint32_t a,
                                                     std::uint32_t b) {
  const auto meeting = segment::first_meeting(scene.result, a, b);
  if (!meeting) return std::nullopt;
  return std::pair(meeting->value, meeting->at);
}

// ---- files and pictures

std::string file_of(const SegmentedScene& scene, const std::string& format) {
  const segment::Segmentation& s = scene.result;
  const auto labels_as = [&](segment::LabelFormat how) {
    return segment::label_bytes(s.tree, s.cut.labels, how);
  };
  if (format == "npy") return labels_as(segment::LabelFormat::npy);
  if (format == "png") return labels_as(segment::LabelFormat::png);
  if (format == "csv") return labels_as(segment::LabelFormat::csv);
  if (format == "tree") return segment::tree_bytes(s.tree);
  if (format == "json") return segment::tree_json(s.tree);
  if (!scene.cloud() || (format != "pcd" && format != "ply"))
    throw Error(ErrorKind::internal, "an unknown format reached _core");
  return segment::cloud_bytes(
      segment::with_labels(*scene.cloud(), s.cut.labels),
      format == "pcd" ? segment::CloudFormat::pcd : segment::CloudFormat::ply);
}

void save(const SegmentedScene& scene, const std::string& path, const std::string& format,
          const RunOptions& options) {
  run_task(options, false, [&](const SharedContext&) {
    OutputFile file(path);
    file.write(file_of(scene, format));
    file.commit();
  });
}

std::string svg(const SegmentedScene& scene, const RunOptions& options) {
  return run(options, false, [&](const RunContext& context) {
    const segment::Segmentation& s = scene.result;
    const Cloud* cloud = scene.cloud();
    const std::vector<std::uint32_t> colours =
        cloud ? segment::segment_colours(segment::neighbouring_segments(*cloud, s.cut))
              : segment::label_colours(s.cut);
    return svg_plot(segment::with_legend(
        segment::cloud_picture(cloud, s.tree, s.cut.labels, colours, {}, context), colours, {}));
  });
}

// ---- several frames

using Tracked = std::tuple<std::uint32_t, std::string, std::array<std::uint32_t, 2>>;

/// The number, the role and the support (a surface or a segment) of each object.
std::vector<Tracked> track(segment::LabelTracker& tracker, const SegmentedScene& scene) {
  const std::vector<std::uint32_t> numbers = tracker.update(scene.result.tree, scene.result.cut);
  std::vector<Tracked> objects;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const segment::Standing& standing = tracker.standings()[i];
    objects.emplace_back(numbers[i], std::string(role_name(standing.role)),
                         std::array{standing.on.surface, standing.on.segment});
  }
  return objects;
}

/// @param labels uint32, in C order, as a flat array.
Block track_labels(segment::LabelTracker& tracker, const py::buffer& labels) {
  return Block::of(tracker.update(vector_of<std::uint32_t>(labels)));
}

}  // namespace

void bind_segmentations(py::module_& m) {
  py::class_<SegmentOptions>(m, "SegmentOptions")
      .def(py::init([](const std::string& method, std::optional<double> voxel,
                       std::optional<Index> min_size, double max_range,
                       const std::optional<std::array<Vec3, 2>>& crop, bool plane,
                       std::optional<Index> most_supports, std::optional<double> plane_distance,
                       double plane_noise, const std::optional<std::array<double, 5>>& plane_guess,
                       std::optional<Vec3> viewpoint, bool check,
                       std::optional<double> min_persistence, bool objects,
                       std::optional<Index> min_part, double spacing, double distance, int steps) {
             SegmentOptions o;
             const auto named = std::ranges::find(segment::kMethodNames, method);
             if (named == segment::kMethodNames.end())
               throw Error(ErrorKind::internal, "an unknown method reached _core");
             o.method = static_cast<segment::Method>(named - segment::kMethodNames.begin());
             o.voxel = voxel;
             o.min_size = min_size;
             o.max_range = max_range;
             if (crop) o.crop = segment::Box{(*crop)[0], (*crop)[1]};
             o.plane = plane;
             o.most_supports = most_supports.value_or(o.most_supports);
             o.plane_distance = plane_distance;
             o.plane_noise = plane_noise;
             if (plane_guess) {
               const auto& [a, b, c, d, share] = *plane_guess;
               o.plane_guess = segment::Plane{{a, b, c}, d, share};
             }
             o.viewpoint = viewpoint;
             o.check = check;
             o.min_persistence = min_persistence;
             o.objects = objects;
             o.min_part = min_part;
             o.spacing = spacing;
             o.distance = distance;
             o.steps = steps;
             return o;
           }),
           py::kw_only(), py::arg("method"), py::arg("voxel"), py::arg("min_size"),
           py::arg("max_range"), py::arg("crop"), py::arg("plane"), py::arg("most_supports"),
           py::arg("plane_distance"), py::arg("plane_noise"), py::arg("plane_guess"),
           py::arg("viewpoint"), py::arg("check"), py::arg("min_persistence"), py::arg("objects"),
           py::arg("min_part"), py::arg("spacing"), py::arg("distance"), py::arg("steps"));
  py::class_<SegmentedScene>(m, "Segmentation")
      .def_property_readonly("has_cloud",
                             [](const SegmentedScene& s) { return s.cloud() != nullptr; })
      .def_property_readonly(
          "points", [](const SegmentedScene& s) { return Block::of(points_of(*s.cloud())); })
      .def_readonly("notes", &SegmentedScene::notes)
      .def_property_readonly("facts", &facts)
      .def_property_readonly("labels", &labels)
      .def_property_readonly("voxel_of_point", &voxel_of_point)
      .def_property_readonly(
          "centroids",
          [](const SegmentedScene& s) { return Block::of(Points(s.result.tree.vertices)); })
      .def_property_readonly(
          "normals",
          [](const SegmentedScene& s) { return Block::of(Points(s.result.tree.normals)); })
      .def_property_readonly("counts",
                             [](const SegmentedScene& s) {
                               return Block::of(std::vector<std::int64_t>(s.result.tree.counts));
                             })
      .def_property_readonly("voxel_labels",
                             [](const SegmentedScene& s) {
                               return Block::of(std::vector(s.result.cut.vertex_labels));
                             })
      .def_property_readonly("surfaces", &surfaces)
      .def_property_readonly("surface_labels",
                             [](const SegmentedScene& s) {
                               return Block::of(s.result.cut.surface_labels,
                                                raster_of(s.result.tree));
                             })
      .def_property_readonly("segments", &segments)
      .def_property_readonly("tree",
                             [](const SegmentedScene& s) { return s.result.tree.merge_tree; })
      .def_property_readonly("barcode", &barcode)
      .def("cut", &cut, py::arg("value"), py::arg("min_part"), py::arg("min_size"),
           py::arg("objects"), py::arg("run"))
      .def("signature", &signature, py::arg("labels"), py::arg("run"))
      .def("first_meeting", &first_meeting, py::arg("a"), py::arg("b"))
      .def("save", &save, py::arg("path"), py::arg("format"), py::arg("run"))
      .def("svg", &svg, py::arg("run"))
      .def("tree_file", &tree_file)
      .def("state", [](const SegmentedScene& s) { return state_of(s); })
      .def_static("from_state", &scene_of_state, py::arg("state"), py::arg("run"));
  py::class_<segment::LabelTracker>(m, "LabelTracker")
      .def(py::init<int, double>(), py::arg("patience"), py::arg("cell"))
      .def("update", &track, py::arg("scene"))
      .def("update_labels", &track_labels, py::arg("labels"));
  m.def("segment", &segment_cloud, py::arg("cloud"), py::arg("options"), py::arg("run"));
  m.def("read_scene", &read_scene, py::arg("path"), py::arg("scale"), py::arg("run"));
}

}  // namespace ph::python
