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

/// Options of the paper's pipeline. A default-constructed value suits a table top seen by a
/// structured-light or time-of-flight camera from about a metre.
struct SegmentOptions {
  double voxel = 0.01;            ///< edge of a voxel, metres, > 0
  double distance = 0.025;        ///< maximum distance of the Vietoris-Rips complex, metres, >= 0
  int steps = 10;                 ///< filtration steps up to `distance`; 0: exact deaths
  Index min_size = 32;            ///< fewest voxels of a segment, >= 1
  double max_range = 2.0;         ///< farthest distance from the viewpoint, metres; may be infinite
  std::optional<Box> crop = {};   ///< keep the points inside this box only
  bool plane = true;              ///< remove the supporting plane and what lies behind it
  double plane_distance = 0.006;  ///< half the thickness of the supporting plane, metres, > 0
  std::optional<Vec3> viewpoint = {};  ///< where the sensor stood; default: what the cloud says
  bool check = true;                   ///< compare union-find with boundary-matrix reduction
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

/// One segment: a component of infinite persistence with enough voxels.
struct Segment {
  std::uint32_t label = 0;  ///< 1…k by decreasing number of points
  Index points = 0;
  Index voxels = 0;
  double persistence = kInfinity;  ///< death - birth of its component, metres
  Vec3 centroid{};                 ///< mean of its points
  Box box;                         ///< of its points
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
  Points vertices;                    ///< vertex i of the complex: centroid of voxel i, one a row
  Index edges = 0;                    ///< edges of the complex
  MergeTree tree;                     ///< which vertices join, at which value
  Barcode barcode = Barcode();        ///< H0, zero-length bars included
  bool checked = false;               ///< whether the cross-check ran
  std::string difference;             ///< what it found; empty: both engines agree
  std::vector<Stage> stages;          ///< in the order in which they ran
};

/// Segments a cloud by the paper's pipeline: range filter, supporting plane, voxel grid,
/// Vietoris-Rips complex, H0 persistence, components of infinite persistence. Deterministic: the
/// result depends neither on threads nor on the order of the points.
/// @throws Error (usage) on an option out of its range; Error (bad_data) if `xyz` is not a
///         multiple of three long; Error (cancelled, resource) as `context` asks.
Segmentation segment(const CloudView& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());
/// The same on a cloud as its file has it. Reads x, y, z and the viewpoint, nothing else.
Segmentation segment(const Cloud& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());

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
