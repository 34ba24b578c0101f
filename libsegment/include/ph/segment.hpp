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
#include "ph/error.hpp"
#include "ph/run_context.hpp"
#include "ph/scene_tree.hpp"

/// Segmentation of RGB-D scenes by persistent homology. All lengths are in metres. Method paper
/// depends on the unit only through the defaults of its options; it therefore accepts any other
/// unit, if all lengths are given in that unit. The other methods also contain lengths in metres,
/// such as the least area of a table and the widest occluder behind which parts are joined.
namespace ph::segment {

/// The parts of a cloud that the pipeline reads: plain arrays, owned by the caller.
struct CloudView {
  /// x, y, z of each point, from the first x to the last z. A point with a coordinate that is not
  /// finite is a hole and gets label 0.
  std::span<const float> xyz;
  Vec3 viewpoint{};  ///< position of the sensor, in the coordinates of the points
  Index width = 0;  ///< columns of an organised cloud; 0: the cloud is unorganised, in a single row
  Index height = 1;        ///< rows of the cloud; width * height is the number of points
  std::size_t stride = 3;  ///< floats between the starts of two points, >= 3

  std::size_t size() const { return xyz.empty() ? 0 : (xyz.size() - 3) / stride + 1; }
  /// x, y, z of point i.
  const float* point(std::size_t i) const { return &xyz[i * stride]; }
  bool organised() const { return width > 0 && height > 0; }
  Index columns() const { return organised() ? width : static_cast<Index>(size()); }
  Index rows() const { return organised() ? height : 1; }
};

/// The defaults suit a table top that a structured-light or time-of-flight camera sees from a
/// distance of about one metre.
struct SegmentOptions {
  Method method = Method::surface;
  /// Edge of a voxel, metres, > 0. If not given: see voxel_size; methods surface and supervoxels
  /// use a larger edge if the points are so far apart that voxels of this size would not touch, and
  /// method surface also if the points are far from the viewpoint.
  std::optional<double> voxel = {};
  std::optional<Index> min_size = {};  ///< fewest voxels of a segment, >= 1; see cut
  double max_range = 2.0;        ///< largest distance from the viewpoint, metres; inf: all points
  std::optional<Box> crop = {};  ///< keep only the points inside this box
  bool plane = true;             ///< remove the supporting plane and everything behind it
  /// Method surface: the largest number of supports, the supporting plane included, >= 1. The
  /// others are parallel to it, such as the floor and the boards of a shelf.
  Index most_supports = 8;
  /// The supporting plane of the previous frame, with a unit normal. The search starts from it if
  /// nearly as many points lie on it now, so that the plane does not jump between frames.
  std::optional<Plane> plane_guess = {};
  /// Half the plane's thickness, metres, > 0; see plane_margin.
  std::optional<double> plane_distance = {};
  /// Methods surface and supervoxels: the noise of depth grows with the square of the range, and so
  /// does the margin of the plane. At a range of one metre, the margin is at least this many metres
  /// (>= 0) and at least four standard deviations of the measured noise; 0: the margin is
  /// plane_distance everywhere. If a smaller plane_distance is given, it replaces this number, but
  /// not the measured noise.
  double plane_noise = 0.005;
  /// Position of the sensor. By default it is where the pixels' rays of an organised cloud meet, if
  /// this place can be determined and differs from the cloud's viewpoint; otherwise it is the
  /// cloud's viewpoint.
  std::optional<Vec3> viewpoint = {};
  bool check = true;  ///< compare union-find with the reduction of the boundary matrix

  // Only for methods surface and supervoxels. The default of a member that is not set depends on
  // the method; see cut().
  std::optional<double> min_persistence = {};  ///< least persistence of a part, >= 0; unit: Segment
  bool objects = true;  ///< surface: join the visible parts of an object; false: keep them apart
  /// The fewest voxels of a part, >= 1. A smaller part joins a neighbouring part.
  std::optional<Index> min_part = {};
  /// Supervoxels: the largest distance of the surface from a seed, metres, at least one voxel.
  double spacing = 0.03;

  // Method paper
  double distance = 0.025;  ///< maximum distance of the Vietoris-Rips complex, metres, >= 0
  int steps = 10;           ///< filtration steps up to `distance`; 0: exact deaths

  /// The edge of a voxel: the value that was given, or else the default of the method.
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
  /// The cut that these options describe; a value that was not given is the default of the method.
  CutOptions cut() const {
    if (method == Method::supervoxels)
      return {part_persistence(), min_part.value_or(8), min_size.value_or(1), false};
    const CutOptions d;
    return {method == Method::paper ? distance : part_persistence(), min_part.value_or(d.min_part),
            min_size.value_or(d.min_size), objects};
  }
};

/// One stage of the pipeline: the number of points that it left, and the time that it took.
struct Stage {
  std::string_view name;
  Index points = 0;    ///< points (from the voxel grid on, voxels) after the stage
  double seconds = 0;  ///< wall-clock time
};

/// The fit of the viewpoint to the supporting plane: shares of the points that are in range and not
/// on the plane.
struct PlaneSight {
  double behind = 0;  ///< behind the plane as seen from the viewpoint: past its edge, or hidden
  double hidden = 0;  ///< behind points of the plane: no sensor at the viewpoint could see them
};

/// The result of the pipeline: the merge tree of the scene, one cut of it, and a record of the run.
/// A value: it refers to nothing outside itself.
struct Segmentation {
  SceneTree tree;
  SceneCut cut;            ///< the cut that the tree's `first_cut` describes
  std::string plane_note;  ///< the reason why there is no plane; empty if there is one
  /// Where the pixels' rays meet, if this differs from the position of the sensor that the options
  /// or the cloud state. This place becomes the `viewpoint` of the tree unless the options state
  /// one.
  std::optional<Vec3> rays_meet_at;
  PlaneSight plane_sight;       ///< large shares mean that the viewpoint is wrong
  Barcode barcode = Barcode();  ///< H0, zero-length bars included
  bool checked = false;         ///< true if the cross-check ran
  std::string difference;       ///< the difference that it found; empty if both engines agree
  std::vector<Stage> stages;    ///< in the order in which the stages ran
};

/// Segments a cloud in these stages: range filter, supporting plane, voxel grid, a filtered graph
/// on the voxels, its H0 persistence, and the persistent components.
///
/// Method surface: each voxel enters at the concavity of the surface around it, in units of the
/// noise that a flat surface shows at that range. Seams, where the surface is most concave, enter
/// last; objects are the basins between them. Method paper: the Vietoris-Rips complex of the
/// voxels; objects are components of infinite persistence. Method supervoxels: each voxel enters at
/// its distance to the nearest seed; each basin is a supervoxel. The result depends neither on
/// threads nor on the order of the points. The pipeline runs on one thread.
/// @throws Error (usage) on an option out of its range, or voxels so small that neighbours have the
///         same coordinates; Error (bad_data) if the length of `xyz` is not a multiple of three, or
///         does not match rows and columns; Error (cancelled, resource) as `context` requires.
Segmentation segment(const CloudView& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());
/// Segments a cloud as it was read from a file. Reads only x, y, z and the viewpoint.
Segmentation segment(const Cloud& cloud, const SegmentOptions& options = {},
                     const RunContext& context = default_context());

/// Warnings that a user should read before trusting the result, one line each: a missing plane, the
/// reason for an empty result, and implausible units, coordinates or viewpoints. Message::str gives
/// the text. @param options, cloud those of the call of `segment`.
std::vector<Message> notes(const Segmentation& segmentation, const SegmentOptions& options,
                           const CloudView& cloud);
std::vector<Message> notes(const Segmentation& segmentation, const SegmentOptions& options,
                           const Cloud& cloud);

/// first_meeting of two segments of the cut.
inline std::optional<Meeting> first_meeting(const Segmentation& s, std::uint32_t a,
                                            std::uint32_t b) {
  return first_meeting(s.tree, s.cut, a, b);
}

/// The shape of some segments, by persistent homology of their voxels in dimensions 0 to 2: pieces,
/// loops (a handle, a rim, a hole that one can see through) and hollows. The filtration is the
/// distance to the nearest voxel (ph::voxel_image): a bar (b, d) in dimension 1 is a loop that
/// closes when the voxels have grown by b metres, and is filled when they have grown by d metres,
/// the radius of the largest ball that passes through it. Bars no longer than a voxel are left out,
/// because the grid may have made them. The cells of the bars belong to an image around the
/// segments. O(volume of their box).
/// @throws Error (usage) without labels, or on a label that no segment has; Error (resource,
///         cancelled) as `context` requires.
Barcode signature(const SceneTree& scene, const SceneCut& cut,
                  std::span<const std::uint32_t> labels,
                  const RunContext& context = default_context());

/// One colour per segment, 0x00RRGGBB, distinguishable with any common kind of colour blindness.
/// Touching segments differ as long as none touches more than six others.
std::vector<std::uint32_t> label_colours(const SceneCut& cut);

/// Reads a cloud: .pcd, .ply, .npy, .xyz, .csv, .pts. @throws Error like ph::read_cloud.
Cloud read_cloud(const std::filesystem::path& path);

/// The same points in the same order and organisation with all their fields, plus `label`; an
/// existing field `label` is renamed `label_in`.
/// @param labels one per point. @throws Error (usage) if their number differs from the number of
///     points.
Cloud with_labels(const Cloud& cloud, std::span<const std::uint32_t> labels);
/// Writes `with_labels` to a .pcd or .ply file, with the names and types that PCL and Open3D read:
/// docs/reference/formats.md, "Segmented clouds".
void write_cloud(const std::filesystem::path& path, const Cloud& cloud,
                 std::span<const std::uint32_t> labels);

}  // namespace ph::segment
