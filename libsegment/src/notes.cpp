// SPDX-License-Identifier: MIT
#include "ph/detail/segment/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

namespace ph::segment {
namespace {

/// The points that were segmented. A function copies the coordinates, because most notes need none.
struct InputCloud {
  Index points = 0, width = 0, height = 0;
  std::function<std::vector<float>()> xyz;
};

/// The distances of points from a viewpoint, in metres.
struct Distances {
  double nearest = 0, median = 0, farthest = 0;
};

/// Empty if all points are holes.
std::optional<Distances> distances(const InputCloud& cloud, const Vec3& viewpoint) {
  std::vector<double> all;
  const std::vector<float> xyz = cloud.xyz();
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    const double x = xyz[i] - viewpoint[0], y = xyz[i + 1] - viewpoint[1];
    const double distance = std::hypot(x, y, xyz[i + 2] - viewpoint[2]);
    if (std::isfinite(distance)) all.push_back(distance);
  }
  if (all.empty()) return std::nullopt;
  const auto middle = all.begin() + std::ssize(all) / 2;
  std::ranges::nth_element(all, middle);
  return Distances{*std::min_element(all.begin(), middle + 1), *middle,
                   *std::max_element(middle, all.end())};
}

// In metres. Nobody looks for things on a table that is farther away.
constexpr double kRoom = 50;

/// For results without segments, the doubt that lengths are in metres. Empty if there is none.
std::string about_units(const SegmentOptions& o, bool is_depth, const Distances& found,
                        Index in_range) {
  // In metres. A scene in centimetres is not so far away, and no scene is so small.
  constexpr double building = 300, crumb = 0.02;
  const std::string scale = mark(Setting::depth_scale);
  if (found.farthest < crumb)
    return fmt::format("all points are within {:.3g} m of the viewpoint; {}", found.farthest,
                       is_depth ? "see " + scale : "lengths are in metres");
  // A share of the distance. In the coordinates of a map, all points are far from the origin.
  constexpr double little = 0.01;
  const bool is_map = !is_depth && found.farthest - found.nearest < little * found.median;
  if (found.median <= kRoom || is_map) return {};
  const bool is_far = found.median > building;
  const std::string where =
      in_range == 0 ? fmt::format(
                          "no point within {} m of the viewpoint{}, the nearest is at "
                          "{:.3g} m",
                          o.max_range, o.crop ? " and inside the crop box" : "", found.nearest)
                    : fmt::format("half of the points are more than {:.3g} m away", found.median);
  if (is_depth) return fmt::format("{}; see {}: are these millimetres?", where, scale);
  return fmt::format("{}: are these {}? if they are, {}", where,
                     is_far ? "millimetres" : "centimetres",
                     mark(Setting::depth_scale, is_far ? "1000" : "100"));
}

/// For results without segments, the reason why no points are in range.
std::string about_range(const SegmentOptions& o, bool is_depth, double nearest) {
  const bool is_map = !is_depth && nearest > kRoom;
  const std::string range = mark(is_map ? Setting::viewpoint : Setting::max_range);
  return fmt::format("no point within {} m of the viewpoint{}, the nearest is at {:.3g} m; see {}",
                     o.max_range, o.crop ? " and inside the crop box" : "", nearest,
                     is_depth ? fmt::format("{}; if that distance is wrong, see {}, the number of "
                                            "units per metre",
                                            range, mark(Setting::depth_scale))
                              : range);
}

/// For results without segments, the number of points that could have formed a segment.
std::string about_nothing(const SegmentOptions& o, const Segmentation& s) {
  const auto after = [&](std::string_view name) {
    const auto stage = std::ranges::find(s.stages, name, &Stage::name);
    return stage == s.stages.end() ? 0 : stage->points;
  };
  const Index in_range = s.stages.front().points, left = after("plane");
  if (in_range == 0) return {};
  const std::string rest =
      s.tree.plane ? fmt::format("{} of the {} points in range are in front of the plane and form",
                                 left, in_range)
                   : fmt::format("the {} points in range form", in_range);
  return fmt::format("no segments: {} no component of {} voxels; see {}", rest, o.cut().min_size,
                     mark(Setting::min_size));
}

/// Warns if most of the scene is out of range.
std::string about_the_rest(const SegmentOptions& o, const InputCloud& cloud, Index in_range) {
  constexpr double little = 0.1;  // the share of the points
  const auto is_little = [&](Index points) {
    return static_cast<double>(in_range) < little * static_cast<double>(points);
  };
  if (o.crop || in_range == 0 || !is_little(cloud.points)) return {};
  const std::vector<float> xyz = cloud.xyz();
  Index points = 0;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
    points += std::isfinite(xyz[i] + xyz[i + 1] + xyz[i + 2]) ? 1 : 0;
  if (!is_little(points)) return {};
  return fmt::format("{} of {} points are within {} m of the viewpoint; see {}", in_range, points,
                     o.max_range, mark(Setting::max_range));
}

/// Warns of coordinates so large that the distances between points are lost.
std::string about_precision(const SegmentOptions& o, const InputCloud& cloud,
                            const Segmentation& s) {
  constexpr double much = 0.01;  // the share of the edge of a voxel
  float largest = 0;
  const auto take = [&](double x) {
    if (std::isfinite(x)) largest = std::max(largest, static_cast<float>(std::abs(x)));
  };
  // If segments were found, their boxes give the largest coordinates without a second pass over all
  // points.
  for (const Segment& segment : s.cut.segments)
    for (const auto& end : {segment.box.min, segment.box.max}) std::ranges::for_each(end, take);
  if (s.cut.segments.empty()) std::ranges::for_each(cloud.xyz(), take);
  const double step = std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest;
  if (step <= much * o.voxel_size()) return {};
  return fmt::format(
      "coordinates reach {:.3g} m, where single precision has steps of {:.2g} m; subtract an "
      "offset from the points and the viewpoint",
      largest, step);
}

/// Warns if no pinhole camera would have these numbers. This is the case if its field of view is
/// only a few degrees or nearly a half circle, or if its axis does not meet the image.
std::string about_camera(const DepthSource& depth, const InputCloud& cloud) {
  const Intrinsics camera = depth.camera.scaled_to(cloud.width, cloud.height).intrinsics;
  constexpr double least = 5, most = 160;  // in degrees
  const auto view = [](Index pixels, double focal_length) {
    return 360 / std::numbers::pi * std::atan(static_cast<double>(pixels) / 2 / focal_length);
  };
  const double across = view(cloud.width, camera.fx), down = view(cloud.height, camera.fy);
  if (std::max(across, down) > most || std::max(across, down) < least) {
    return fmt::format("{}: a field of view of {:.3g} x {:.3g} degrees; are FX and FY in pixels?",
                       mark(depth.setting), across, down);
  }
  if (camera.cx >= 0 && camera.cy >= 0 && camera.cx < static_cast<double>(cloud.width) &&
      camera.cy < static_cast<double>(cloud.height))
    return {};
  return fmt::format("{}: the principal point {}, {} is outside the image of {} x {}",
                     mark(depth.setting), camera.cx, camera.cy, cloud.width, cloud.height);
}

/// Warns of a plane that no sensor at the viewpoint could see like this.
std::string about_plane(const Segmentation& s, const std::string& viewpoint) {
  if (!s.tree.plane) return {};
  constexpr double too_low = 0.03;  // in metres
  const auto& [x, y, z] = s.tree.viewpoint;
  if (s.tree.plane->signed_distance(x, y, z) < too_low) {
    return fmt::format(
        "the viewpoint {} lies on the plane that was found: are the points and "
        "the viewpoint in different frames? see {}",
        viewpoint, mark(Setting::viewpoint));
  }
  // If the points are in the frame of their sensor, at most 0.4 of them are behind the plane (past
  // the edge of a table), and the plane should hide at most 0.03 of them.
  constexpr double much_hidden = 0.1, nearly_all = 0.9, some_hidden = 0.01;
  const auto [behind, hidden] = s.plane_sight;
  if (hidden < some_hidden || (hidden < much_hidden && behind < nearly_all)) return {};
  return fmt::format(
      "{:.0f} % of the points off the plane lie behind it as seen from {}: are the "
      "points and the viewpoint in different frames? see {}",
      100 * behind, viewpoint, mark(Setting::viewpoint));
}

/// Warns if the sensor was not where the input says.
std::string about_viewpoint(const SegmentOptions& o, const Segmentation& s) {
  const auto text = [](const Vec3& p) {
    constexpr double half = 0.0005;
    const auto shown = [](double x) { return std::abs(x) < half ? 0.0 : x; };  // this avoids -0.000
    return fmt::format("{:.3f},{:.3f},{:.3f}", shown(p[0]), shown(p[1]), shown(p[2]));
  };
  if (!s.rays_meet_at) return about_plane(s, text(s.tree.viewpoint));
  if (o.viewpoint) {
    return fmt::format("{}: found {}, but the rays of the pixels meet at {}",
                       mark(Setting::viewpoint), text(*o.viewpoint), text(*s.rays_meet_at));
  }
  return fmt::format(
      "the rays of the pixels do not meet at the viewpoint of the input but at {}, which is used "
      "as the viewpoint; {} replaces it",
      text(*s.rays_meet_at), mark(Setting::viewpoint, "X,Y,Z"));
}

/// The notes on a result whose points are known.
std::vector<Message> notes_on(const Segmentation& s, const SegmentOptions& options,
                              const InputCloud& cloud, const DepthSource* depth) {
  std::vector<Message> texts;
  const bool is_empty = s.cut.segments.empty() && cloud.points > 0;
  const Index in_range = s.stages.front().points;
  const auto found = is_empty ? distances(cloud, s.tree.viewpoint) : std::nullopt;
  if (depth) texts.emplace_back(about_camera(*depth, cloud));
  const std::string units =
      found ? about_units(options, depth != nullptr, *found, in_range) : std::string();
  if (!units.empty()) {
    texts.emplace_back(units);  // in another unit, the other doubts have no meaning
    return texts;
  }
  texts.emplace_back(about_precision(options, cloud, s));
  texts.emplace_back(about_viewpoint(options, s));
  if (is_empty && !found)
    texts.emplace_back(
        fmt::format("no point within {} m of the viewpoint: all are holes", options.max_range));
  if (found && in_range == 0)
    texts.emplace_back(about_range(options, depth != nullptr, found->nearest));
  texts.emplace_back(about_the_rest(options, cloud, in_range));
  if (is_empty) texts.emplace_back(about_nothing(options, s));
  if (options.plane && !s.tree.plane && in_range > 0)
    texts.emplace_back(s.plane_note + "; nothing removed");
  return texts;
}

std::vector<Message> notes_of(const Segmentation& s, const SegmentOptions& options,
                              const InputCloud* cloud, const DepthSource* depth) {
  std::vector<Message> texts;
  if (cloud && !s.stages.empty()) texts = notes_on(s, options, *cloud, depth);
  if (!s.difference.empty()) texts.emplace(texts.begin(), "check: " + s.difference);
  std::erase_if(texts, [](const Message& text) { return text.empty(); });
  return texts;
}

}  // namespace

std::vector<Message> notes(const Segmentation& s, const SegmentOptions& options, const Cloud* cloud,
                           const DepthSource* depth) {
  if (!cloud) return notes_of(s, options, nullptr, depth);
  const InputCloud input{cloud->size(), cloud->width, cloud->height, [&] { return cloud->xyz(); }};
  return notes_of(s, options, &input, depth);
}

std::vector<Message> notes(const Segmentation& s, const SegmentOptions& options,
                           const Cloud& cloud) {
  return notes(s, options, &cloud, nullptr);
}

std::vector<Message> notes(const Segmentation& s, const SegmentOptions& options,
                           const CloudView& cloud) {
  const InputCloud input{static_cast<Index>(cloud.size()), cloud.width, cloud.height, [&] {
                           std::vector<float> xyz;
                           for (std::size_t i = 0; i < cloud.size(); ++i)
                             xyz.insert(xyz.end(), cloud.point(i), cloud.point(i) + 3);
                           return xyz;
                         }};
  return notes_of(s, options, &input, nullptr);
}

}  // namespace ph::segment
