// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/io/cloud_data.hpp"
#include "ph/run_context.hpp"
#include "ph/scene_tree.hpp"

/// Segmentation of RGB-D scenes by persistent homology. All lengths are metres. Method paper knows
/// of them by the defaults of its options alone, so that another unit will do if all lengths are in
/// it; the others know of them besides where parts are joined behind what hides less than 15 cm.
namespace ph::segment {

/// What the pipeline reads of a cloud: plain arrays, owned by someone else.
struct CloudView {
  /// x, y, z of each point, from the first x to the last z; one not finite: a hole, label 0.
  std::span<const float> xyz;
  Vec3 viewpoint{};  ///< where the sensor stood, in the coordinates of the points
  Index width = 0;   ///< columns of an organised cloud; 0: it is not organised, all in one row
  Index height = 1;  ///< its rows; width * height is the number of points
  std::size_t stride = 3;  ///< floats from one point to the next, >= 3

  std::size_t size() const { return xyz.empty() ? 0 : (xyz.size() - 3) / stride + 1; }
  /// x, y, z of point i.
  const float* point(std::size_t i) const { return &xyz[i * stride]; }
  bool organised() const { return width > 0 && height > 0; }
  Index columns() const { return organised() ? width : static_cast<Index>(size()); }
  Index rows() const { return organised() ? height : 1; }
};

/// A default-constructed value suits a table top seen by a structured-light or time-of-flight
/// camera from about a metre.
struct SegmentOptions {
  Method method = Method::surface;
  /// Edge of a voxel, metres, > 0. Not given: see voxel_size; method surface takes a larger one
  /// where the points are so far apart that voxels of this size would not touch.
  std::optional<double> voxel = {};
  std::optional<Index> min_size = {};  ///< fewest voxels of a segment, >= 1; see cut
  double max_range = 2.0;              ///< farthest from the viewpoint, metres; inf: all
  std::optional<Box> crop = {};        ///< keep the points inside this box only
  bool plane = true;                   ///< remove the supporting plane and what is behind
  /// Where the supporting plane was in the frame before: it is taken for a beginning if nearly as
  /// many points lie on it now, so that it does not jump between frames. Unit normal.
  std::optional<Plane> plane_guess = {};
  std::optional<double> plane_distance = {};  ///< half its thickness, metres, > 0; see plane_margin
  /// Methods surface and supervoxels: the noise of depth grows with the square of the range, and so
  /// does the margin of the plane. At a range of one metre it is at least so thick (half of it,
  /// metres, >= 0) and at least four standard deviations of the noise that is found; 0: as thick
  /// as plane_distance everywhere. A plane_distance that is given and smaller goes before it.
  double plane_noise = 0.005;
  /// Where the sensor stood. Default: where the pixels' rays of an organised cloud meet, if that
  /// can be told and is not at the cloud's viewpoint; else the cloud's.
  std::optional<Vec3> viewpoint = {};
  bool check = true;  ///< compare union-find with boundary-matrix reduction

  // Methods surface and supervoxels. Not given: see cut.
  std::optional<double> min_persistence = {};  ///< least persistence of a part, >= 0; unit: Segment
  bool objects = true;  ///< surface: join the visible parts of an object; false: they stay apart
  std::optional<Index> min_part = {};  ///< fewest voxels of a part; a smaller one joins, >= 1
  /// Surface: least strength of a seam, in multiples of min_persistence, >= 0; see CutOptions.
  std::optional<double> min_seam = {};
  /// Supervoxels: how far the surface is from a seed at most, metres, no less than a voxel.
  double spacing = 0.03;

  // Method paper
  double distance = 0.025;  ///< maximum distance of the Vietoris-Rips complex, metres, >= 0
  int steps = 10;           ///< filtration steps up to `distance`; 0: exact deaths

  /// What was asked for, or the default of the method.
  double voxel_size() const { return voxel.value_or(method == Method::paper ? 0.01 : 0.005); }
  double plane_margin() const {
    return plane_distance.value_or(method == Method::paper ? 0.006 : 0.005);
  }
  /// The least margin at a range of one metre.
  double noise_floor() const {
    return plane_distance && *plane_distance < plane_noise ? 0 : plane_noise;
  }
  /// The least persistence of a part.
  double part_persistence() const {
    return min_persistence.value_or(method == Method::supervoxels ? 0 : CutOptions().value);
  }
  /// Where these options cut the tree; what was not given is what suits the method.
  CutOptions cut() const {
    if (method == Method::supervoxels)
      return {part_persistence(), min_part.value_or(8), min_size.value_or(1), false};
    const CutOptions d;
    return {method == Method::paper ? distance : part_persistence(), min_part.value_or(d.min_part),
            min_size.value_or(d.min_size), objects, min_seam.value_or(d.min_seam)};
  }
};

/// What one stage left behind and what it took.
struct Stage {
  std::string_view name;
  Index points = 0;    ///< points (from the voxel grid on: voxels) after the stage
  double seconds = 0;  ///< wall-clock time
};

/// What the supporting plane says of the viewpoint, as shares of the points in range off the plane.
struct PlaneSight {
  double behind = 0;  ///< lie behind the plane as seen from the viewpoint, past its edge or hidden
  double hidden = 0;  ///< lie behind points of the plane: no sensor there could see them
};

/// The result of the pipeline: the merge tree of the scene, one cut of it, and how it went. A
/// value: it refers to nothing outside.
struct Segmentation : SceneTree, SceneCut {
  std::string plane_note;  ///< why there is no plane; empty if there is one
  /// Where the pixels' rays meet, if that is not where the options or the cloud say that the sensor
  /// stood. It was taken as `viewpoint` unless the options have one.
  std::optional<Vec3> rays_meet_at;
  PlaneSight plane_sight;       ///< much of it: the viewpoint is wrong
  Barcode barcode = Barcode();  ///< H0, zero-length bars included
  bool checked = false;         ///< whether the cross-check ran
  std::string difference;       ///< what it found; empty: both engines agree
  std::vector<Stage> stages;    ///< in the order in which they ran
};

/// Segments a cloud: range filter, supporting plane, voxel grid, a filtered graph on the voxels,
/// its H0 persistence, and the components that are there to stay.
///
/// Method surface: the voxels enter with the concavity of the surface around them, in units of
/// the noise that a flat surface shows at that range. Seams, where the surface is most concave,
/// enter last; objects are the basins between them. Method paper: the Vietoris-Rips complex of the
/// voxels; objects are components of infinite persistence. Method supervoxels: the voxels enter
/// with their distance to the nearest seed; each basin is a supervoxel. Deterministic: the result
/// depends neither on threads nor on the order of the points.
/// It runs on one thread.
/// @throws Error (usage) on an option out of its range, or voxels so small that the coordinates of
///         neighbours are the same numbers; Error (bad_data) if `xyz` is not a multiple of three
///         long, or of another size than rows and columns say; Error (cancelled, resource) as
///         `context` asks.
Segmentation segment(const CloudView& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());
/// The same on a cloud as its file has it. Reads x, y, z and the viewpoint, nothing else.
Segmentation segment(const Cloud& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());

/// first_meeting of two segments of its cut.
inline std::optional<Meeting> first_meeting(const Segmentation& s, std::uint32_t a,
                                            std::uint32_t b) {
  return first_meeting(s, s, a, b);
}

/// The shape of some segments, of which nothing but their voxels is looked at, by persistent
/// homology in dimensions 0 to 2: pieces, loops (a handle, a rim, a hole that one can see through)
/// and hollows. The filtration is the distance to the nearest voxel (ph::voxel_image): a bar
/// (b, d) in dimension 1 is a loop that closes when the voxels have grown by b metres, and is
/// filled when they have grown by d, which is the radius of the largest ball that goes through it.
/// Bars no longer than a voxel are left out: the grid may have made them. Cells are those of an
/// image around the segments. O(volume of their box).
/// @throws Error (usage) on no label, or one that is not that of a segment; Error (resource,
///         cancelled) as `context` asks.
Barcode signature(const SceneTree& scene, const SceneCut& cut,
                  std::span<const std::uint32_t> labels,
                  const RunContext& context = default_context());

/// A colour a segment, 0x00RRGGBB, that people with any common kind of colour blindness can tell
/// apart. Those that touch differ as long as none touches more than six.
std::vector<std::uint32_t> label_colours(const SceneCut& cut);

/// Reads a cloud: .pcd, .ply, .npy, .xyz, .csv, .pts. @throws Error as ph::read_cloud does.
Cloud read_cloud(const std::filesystem::path& path);

/// The same points in the same order and organisation with all their fields, and `label`; a field
/// `label` that is there already becomes `label_in`.
/// @param labels one a point. @throws Error (usage) if their number is not that of the points.
Cloud with_labels(const Cloud& cloud, std::span<const std::uint32_t> labels);
/// Writes `with_labels` to a .pcd or .ply file, with the names and types that PCL and Open3D read:
/// docs/reference/formats.md, "Segmented clouds".
void write_cloud(const std::filesystem::path& path, const Cloud& cloud,
                 std::span<const std::uint32_t> labels);

}  // namespace ph::segment
