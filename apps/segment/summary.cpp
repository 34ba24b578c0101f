// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace ph::segment {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json box_of(const Box& box) {
  Json min = Json::array(), max = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min.push_back(number(box.min[axis]));
    max.push_back(number(box.max[axis]));
  }
  return {{"min", min}, {"max", max}};
}

Json input_of(const Cloud& cloud, const RunInfo& info) {
  return {{"path", info.input},
          {"points", cloud.size()},
          {"width", cloud.width},
          {"height", cloud.height},
          {"organised", cloud.organised()}};
}

Json options_of(const SegmentOptions& o) {
  Json json = {{"max_range", number(o.max_range)},
               {"crop", o.crop ? box_of(*o.crop) : Json(nullptr)},
               {"plane", o.plane},
               {"plane_distance", o.plane_distance},
               {"viewpoint", o.viewpoint ? Json(*o.viewpoint) : Json(nullptr)},
               {"voxel", o.voxel},
               {"distance", o.distance}};
  json["steps"] = o.steps == 0 ? Json("exact") : Json(o.steps);
  json["min_size"] = o.min_size;
  json["check"] = o.check;
  return json;
}

Json stages_of(const Segmentation& s) {
  Json stages = Json::array();
  for (const Stage& stage : s.stages) {
    stages.push_back({{"name", stage.name}, {"points", stage.points}, {"seconds", stage.seconds}});
  }
  return stages;
}

Json plane_of(const Segmentation& s) {
  if (!s.plane) return {{"found", false}, {"note", s.plane_note}};
  return {{"found", true},
          {"normal", s.plane->normal},
          {"offset", s.plane->offset},
          {"share", s.plane->share}};
}

Json segments_of(const Segmentation& s) {
  Json segments = Json::array();
  for (const Segment& g : s.segments) {
    segments.push_back({{"label", g.label},
                        {"points", g.points},
                        {"voxels", g.voxels},
                        {"persistence", number(g.persistence)},
                        {"centroid", g.centroid},
                        {"box", box_of(g.box)}});
  }
  return segments;
}

Json check_of(const Segmentation& s) {
  if (!s.checked) return {{"ran", false}};
  Json json = {{"ran", true}, {"equal", s.difference.empty()}};
  if (!s.difference.empty()) json["difference"] = s.difference;
  return json;
}

double seconds_of(const Segmentation& s) {
  double seconds = 0;
  for (const Stage& stage : s.stages) seconds += stage.seconds;
  return seconds;
}

/// The time that the paper's Table I states: the complex, its homology, the components.
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

std::string json_summary(const Cloud& cloud, const Arguments& arguments, const Segmentation& s,
                         const RunInfo& info) {
  const SegmentOptions& o = arguments.options;
  const Index vertices = s.vertices.rows();
  Json json = {{"format", "ph-segment"}, {"version", 1}, {"program", info.program}};
  json["input"] = input_of(cloud, info);
  json["method"] = "paper";
  json["options"] = options_of(o);
  json["stages"] = stages_of(s);
  json["plane"] = plane_of(s);
  json["complex"] = {{"vertices", vertices},
                     {"edges", s.edges},
                     {"simplices", vertices + s.edges},
                     {"distance", o.distance}};
  json["table"] = {{"points", vertices},
                   {"distance", o.distance},
                   {"complex", vertices + s.edges},
                   {"time", table_seconds(s)}};
  json["segments"] = segments_of(s);
  json["check"] = check_of(s);
  json["timings"] = {{"read", info.read_seconds}, {"segment", seconds_of(s)}};
  json["peak_memory"] = app::peak_memory();
  // A path may hold bytes that are not UTF-8: they become U+FFFD.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_summary(const Segmentation& s) {
  std::string text =
      "label   points  voxels        x        y        z   size x   size y   size z\n";
  for (const Segment& g : s.segments) {
    fmt::format_to(std::back_inserter(text), "{:5} {:8} {:7}", g.label, g.points, g.voxels);
    for (const double c : g.centroid) fmt::format_to(std::back_inserter(text), " {:8.4f}", c);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fmt::format_to(std::back_inserter(text), " {:8.4f}", g.box.max[axis] - g.box.min[axis]);
    }
    text += '\n';
  }
  return text;
}

std::string one_line_summary(const Cloud& cloud, const Segmentation& s) {
  std::string text = fmt::format("{} points", cloud.size());
  for (const Stage& stage : s.stages) {
    if (stage.name == "range filter") {
      fmt::format_to(std::back_inserter(text), ", {} in range", stage.points);
    } else if (stage.name == "plane" && s.plane) {
      fmt::format_to(std::back_inserter(text), ", {} before the plane", stage.points);
    }
  }
  fmt::format_to(std::back_inserter(text), ", {} voxels, {} edges, {} segment{}{}; {:.1f} ms",
                 s.vertices.rows(), s.edges, s.segments.size(), s.segments.size() == 1 ? "" : "s",
                 s.checked && s.difference.empty() ? ", checked" : "", 1e3 * seconds_of(s));
  return text;
}

}  // namespace ph::segment
