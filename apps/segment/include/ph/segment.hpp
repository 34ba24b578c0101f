// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/core/barcode.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/merge_tree.hpp"
#include "ph/io/cloud.hpp"
#include "ph/metric/metric.hpp"

/// Segmentation of RGB-D scenes by persistent homology. All lengths are metres (or whatever unit
/// the cloud is in: nothing here knows of metres but the defaults).
namespace ph::segment {

/// A point or a direction: x, y, z.
using Vec3 = std::array<double, 3>;

/// An axis-aligned box, borders included.
struct Box {
  Vec3 min{};
  Vec3 max{};
  friend bool operator==(const Box&, const Box&) = default;
};

/// What the pipeline reads of a cloud: plain arrays, owned by someone else.
struct CloudView {
  std::span<const float> xyz;  ///< x, y, z of each point; one not finite: a hole, label 0
  Vec3 viewpoint{};            ///< where the sensor stood, in the coordinates of the points
};

/// What decides which voxels belong together.
enum class Method {
  surface,  ///< the shape of the visible surface: cut where it is hollow, so that objects that
            ///< touch come apart
  paper,    ///< distance alone: Beksi & Papanikolopoulos, ICRA 2016
};

/// A default-constructed value suits a table top seen by a structured-light or time-of-flight
/// camera from about a metre.
struct SegmentOptions {
  Method method = Method::surface;
  /// Edge of a voxel, metres, > 0. Not given: see voxel_size; method surface takes a larger one
  /// where the points are so far apart that voxels of this size would not touch.
  std::optional<double> voxel = {};
  Index min_size = 32;                        ///< fewest voxels of a segment, >= 1
  double max_range = 2.0;                     ///< farthest from the viewpoint, metres; inf: all
  std::optional<Box> crop = {};               ///< keep the points inside this box only
  bool plane = true;                          ///< remove the supporting plane and what is behind
  std::optional<double> plane_distance = {};  ///< half its thickness, metres, > 0; see plane_margin
  std::optional<Vec3> viewpoint = {};         ///< where the sensor stood; default: the cloud's
  bool check = true;                          ///< compare union-find with boundary-matrix reduction

  // Method surface
  double min_persistence = 0.01;  ///< least persistence of a part, a mean concavity (0…2), >= 0
  bool objects = true;            ///< join the visible parts of an object; false: parts stay apart
  Index min_part = 200;  ///< fewest voxels of a part; a smaller one joins a neighbour, >= 1

  // Method paper
  double distance = 0.025;  ///< maximum distance of the Vietoris-Rips complex, metres, >= 0
  int steps = 10;           ///< filtration steps up to `distance`; 0: exact deaths

  /// What was asked for, or the default of the method.
  double voxel_size() const { return voxel.value_or(method == Method::paper ? 0.01 : 0.005); }
  double plane_margin() const {
    return plane_distance.value_or(method == Method::paper ? 0.006 : 0.005);
  }
};

/// The plane normal·x + offset = 0, its unit normal turned towards the sensor: the signed distance
/// of a point is positive on the sensor's side.
struct Plane {
  Vec3 normal{};
  double offset = 0;  ///< metres
  double share = 0;   ///< share of the points in range that lie on it, 0…1
  double signed_distance(double x, double y, double z) const {
    return normal[0] * x + normal[1] * y + normal[2] * z + offset;
  }
};

/// One segment: a component with enough voxels, of infinite persistence (paper) or a basin of the
/// merge tree (surface).
struct Segment {
  std::uint32_t label = 0;  ///< 1…k by decreasing number of points
  Index points = 0;
  Index voxels = 0;
  /// How much higher than where it was born it first meets another segment: in metres (paper) or as
  /// a concavity (surface). Infinite if it meets none.
  double persistence = kInfinity;
  std::uint32_t neighbour = 0;  ///< label of the segment it meets first; 0: none
  double meets_at = kInfinity;  ///< value of the filtration at which it does
  Vec3 centroid{};              ///< mean of its points, without those won back from the plane
  Box box;                      ///< of its points
};

/// What one stage left behind and what it took.
struct Stage {
  std::string_view name;
  Index points = 0;    ///< points (from the voxel grid on: voxels) after the stage
  double seconds = 0;  ///< wall-clock time
};

/// The result of the pipeline. A value: it refers to nothing outside.
struct Segmentation {
  std::vector<std::uint32_t> labels;  ///< one a point of the input: 0 none, 1…k the segments
  std::vector<Segment> segments;      ///< segment i has label i + 1
  std::optional<Plane> plane;         ///< the plane that was removed
  std::string plane_note;             ///< why there is none; empty if there is one
  double voxel = 0;                   ///< edge of a voxel, metres
  Points vertices;                    ///< vertex i of the graph: centroid of voxel i, one a row
  std::vector<std::uint32_t> vertex_labels;  ///< one a vertex: 0 none, 1…k the segments
  Index edges = 0;                           ///< edges of the filtered graph
  MergeTree tree;                            ///< which vertices join, at which value
  Barcode barcode = Barcode();               ///< H0, zero-length bars included
  bool checked = false;                      ///< whether the cross-check ran
  std::string difference;                    ///< what it found; empty: both engines agree
  std::vector<Stage> stages;                 ///< in the order in which they ran
};

/// Segments a cloud: range filter, supporting plane, voxel grid, a filtered graph on the voxels,
/// its H0 persistence, and the components that are there to stay.
///
/// Method surface: the voxels enter with the concavity of the surface around them, the darkest
/// seams last; objects are basins between seams. Method paper: the Vietoris-Rips complex of the
/// voxels; objects are components of infinite persistence. Deterministic: the result depends
/// neither on threads nor on the order of the points.
/// @throws Error (usage) on an option out of its range; Error (bad_data) if `xyz` is not a
///         multiple of three long; Error (cancelled, resource) as `context` asks.
Segmentation segment(const CloudView& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());
/// The same on a cloud as its file has it. Reads x, y, z and the viewpoint, nothing else.
Segmentation segment(const Cloud& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());

/// Where two segments meet first as the filtration grows.
struct Meeting {
  double value = 0;  ///< of the filtration: metres (paper), a concavity (surface)
  Vec3 at{};         ///< between the two voxels whose edge joins them
};
/// @return nothing if they never meet. @throws Error (usage) on labels that are not those of two
/// segments.
std::optional<Meeting> first_meeting(const Segmentation& segmentation, std::uint32_t a,
                                     std::uint32_t b);

/// Reads a cloud: .pcd, .ply, .xyz, .csv. @throws Error as ph::read_cloud does.
Cloud read_cloud(const std::filesystem::path& path);

/// The same points in the same order and organisation with all their fields, and `label`; a field
/// `label` that is there already becomes `label_in`.
/// @param labels one a point. @throws Error (usage) if their number is not that of the points.
Cloud with_labels(const Cloud& cloud, std::span<const std::uint32_t> labels);
/// Writes `with_labels` to a .pcd or .ply file.
void write_cloud(const std::filesystem::path& path, const Cloud& cloud,
                 std::span<const std::uint32_t> labels);

}  // namespace ph::segment
