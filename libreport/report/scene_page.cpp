// SPDX-License-Identifier: MIT
#include "ph/scene_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "libreport/report/arrays/point_arrays.hpp"
#include "libreport/report/arrays/tree_arrays.hpp"
#include "ph/detail/report/bar_arrays.hpp"
#include "ph/detail/report/report_file.hpp"
#include "ph/detail/segment/bounds.hpp"
#include "ph/detail/segment/colouring.hpp"

namespace ph::report {
namespace {

using segment::Method, segment::SceneTree, segment::Segmentation;

// The largest error of stored positions is the edge of a voxel divided by this number.
constexpr double kStepsAVoxel = 8;

/// The points that are shown, which are all points of a cloud except its holes.
struct ShownPoints {
  std::vector<std::uint32_t> index;  ///< the index in the cloud
  /// The vertex of the tree; kNone if there is none.
  std::vector<std::uint32_t> vertex;
  std::vector<float> xyz;
};

ShownPoints shown_points(const Cloud* cloud, const SceneTree& scene) {
  const std::vector<float> all = cloud ? cloud->xyz() : std::vector<float>();
  const std::size_t count = cloud ? all.size() / 3 : scene.points.size();
  ShownPoints shown;
  std::size_t next = 0;  // the index among the points that have a vertex
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = cloud ? k : static_cast<std::size_t>(scene.points[k]);
    const bool has_vertex = next < scene.points.size() && std::cmp_equal(scene.points[next], i);
    const float* at = cloud ? &all[3 * i] : &scene.xyz[3 * k];
    const std::uint32_t vertex = has_vertex ? scene.vertex_of_point[next++] : kNone;
    if (!(std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]))) continue;
    shown.index.push_back(static_cast<std::uint32_t>(i));
    shown.vertex.push_back(vertex);
    shown.xyz.insert(shown.xyz.end(), at, at + 3);
  }
  return shown;
}

template <class T>
std::uint32_t read_as(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  if constexpr (std::is_signed_v<T>)
    if (value < 0) return 0;
  return static_cast<std::uint32_t>(value);
}

/// The ground truth of the points that are shown. Empty if the cloud has no integer field named
/// label.
std::vector<std::uint32_t> truth_of(const Cloud& cloud, const ShownPoints& points) {
  const CloudField* field = cloud.find("label");
  if (!field || field->count != 1) return {};
  std::uint32_t (*read)(const std::byte*) = nullptr;
  switch (field->type) {
    case FieldType::uint8:
      read = read_as<std::uint8_t>;
      break;
    case FieldType::uint16:
      read = read_as<std::uint16_t>;
      break;
    case FieldType::uint32:
      read = read_as<std::uint32_t>;
      break;
    case FieldType::int32:
      read = read_as<std::int32_t>;
      break;
    default:
      return {};
  }
  std::vector<std::uint32_t> truth;
  for (const std::uint32_t i : points.index) {
    truth.push_back(read(cloud.data.data() + i * cloud.stride + field->offset));
    if (truth.back() >= UINT16_MAX) return {};  // a page has 16 bits for labels
  }
  return truth;
}

void add_points(ReportFile& report, const Cloud* cloud, const Segmentation& s,
                const ShownPoints& points, std::span<const std::uint32_t> leaves) {
  add_positions(report, std::span<const float>(points.xyz), 3, s.tree.voxel / kStepsAVoxel);
  if (points.index.size() != s.tree.cloud_size())
    report.add("points/index", points.index, {.delta = true});
  add_labels(report, "points/leaf", leaves, true);
  if (cloud && s.tree.removed > 0) {
    std::vector<std::uint8_t> surfaces;
    for (const std::uint32_t i : points.index) surfaces.push_back(s.tree.removed_with[i]);
    report.add("points/surface", surfaces, {.delta = true});
  }
  if (s.tree.normals.rows() > 0) {
    std::vector<std::int8_t> normals;
    for (const std::uint32_t v : points.vertex) {
      const double none = std::nan("");
      const auto stored =
          v == kNone ? octahedral(none, none, none)
                     : octahedral(s.tree.normals(v, 0), s.tree.normals(v, 1), s.tree.normals(v, 2));
      normals.insert(normals.end(), stored.begin(), stored.end());
    }
    report.add("points/normal", normals, {.shape = {points.index.size(), 2}, .delta = true});
  }
  if (!cloud) return;
  if (const auto colours = cloud->rgb()) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint32_t i : points.index)
      for (const int shift : {16, 8, 0})
        rgb.push_back(static_cast<std::uint8_t>((*colours)[i] >> shift));
    report.add("points/rgb", rgb, {.shape = {points.index.size(), 3}, .delta = true});
  }
  if (const auto truth = truth_of(*cloud, points); !truth.empty())
    add_labels(report, "points/truth", truth, false);
}

/// The bars of positive length, in the order of the barcode file. Because the page shows no voxels,
/// each vertex of a cell is replaced by a point of its voxel.
Barcode bars_of(const Segmentation& s) {
  std::vector<Index> point(s.tree.cells.size(), -1);
  for (std::size_t k = 0; k < s.tree.points.size(); ++k) {
    Index& first = point[s.tree.vertex_of_point[k]];
    if (first < 0) first = s.tree.points[k];
  }
  Barcode bars(CellKind::vertices);
  for (std::size_t i = 0; i < s.barcode.size(); ++i) {
    if (!(s.barcode[i].persistence() > 0)) continue;
    std::vector<Index> birth, death;
    for (const Index v : s.barcode.birth_cell(i).numbers)
      birth.push_back(point[static_cast<std::size_t>(v)]);
    if (const auto cell = s.barcode.death_cell(i))
      for (const Index v : cell->numbers) death.push_back(point[static_cast<std::size_t>(v)]);
    bars.add(s.barcode[i], birth, death);
  }
  return bars;
}

/// The birth vertex of each bar of positive length.
std::vector<std::uint32_t> birth_vertices(const Barcode& barcode) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t i = 0; i < barcode.size(); ++i)
    if (barcode[i].persistence() > 0)
      vertices.push_back(static_cast<std::uint32_t>(barcode.birth_cell(i).numbers.front()));
  return vertices;
}

/// Writes the segments and surfaces of the segmentation, as the label and the surface of each leaf.
/// For other cuts, it also writes how many voxels of each leaf lie on each surface that was found.
void add_answer(ReportFile& report, const Segmentation& s, const ContractedTree& contracted) {
  const std::size_t leaves = contracted.leaf_birth.size();
  std::vector<std::uint32_t> labels(leaves);
  std::vector<std::uint8_t> surfaces(leaves);
  const auto is_leaf = [&](std::uint32_t leaf) { return leaf != kNone; };
  for (std::size_t v = 0; v < s.cut.vertex_labels.size(); ++v)
    if (is_leaf(contracted.leaf_of[v])) labels[contracted.leaf_of[v]] = s.cut.vertex_labels[v];
  for (std::size_t k = 0; k < s.tree.points.size(); ++k)
    if (const auto leaf = contracted.leaf_of[s.tree.vertex_of_point[k]]; is_leaf(leaf))
      // mutant: report-walls
      surfaces[leaf] = s.cut.surface_labels[static_cast<std::size_t>(s.tree.points[k])];
  report.add("tree/leaf_label", labels, {.delta = true});
  report.add("tree/leaf_surface", surfaces);
  const std::size_t found = s.tree.surfaces.size() - static_cast<std::size_t>(s.tree.removed);
  if (found == 0) return;
  report.add("tree/leaf_on", segment::voxels_on_surfaces(s.tree, contracted.leaf_of, leaves),
             {.shape = {leaves, found}});
}

SceneMeta scene_meta(const ScenePage& page) {
  const Segmentation& s = page.segmentation;
  const std::vector<std::uint32_t> colours =
      segment::shown_colours(page.cloud, s.cut, page.numbers);
  const auto number_of = [&](std::uint32_t label) {
    // mutant: report-numbers
    return label == 0 || page.numbers.empty() ? label : page.numbers[label - 1];
  };
  SceneMeta meta;
  for (const segment::Segment& g : s.cut.segments)
    meta.segments.push_back({number_of(g.label), colours[g.label - 1], g.persistence,
                             segment::role_name(g.role), g.on.surface, number_of(g.on.segment)});
  for (const segment::SceneSurface& surface : s.tree.surfaces)
    meta.surface_roles.push_back(segment::role_name(surface.role));
  meta.removed = s.tree.removed;
  meta.flat = segment::kLeastShareOnSurface;
  if (s.tree.method != Method::surface) return meta;
  meta.objects = s.tree.first_cut.objects;
  return meta;
}

TreeMeta tree_meta(const Segmentation& s, const ScenePage& page) {
  TreeMeta meta;
  const bool paper = s.tree.method == Method::paper;
  meta.rule = paper ? CutRule::value : CutRule::persistence;
  meta.label = paper ? "distance" : "least persistence";
  if (s.tree.method != Method::surface) meta.unit = "m";
  meta.cut = s.tree.first_cut.value;
  if (paper) meta.to = s.tree.distance;
  meta.min_size = s.tree.first_cut.min_size;
  meta.what = s.tree.method == Method::supervoxels ? "supervoxel" : "segment";
  meta.command = page.cut_command;
  return meta;
}

Metadata metadata_of(const ScenePage& page) {
  const Segmentation& s = page.segmentation;
  Metadata meta;
  const bool surface = s.tree.method == Method::surface;
  meta.title = page.title;
  meta.value_label = std::string_view(surface ? "Concavity" : "Distance");
  if (!surface) meta.value_unit = "m";
  meta.barcodes.push_back({meta.title});
  CloudMeta cloud{.unit = "m", .viewpoint = s.tree.viewpoint};
  // In a camera's frame, y points down. In other clouds, the normal of the plane points up.
  if (s.tree.height > 1)
    cloud.up = {0, -1, 0};
  else if (s.tree.plane)
    cloud.up = s.tree.plane->normal;
  meta.cloud = cloud;
  meta.tree = tree_meta(s, page);
  meta.scene = scene_meta(page);
  Provenance& p = meta.provenance = page.provenance;
  p.run.input_description =
      s.tree.height > 1
          ? fmt::format("{} points, {} x {}", s.tree.cloud_size(), s.tree.width, s.tree.height)
          : fmt::format("{} points", s.tree.cloud_size());
  p.notes.emplace_back("Method", segment::kMethodNames[static_cast<std::size_t>(s.tree.method)]);
  p.notes.emplace_back("Voxels",
                       fmt::format("{} of {} m", s.tree.vertices.rows(), shortest(s.tree.voxel)));
  p.notes.emplace_back("Plane", s.tree.plane
                                    ? fmt::format("removed, {:.1f} % of the points in range",
                                                  100 * s.tree.plane->share)
                                    : s.plane_note);
  p.notes.emplace_back("Cross-check", !s.checked             ? "skipped"
                                      : s.difference.empty() ? "equal to boundary-matrix reduction"
                                                             : s.difference);
  return meta;
}

}  // namespace

void write_page(const Sink& sink, const ScenePage& page, const RunContext& context) {
  const Segmentation& s = page.segmentation;
  const Cloud* cloud = page.cloud;
  const ShownPoints points = shown_points(cloud, s.tree);
  const MemoryClaim claim(context.memory,
                          points.index.size() * (2 * sizeof(std::uint32_t) + 3 * sizeof(float)));
  std::vector<std::uint32_t> points_of_vertex(s.tree.cells.size());
  for (const std::uint32_t v : s.tree.vertex_of_point) ++points_of_vertex[v];

  const Metadata meta = metadata_of(page);
  const CutRule rule = meta.tree->rule;
  const Index min_part = s.tree.method == Method::paper ? 1 : s.tree.first_cut.min_part;
  const auto kept =
      contracted(s.tree.merge_tree, rule, meta.tree->from, min_part, points_of_vertex, context);
  const Barcode bars = bars_of(s);
  ReportFile report(sink, meta, context);
  add_pictures(report, std::span(&bars, 1), meta);
  add_bars(report, bars);
  add_tree(report, s.tree.merge_tree, kept,
           linked_bars(s.tree.merge_tree, bars, birth_vertices(s.barcode)), rule);
  add_answer(report, s, kept);
  std::vector<std::uint32_t> leaves;
  leaves.reserve(points.vertex.size());
  for (const std::uint32_t v : points.vertex)
    leaves.push_back(v == kNone ? kNone : kept.leaf_of[v]);
  if (s.tree.height > 1) {
    const auto touching = touching_in_picture(points.index, leaves, s.tree.width);
    report.add("tree/touching", touching, {.shape = {touching.size() / 2, 2}, .delta = true});
  }
  add_points(report, cloud, s, points, leaves);
  report.finish();
}

}  // namespace ph::report
