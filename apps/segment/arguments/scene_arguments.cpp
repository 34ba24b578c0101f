// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <array>
#include <limits>

#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/segment/arguments/argument_groups.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

Box parse_box(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 6);
  const Box box{{v[0], v[2], v[4]}, {v[1], v[3], v[5]}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] <= box.max[axis]) continue;
    throw Error(ErrorKind::usage, fmt::format("{}: found {}…{} on axis {}, expected min <= max",
                                              option, box.min[axis], box.max[axis], "xyz"[axis]));
  }
  return box;
}

Vec3 parse_point(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 3);
  for (const double x : v) {
    if (x == kInfinity || x == -kInfinity) {
      throw Error(ErrorKind::usage,
                  fmt::format("{}: found {}, expected finite coordinates", option, text));
    }
  }
  return {v[0], v[1], v[2]};
}

bool parse_switch(std::string_view option, const std::string& text) {
  static constexpr std::array<std::string_view, 2> choices = {"off", "on"};
  return app::choose(option, text, choices) == 1;
}

/// "on", "off", or the largest number of supports.
void parse_plane(const std::string& text, SegmentOptions& options) {
  if (text.find_first_not_of("0123456789") != std::string::npos || text.empty()) {
    options.plane = parse_switch("--plane", text);
    return;
  }
  options.plane = true;
  options.most_supports = app::parse_integer("--plane", text, 1, kMostSurfaces);
}

Method parse_method(const std::string& text) {
  return static_cast<Method>(app::choose("--method", text, kMethodNames));
}

/// Returns a text such as "0.005, paper: 0.01".
template <class Value>
std::string defaults_of(Value value_of) {
  return fmt::format("{}, paper: {}", (SegmentOptions{}.*value_of)(),
                     (SegmentOptions{.method = Method::paper}.*value_of)());
}

int parse_steps(const std::string& text) {
  if (text == "exact") return 0;
  return static_cast<int>(app::parse_integer("--steps", text, 1, std::numeric_limits<int>::max()));
}

/// A number of at least 0.
double at_least_zero(std::string_view option, const std::string& text) {
  const double value = app::parse_number(option, text);
  if (!(value >= 0))
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected at least 0", option, text));
  return value;
}

}  // namespace

double length(std::string_view option, const std::string& text, bool zero) {
  const double value = app::parse_number(option, text);
  if (!(value > 0 || (zero && value == 0)) || value == kInfinity) {
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected a finite length {} 0", option,
                                              text, zero ? "of at least" : "above"));
  }
  return value;
}

void add_scene_options(app::Options& options, SegmentOptions& o) {
  options.topic("scenes");
  const SegmentOptions d;
  options.value({"--max-range", kOfScenes}, "M",
                fmt::format("keep points up to M metres from the viewpoint; inf: all (default: {})",
                            d.max_range),
                [&o](const std::string& v) { o.max_range = at_least_zero("--max-range", v); });
  options.value({"--crop", kOfScenes}, "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX",
                "keep points inside this box, metres; inf and -inf: no limit (default: all)",
                [&o](const std::string& v) { o.crop = parse_box("--crop", v); });
  options.value({"--plane", kOfScenes}, "on|off|N",
                fmt::format("remove the supporting plane and what lies behind it; N: and at most N "
                            "supports in all (default: on, with at most {})",
                            d.most_supports),
                [&o](const std::string& v) { parse_plane(v, o); });
  options.value({"--plane-distance", {kScene | kAnyMethod | kPlane, "scenes with --plane on"}}, "M",
                fmt::format("half the thickness of the plane, metres (default: {})",
                            defaults_of(&SegmentOptions::plane_margin)),
                [&o](const std::string& v) { o.plane_distance = length("--plane-distance", v); });
  options.value(
      {"--plane-noise",
       {kScene | kBySurface | kPlane,
        "scenes with --plane on and --method surface or supervoxels"}},
      "M",
      fmt::format("surface, supervoxels: least half thickness of the plane at a range of one "
                  "metre, metres; it grows with the square of the range. A --plane-distance "
                  "below it replaces it; 0: --plane-distance alone counts (default: {})",
                  d.plane_noise),
      [&o](const std::string& v) { o.plane_noise = length("--plane-noise", v, true); });
  options.value({"--viewpoint", kOfScenes}, "X,Y,Z",
                "where the sensor stood, metres (default: the file's VIEWPOINT, else 0,0,0; of an "
                "organised cloud whose pixels' rays meet elsewhere that place, with a note)",
                [&o](const std::string& v) { o.viewpoint = parse_point("--viewpoint", v); });
}

Known add_method_options(app::Options& options, SegmentOptions& o) {
  options.topic("methods");
  const SegmentOptions d;
  Known known;
  known.method =
      options.value({"--method", kOfScenes}, fmt::format("{}", fmt::join(kMethodNames, "|")),
                    "what joins points (default surface: the shape of the visible surface; "
                    "paper: distance alone, "
                    "the pipeline of the ICRA 2016 paper; supervoxels: see --supervoxels)",
                    [&o](const std::string& v) { o.method = parse_method(v); });
  known.supervoxels = options.value(
      {"--supervoxels", {kScene | kSupervoxels | kAnyPlane, kOfScenes.meant_for}}, "M",
      fmt::format("method supervoxels, with seeds so far apart that the surface is nowhere more "
                  "than M metres from one; no less than a voxel (default: {})",
                  d.spacing),
      [&o](const std::string& v) { o.spacing = length("--supervoxels", v); });
  options.value({"--voxel", kOfScenes}, "M",
                fmt::format("edge of a voxel, metres (default: {})",
                            defaults_of(&SegmentOptions::voxel_size)),
                [&o](const std::string& v) { o.voxel = length("--voxel", v); });
  options.topic("cuts");
  known.min_persistence = options.value(
      {"--min-persistence", {kScene | kBySurface | kAnyPlane, kOfBoth.meant_for}}, "X",
      fmt::format("least persistence of a part; one of less joins the neighbour that it meets "
                  "first. surface: in units of the noise, how hollow a flat table looks (default: "
                  "{}); supervoxels: metres (default: {})",
                  d.cut().value, SegmentOptions{.method = Method::supervoxels}.cut().value),
      [&o](const std::string& v) { o.min_persistence = at_least_zero("--min-persistence", v); });
  options.topic("methods");
  options.value(
      {"--distance", kOfPaper}, "M",
      fmt::format("paper: maximum distance of the Vietoris-Rips complex, metres (default: {})",
                  d.distance),
      [&o](const std::string& v) { o.distance = length("--distance", v, true); });
  // mutant: scope-steps
  options.value(
      {"--steps", kOfPaper}, "N|exact",
      fmt::format("paper: filtration steps up to the distance; exact: as many as there are "
                  "distances (default: {})",
                  d.steps),
      [&o](const std::string& v) { o.steps = parse_steps(v); });
  options.flag({"--no-check", kOfScenes},
               "skip the cross-check of union-find against boundary-matrix reduction "
               "(on by default; a difference exits 1)",
               [&o] { o.check = false; });
  return known;
}

void add_cut_options(app::Options& options, CutArguments& cut, const Known& known) {
  options.topic("cuts");
  const CutOptions d, supervoxels = SegmentOptions{.method = Method::supervoxels}.cut();
  options
      .value("--cut", "X",
             "cut the merge tree here: the same as --min-persistence; paper: segments are "
             "the components at X metres, at most --distance (default: as the tree was cut)",
             [&cut](const std::string& v) { cut.value = at_least_zero("--cut", v); })
      ->excludes(known.min_persistence);
  options.value(
      {"--min-part", kOfBoth}, "N",
      fmt::format("fewest voxels of a part; a smaller one joins the neighbour that it meets first "
                  "(default: {}; supervoxels: {})",
                  d.min_part, supervoxels.min_part),
      [&cut](const std::string& v) { cut.min_part = app::parse_integer("--min-part", v, 1); });
  options.value(
      "--min-size", "N",
      fmt::format("fewest voxels of a segment (default: {}; supervoxels: {})", d.min_size,
                  supervoxels.min_size),
      [&cut](const std::string& v) { cut.min_size = app::parse_integer("--min-size", v, 1); });
  CLI::Option* objects = options.flag(
      {"--objects", kOfSurface},
      "surface: join the visible parts of an object, over a rim or behind what hides its middle "
      "(default)",
      [&cut] { cut.objects = true; });
  options
      .flag({"--parts", kOfSurface}, "surface: leave each visible part a segment",
            [&cut] { cut.objects = false; })
      ->excludes(objects);
}

}  // namespace ph::segment
