// SPDX-License-Identifier: MIT
#include "apps/segment/output/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "apps/common/system/process.hpp"
#include "ph/detail/segment/json_text.hpp"
#include "ph/io/write.hpp"

namespace ph::segment {
namespace {

using namespace json;

std::string box_of(const Box& box) {
  return object({{"min", numbers(box.min)}, {"max", numbers(box.max)}});
}

std::string input_of(const SceneTree& scene, const RunInfo& info) {
  return object({{"path", json::string(info.input)},
                 {"points", integer(scene.width * scene.height)},
                 {"width", integer(scene.width)},
                 {"height", integer(scene.height)},
                 {"organised", boolean(scene.height > 1)}});
}

std::string options_of(const SegmentOptions& o) {
  return object({{"max_range", number(o.max_range)},
                 {"crop", o.crop ? box_of(*o.crop) : "null"},
                 {"plane", boolean(o.plane)},
                 {"most_supports", integer(o.most_supports)},
                 {"plane_distance", number(o.plane_margin())},
                 {"plane_noise", number(o.plane_noise)},
                 {"viewpoint", o.viewpoint ? numbers(*o.viewpoint) : "null"},
                 {"voxel", o.voxel ? number(*o.voxel) : "null"},
                 {"distance", number(o.distance)},
                 {"steps", o.steps == 0 ? json::string("exact") : integer(o.steps)},
                 {"spacing", number(o.spacing)},
                 {"check", boolean(o.check)}});
}

std::string stages_of(const Segmentation& s) {
  return lines(s.stages, [](const Stage& stage) {
    return object({{"name", json::string(stage.name)},
                   {"points", integer(stage.points)},
                   {"seconds", number(stage.seconds)}});
  });
}

std::string plane_of(const Segmentation& s) {
  if (!s.tree.plane) return object({{"found", "false"}, {"note", json::string(s.plane_note)}});
  return object({{"found", "true"},
                 {"normal", numbers(s.tree.plane->normal)},
                 {"offset", number(s.tree.plane->offset)},
                 {"share", number(s.tree.plane->share)}});
}

std::string neighbours_of(const Segment& segment, const RunInfo& info) {
  return array(segment.neighbours, [&](const Neighbour& n) {
    return object({{"label", integer(info.number_of(n.label))}, {"meets_at", number(n.meets_at)}});
  });
}

std::string signature_of(const Segment& segment, const RunInfo& info) {
  if (info.signatures.empty() || !info.signatures[segment.label - 1]) return "null";
  const auto bars_of = [&](int dim) {
    return array(info.signatures[segment.label - 1]->bars(dim), [](const Bar& bar) {
      return numbers(std::array{bar.birth, bar.death});
    });
  };
  return object({{"h0", bars_of(0)}, {"h1", bars_of(1)}, {"h2", bars_of(2)}});
}

std::string on_of(const Segment& segment, const RunInfo& info) {
  if (segment.on.surface != 0) return object({{"surface", integer(segment.on.surface)}});
  if (segment.on.segment != 0)
    return object({{"segment", integer(info.number_of(segment.on.segment))}});
  return "null";
}

std::string segments_of(const Segmentation& s, const RunInfo& info) {
  return lines(s.cut.segments, [&](const Segment& g) {
    return object({{"label", integer(info.number_of(g.label))},
                   {"points", integer(g.points)},
                   {"voxels", integer(g.voxels)},
                   {"persistence", number(g.persistence)},
                   {"neighbour", integer(info.number_of(g.neighbour))},
                   {"meets_at", number(g.meets_at)},
                   {"centroid", numbers(g.centroid)},
                   {"box", box_of(g.box)},
                   {"oriented_box", json_of(g.oriented_box)},
                   {"role", json::string(role_name(g.role))},
                   {"on", on_of(g, info)},
                   {"neighbours", neighbours_of(g, info)},
                   {"signature", signature_of(g, info)}});
  });
}

std::string check_of(const Segmentation& s) {
  if (!s.checked) return object({{"ran", "false"}});
  if (s.difference.empty()) return object({{"ran", "true"}, {"equal", "true"}});
  return object({{"ran", "true"}, {"equal", "false"}, {"difference", json::string(s.difference)}});
}

double seconds_of(const Segmentation& s) {
  double seconds = 0;
  for (const Stage& stage : s.stages) seconds += stage.seconds;
  return seconds;
}

/// The time that corresponds to the time in Table I of the paper. It is the time for the complex,
/// its homology and the components.
double table_seconds(const Segmentation& s) {
  double seconds = 0;
  for (const Stage& stage : s.stages) {
    if (stage.name == "complex" || stage.name == "persistence" || stage.name == "components") {
      seconds += stage.seconds;
    }
  }
  return seconds;
}

}  // namespace

std::string json_summary(const Arguments& arguments, const Segmentation& s, const RunInfo& info) {
  const Index vertices = s.tree.vertices.rows();
  const std::string distance = s.tree.method == Method::paper ? number(s.tree.distance) : "null";
  return document({{"format", json::string("ph-segment")},
                   {"version", "1"},
                   {"program", json::string(info.program)},
                   {"input", input_of(s.tree, info)},
                   {"method", json_of(s.tree.method)},
                   {"options", info.from_tree ? "null" : options_of(arguments.options)},
                   {"cut", json_of(s.tree.first_cut)},
                   {"stages", stages_of(s)},
                   {"viewpoint", numbers(s.tree.viewpoint)},
                   {"plane", plane_of(s)},
                   {"surfaces", json_of(s.tree.surfaces)},
                   {"noise", json_of(s.tree.noise)},
                   {"voxel", number(s.tree.voxel)},
                   {"complex", object({{"vertices", integer(vertices)},
                                       {"edges", integer(s.tree.edges)},
                                       {"simplices", integer(vertices + s.tree.edges)},
                                       {"distance", distance}})},
                   {"table", object({{"points", integer(vertices)},
                                     {"distance", distance},
                                     {"complex", integer(vertices + s.tree.edges)},
                                     {"time", number(table_seconds(s))}})},
                   {"segments", segments_of(s, info)},
                   {"check", check_of(s)},
                   {"timings", object({{"read", number(info.read_seconds)},
                                       {"segment", number(seconds_of(s))}})},
                   {"peak_memory", integer(app::peak_memory())}});
}

std::string text_summary(const Segmentation& s) {
  std::string text =
      "label   points  voxels      x/m      y/m      z/m size x/m size y/m size z/m\n";
  for (const Segment& g : s.cut.segments) {
    fmt::format_to(std::back_inserter(text), "{:5} {:8} {:7}", g.label, g.points, g.voxels);
    for (const double c : g.centroid) fmt::format_to(std::back_inserter(text), " {:8.4f}", c);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fmt::format_to(std::back_inserter(text), " {:8.4f}", g.box.max[axis] - g.box.min[axis]);
    }
    text += '\n';
  }
  return text;
}

std::string explanation(const Segmentation& s, std::uint32_t a, std::uint32_t b) {
  const std::optional<Meeting> meeting = first_meeting(s, a, b);
  if (!meeting) {
    return fmt::format(
        "segments {} and {} never join: the graph of voxels has no path between "
        "them\n",
        a, b);
  }
  const auto& [x, y, z] = meeting->at;
  return fmt::format("segments {} and {} join at {}, near ({:.4f}, {:.4f}, {:.4f})\n", a, b,
                     shortest(meeting->value), x, y, z);
}

std::string one_line_summary(const Segmentation& s) {
  std::string text = fmt::format("{} points", s.tree.width * s.tree.height);
  for (const Stage& stage : s.stages) {
    if (stage.name == "range filter") {
      fmt::format_to(std::back_inserter(text), ", {} in range", stage.points);
    } else if (stage.name == "plane" && s.tree.plane) {
      fmt::format_to(std::back_inserter(text), ", {} before the plane", stage.points);
    }
  }
  fmt::format_to(std::back_inserter(text), ", {} voxels, {} edges, {} segment{}{}; {:.1f} ms",
                 s.tree.vertices.rows(), s.tree.edges, s.cut.segments.size(),
                 s.cut.segments.size() == 1 ? "" : "s",
                 s.checked && s.difference.empty() ? ", checked" : "", 1e3 * seconds_of(s));
  return text;
}

}  // namespace ph::segment
