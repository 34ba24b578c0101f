// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/merge_tree.hpp"
#include "ph/run_context.hpp"

/// The merge tree of a scene, and how to cut it. All lengths are in metres.
namespace ph::segment {

/// A point or a direction: x, y, z.
using Vec3 = std::array<double, 3>;

/// An axis-aligned box, including its borders.
struct Box {
  Vec3 min{};
  Vec3 max{};
  friend bool operator==(const Box&, const Box&) = default;
};

/// The rule that decides which voxels belong together. Stored trees hold these numbers: never
/// change one.
enum class Method {
  surface = 0,      ///< the shape of the visible surface: cuts where it is concave, so that objects
                    ///< that touch come apart
  paper = 1,        ///< the distance alone (Beksi & Papanikolopoulos, ICRA 2016)
  supervoxels = 2,  ///< pieces of similar size that do not cross seams: the distance along the
                    ///< surface to evenly spread seeds
};
/// The names of the methods, by number.
inline constexpr std::array<std::string_view, 3> kMethodNames = {"surface", "paper", "supervoxels"};

/// The plane normal·x + offset = 0. Its unit normal points towards the sensor: the signed distance
/// of a point is positive on the sensor's side.
struct Plane {
  Vec3 normal{};
  double offset = 0;  ///< metres
  double share = 0;   ///< share of the points in range that lie on the plane, 0…1
  double signed_distance(double x, double y, double z) const {
    return normal[0] * x + normal[1] * y + normal[2] * z + offset;
  }
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// The role of a part of a scene for grasping.
enum class Role {
  object = 0,
  support = 1,  ///< a plane that objects stand on: a table, a board, the floor
  wall = 2,  ///< a plane that hides everything behind it: a wall, the back or the side of a cabinet
  container = 3,  ///< a segment with at least three objects in it, such as a bin
  floor = 4,      ///< the lowest support of several, below which nothing is seen
  shelf = 5,      ///< a support with another support above or below it, other than the floor
  ceiling = 6     ///< a plane that faces the support and hides everything behind it
};
/// The names of the roles, by number.
inline constexpr std::array<std::string_view, 7> kRoleNames = {
    "object", "support", "wall", "container", "floor", "shelf", "ceiling"};

constexpr std::string_view role_name(Role role) {
  return kRoleNames[static_cast<std::size_t>(role)];
}

/// True if objects may stand on a surface of this role.
constexpr bool is_support(Role role) {
  return role == Role::support || role == Role::floor || role == Role::shelf;
}

/// A box with its own axes.
struct OrientedBox {
  Vec3 centre{};
  std::array<Vec3, 3> axes{};  ///< unit vectors, right-handed
  Vec3 size{};                 ///< full lengths along the axes, metres
  friend bool operator==(const OrientedBox&, const OrientedBox&) = default;
};

/// A plane that bounds a scene. It is not a segment.
struct SceneSurface {
  Role role = Role::support;  ///< neither object nor container
  Plane plane;
  /// The box of the points that were removed with it; axes[2] is the normal of the plane. The size
  /// is zero if no points were removed with it.
  OrientedBox oriented_box{};
  friend bool operator==(const SceneSurface&, const SceneSurface&) = default;
};

/// The largest number of surfaces, because each point stores its surface in one byte.
inline constexpr std::size_t kMostSurfaces = 255;

/// The concavity of a flat surface at a range, caused by the sensor's noise.
struct NoiseAt {
  double range = 0;      ///< distance from the viewpoint, metres
  double concavity = 0;  ///< the concavity of 84 % of the free supporting plane is below it
};

/// A segment that touches another segment.
struct Neighbour {
  std::uint32_t label = 0;
  double meets_at = 0;  ///< value of the first edge of the graph that joins the two segments
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// The support of a segment: a surface, another segment or neither.
struct StandsOn {
  std::uint32_t surface = 0;  ///< number, from 1, of a support among the surfaces of the scene
  std::uint32_t segment = 0;  ///< label of a segment
  friend bool operator==(const StandsOn&, const StandsOn&) = default;
};

/// One segment with enough voxels: a component of infinite persistence (paper), a basin of the
/// merge tree (supervoxels), or the basins that are parts of one object (surface).
struct Segment {
  std::uint32_t label = 0;  ///< 1…k by decreasing number of points
  Index points = 0;
  Index voxels = 0;
  /// The persistence: the value at which the segment first touches another one, minus the value of
  /// its birth, in metres (paper, supervoxels) or in units of the noise (surface). It is infinite
  /// if the segment touches none. It measures the confidence in the segment.
  double persistence = kInfinity;
  std::uint32_t neighbour = 0;  ///< neighbours.front(); 0: none
  double meets_at = kInfinity;  ///< value of the filtration at which it first touches a neighbour
  /// Mean of its points, without the points that were at first removed with the plane.
  Vec3 centroid{};
  Box box;  ///< axis-aligned box of its points
  /// The tightest box of its points. If a plane was removed, the box stands on it: axes[2] is the
  /// normal of the plane, and axes[0] is the longer side of the smallest rectangle around the
  /// projections of the points onto the plane. Without a plane, the axes are the principal axes,
  /// longest first.
  OrientedBox oriented_box{};
  Role role = Role::object;           ///< object, container, or support: a leg of a table
  StandsOn on;                        ///< its support, as far as this is visible
  std::vector<Neighbour> neighbours;  ///< all segments that it touches, first contact first
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Where to cut a merge tree.
struct CutOptions {
  /// The least persistence of a part, in units of the noise (surface) or metres (supervoxels). For
  /// method paper, the distance at which components are taken, in metres, at most the distance of
  /// the tree. The value is >= 0.
  double value = 1;
  /// Not paper: the fewest voxels of a part, >= 1. A smaller part joins a neighbouring part.
  Index min_part = 200;
  Index min_size = 32;  ///< fewest voxels of a segment, >= 1
  bool objects = true;  ///< surface: join the visible parts of an object
  friend bool operator==(const CutOptions&, const CutOptions&) = default;
};

/// The merge tree of a scene, which records how its voxels join (each merge with its value, its
/// edge, sizes and births), and all data of the scene that are needed to turn a cut into segments.
/// It refers to nothing outside itself.
struct SceneTree {
  Method method = Method::surface;
  double voxel = 0;            ///< edge of a voxel, metres
  double distance = 0;         ///< paper: maximum distance of the complex, metres
  int steps = 0;               ///< paper: number of levels up to `distance`; 0: exact deaths
  Vec3 viewpoint{};            ///< position of the sensor
  std::optional<Plane> plane;  ///< the removed plane
  /// The planes that bound the scene: first the removed planes, beginning with `plane`, then the
  /// planes found among the components (walls, ceilings). At most kMostSurfaces.
  std::vector<SceneSurface> surfaces;
  /// For method surface: the noise at several ranges, nearest range first. Empty if too little of
  /// the supporting plane was visible.
  std::vector<NoiseAt> noise;
  Index removed = 0;     ///< number of surfaces that were removed, with everything behind them
  Index width = 0;       ///< columns of the cloud; points of an unorganised cloud
  Index height = 1;      ///< rows of the cloud; 1 if it is unorganised
  CutOptions first_cut;  ///< the cut of the segmentation that made the tree
  std::size_t cloud_size() const { return static_cast<std::size_t>(width * height); }

  // The next three members describe the points that have a vertex, in the order of the cloud.
  std::vector<Index> points;                   ///< their numbers in the cloud, ascending
  std::vector<std::uint32_t> vertex_of_point;  ///< their vertices
  std::vector<float> xyz;                      ///< their coordinates

  /// For each point of the cloud: the number, from 1, of the removed surface on which it lies; 0:
  /// none.
  std::vector<std::uint8_t> removed_with;

  // The next four members describe the vertices, which are the voxels in the order of the grid (z
  // slowest).
  std::vector<Vec3> cells;  ///< whole numbers: the corner of the voxel, divided by the voxel's edge
  Points vertices;          ///< centroids, one per row
  Points normals;  ///< not paper: unit normals, one per row, NaN where there is none; else 0 rows
  std::vector<Index> counts;  ///< number of points that the centroid averages

  Index edges = 0;       ///< edges of the filtered graph
  MergeTree merge_tree;  ///< the merges of the vertices, with their values
};

/// The segments of one cut.
struct SceneCut {
  std::vector<std::uint32_t> labels;         ///< one per point: 0 for none, 1…k
  std::vector<Segment> segments;             ///< segment i has label i + 1
  std::vector<std::uint32_t> vertex_labels;  ///< one per vertex: 0 for none, 1…k for the segments
  /// For each point of the cloud: the number, from 1, of the surface on which it lies; 0: none.
  std::vector<std::uint8_t> surface_labels;
};

/// Makes a coarser or finer cut within milliseconds, without a new segmentation. It determines anew
/// which voxels are near each other, which parts make an object (not paper), which segments touch,
/// and the properties of each segment; planes, voxels, normals and the tree are taken from `scene`.
/// `cut(scene, scene.first_cut)` gives the result of ph::segment::segment.
/// @throws Error (usage) on an option out of its range, or a distance beyond the tree's; Error
///         (bad_data) if arrays of the scene disagree. All functions below throw the same errors.
SceneCut cut(const SceneTree& scene, const CutOptions& options,
             const RunContext& context = default_context());

/// The place where two segments first meet as the filtration grows.
struct Meeting {
  /// Filtration value in metres (paper, supervoxels) or in units of the noise (surface).
  double value = 0;
  Vec3 at{};  ///< a point between the two voxels whose edge joins the segments
};
/// The first meeting of segments `a` and `b`; empty if they never meet. @throws Error (usage)
/// unless both labels belong to segments.
std::optional<Meeting> first_meeting(const SceneTree& scene, const SceneCut& cut, std::uint32_t a,
                                     std::uint32_t b);

/// The tree as a file; docs/explanation/segmentation.md describes its bytes.
std::string tree_bytes(const SceneTree& scene);
/// The same tree as JSON, for other programs; libph does not read it back.
std::string tree_json(const SceneTree& scene);
/// True if a file begins like the output of `tree_bytes`.
bool is_tree(const Input& input);
/// Reads only what `tree_bytes` wrote, and checks every number and the checksum at its end. @throws
/// Error (bad_data) naming the byte.
SceneTree read_tree(const Input& input);
SceneTree read_tree(const std::filesystem::path& path);

}  // namespace ph::segment
