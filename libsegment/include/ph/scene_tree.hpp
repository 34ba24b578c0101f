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

/// The merge tree of a scene, and the cuts of it. All lengths are metres.
namespace ph::segment {

/// A point or a direction: x, y, z.
using Vec3 = std::array<double, 3>;

/// An axis-aligned box, borders included.
struct Box {
  Vec3 min{};
  Vec3 max{};
  friend bool operator==(const Box&, const Box&) = default;
};

/// What decides which voxels belong together. The numbers are those of stored trees: never change
/// one.
enum class Method {
  surface = 0,      ///< the shape of the visible surface: cut where it is hollow, so that objects
                    ///< that touch come apart
  paper = 1,        ///< distance alone: Beksi & Papanikolopoulos, ICRA 2016
  supervoxels = 2,  ///< pieces of about one size that do not cross seams: the distance along the
                    ///< surface to evenly spread seeds
};
/// What they are called, by number.
inline constexpr std::array<std::string_view, 3> kMethodNames = {"surface", "paper", "supervoxels"};

/// The plane normal·x + offset = 0, its unit normal turned towards the sensor: the signed distance
/// of a point is positive on the sensor's side.
struct Plane {
  Vec3 normal{};
  double offset = 0;  ///< metres
  double share = 0;   ///< share of the points in range that lie on it, 0…1
  double signed_distance(double x, double y, double z) const {
    return normal[0] * x + normal[1] * y + normal[2] * z + offset;
  }
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// What a part of a scene is to those who want to take hold of things.
enum class Role {
  object = 0,
  support = 1,  ///< a plane that objects stand on: a table, a board, the floor
  wall = 2,     ///< a plane behind which nothing is seen: a wall, the back or the side of a cabinet
  unknown = 3   ///< it may be an object; it is cut off, and what it stands on is not seen
};
/// What they are called, by number.
inline constexpr std::array<std::string_view, 4> kRoleNames = {"object", "support", "wall",
                                                               "unknown"};

constexpr std::string_view role_name(Role role) {
  return kRoleNames[static_cast<std::size_t>(role)];
}

/// A plane that bounds a scene. It is no segment.
struct SceneSurface {
  Role role = Role::support;  ///< support or wall
  Plane plane;
  friend bool operator==(const SceneSurface&, const SceneSurface&) = default;
};

/// A point says in a byte which surface it is on.
inline constexpr std::size_t kMostSurfaces = 255;

/// How concave a flat surface looks at a range: the noise of the sensor in the filtration.
struct NoiseAt {
  double range = 0;      ///< from the viewpoint, metres
  double concavity = 0;  ///< of the free supporting plane: 84 % of it is below that
};

/// A box with axes of its own.
struct OrientedBox {
  Vec3 centre{};
  std::array<Vec3, 3> axes{};  ///< unit, right-handed
  Vec3 size{};                 ///< whole lengths along the axes, metres
  friend bool operator==(const OrientedBox&, const OrientedBox&) = default;
};

/// A segment that touches another one.
struct Neighbour {
  std::uint32_t label = 0;
  double meets_at = 0;  ///< value of the first edge of the graph that joins the two
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// What a segment stands on: one of both, or neither.
struct StandsOn {
  std::uint32_t surface = 0;  ///< number, from 1, of a support among the surfaces of the scene
  std::uint32_t segment = 0;  ///< label of a segment
  friend bool operator==(const StandsOn&, const StandsOn&) = default;
};

/// One segment with enough voxels: a component of infinite persistence (paper), a basin of the
/// merge tree (supervoxels), or basins that are parts of one object (surface).
struct Segment {
  std::uint32_t label = 0;  ///< 1…k by decreasing number of points
  Index points = 0;
  Index voxels = 0;
  /// How much higher than where it was born it first touches another segment: in metres (paper,
  /// supervoxels) or in units of the noise (surface). Infinite if it touches none. The confidence
  /// in it.
  double persistence = kInfinity;
  std::uint32_t neighbour = 0;  ///< neighbours.front(); 0: none
  double meets_at = kInfinity;  ///< value of the filtration at which it does
  Vec3 centroid{};              ///< mean of its points, without those won back from the plane
  Box box;                      ///< of its points
  /// Of its points, as tight as can be. Where a plane was removed it stands on it: axes[2] is the
  /// normal of the plane and axes[0] the longer side of the smallest rectangle around what the
  /// points cover of the plane. Without a plane: the principal axes, longest first.
  OrientedBox oriented_box;
  Role role = Role::unknown;          ///< object or unknown
  StandsOn on;                        ///< as far as it is seen
  std::vector<Neighbour> neighbours;  ///< all segments that it touches, the first met first
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Where to cut a merge tree.
struct CutOptions {
  /// Least persistence of a part, in units of the noise (surface) or metres (supervoxels). Method
  /// paper: components at this distance, metres, at most that of the tree. >= 0.
  double value = 1;
  Index min_part =
      200;  ///< not paper: fewest voxels of a part; a smaller one joins a neighbour, >= 1
  Index min_size = 32;  ///< fewest voxels of a segment, >= 1
  bool objects = true;  ///< surface: join the visible parts of an object
  /// Surface: least strength of a seam between parts, in multiples of `value`; 0: persistence, that
  /// is the lowest place of a seam, is all that is looked at. >= 0.
  double min_seam = 2;
  friend bool operator==(const CutOptions&, const CutOptions&) = default;
};

/// How the voxels of a scene join: each merge with its value, the edge that joined, sizes and
/// births
/// (`tree`), and what is needed of the scene to make segments of a cut. A value: it refers to
/// nothing outside.
struct SceneTree {
  Method method = Method::surface;
  double voxel = 0;            ///< edge of a voxel, metres
  double distance = 0;         ///< paper: maximum distance of the complex, metres
  int steps = 0;               ///< paper: levels up to it; 0: exact deaths
  Vec3 viewpoint{};            ///< where the sensor stood
  std::optional<Plane> plane;  ///< the plane that was removed
  /// What bounds the scene: first the planes that were removed, `plane` before all others, then
  /// those that were found among the components: boards, walls. At most kMostSurfaces.
  std::vector<SceneSurface> surfaces;
  /// Method surface: nearest first; empty if too little of a supporting plane was seen.
  std::vector<NoiseAt> noise;
  Index removed = 0;     ///< how many of them were removed, with what is behind them
  Index width = 0;       ///< columns of the cloud; of an unorganised one its points
  Index height = 1;      ///< rows of the cloud; 1 if it is not organised
  CutOptions first_cut;  ///< the cut that the segmentation was made with
  std::size_t cloud_size() const { return static_cast<std::size_t>(width * height); }

  // By point that has a vertex, in the order of the cloud.
  std::vector<Index> points;                   ///< its number in the cloud, ascending
  std::vector<std::uint32_t> vertex_of_point;  ///< its vertex
  std::vector<float> xyz;                      ///< its coordinates

  /// By point of the cloud: the number, from 1, of the removed surface that it is on; 0: none.
  std::vector<std::uint8_t> removed_with;

  // By vertex, that is, by voxel in the order of the grid (z slowest).
  std::vector<Vec3> cells;  ///< whole numbers: the corner of the voxel / voxel
  Points vertices;          ///< centroid, one a row
  Points normals;  ///< not paper: unit normal, one a row, NaN where there is none; else 0 rows
  std::vector<Index> counts;  ///< points that the centroid is the mean of

  Index edges = 0;  ///< edges of the filtered graph
  MergeTree tree;   ///< which vertices join, at which value
};

/// The segments of one cut.
struct SceneCut {
  std::vector<std::uint32_t> labels;  ///< one a point of the cloud: 0 none, 1…k the segments
  std::vector<Segment> segments;      ///< segment i has label i + 1
  std::vector<std::uint32_t> vertex_labels;  ///< one a vertex: 0 none, 1…k the segments
  /// One a point of the cloud: the number, from 1, of the surface that it is on; 0: none.
  std::vector<std::uint8_t> surface_labels;
};

/// A coarser or finer cut without segmenting anew: milliseconds. What is found anew is which voxels
/// are near each other and which parts make an object (not paper), which segments touch, and what
/// is said of each; planes, voxels, normals and the tree are those of `scene`. `cut(scene,
/// scene.first_cut)` is what ph::segment::segment gave.
/// @throws Error (usage) on an option out of its range, or a distance beyond that of the tree;
///         Error (bad_data) if arrays of the scene disagree. So do all functions below.
SceneCut cut(const SceneTree& scene, const CutOptions& options,
             const RunContext& context = default_context());

/// Where two segments meet first as the filtration grows.
struct Meeting {
  double value = 0;  ///< of the filtration: metres (paper, supervoxels) or noise (surface)
  Vec3 at{};         ///< between the two voxels whose edge joins them
};
/// @return nothing if they never meet. @throws Error (usage) on labels that are not those of two
/// segments.
std::optional<Meeting> first_meeting(const SceneTree& scene, const SceneCut& cut, std::uint32_t a,
                                     std::uint32_t b);

/// The tree as a file; docs/explanation/segmentation.md says what its bytes are.
std::string tree_bytes(const SceneTree& scene);
/// The same as JSON, for other programs; it is not read back.
std::string tree_json(const SceneTree& scene);
/// Whether a file begins as `tree_bytes` does.
bool is_tree(const Input& input);
/// Reads what `tree_bytes` wrote, nothing else: every number is checked, and so is the sum at its
/// end. @throws Error (bad_data) naming the byte.
SceneTree read_tree(const Input& input);
SceneTree read_tree(const std::filesystem::path& path);

}  // namespace ph::segment
