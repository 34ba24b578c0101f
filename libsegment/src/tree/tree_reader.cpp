// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "libsegment/src/tree/tree_file.hpp"
#include "libsegment/src/vessels/stages.hpp"
#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/error.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 32;  // points and vertices have 32-bit numbers
constexpr std::size_t kWord = kTreeWord, kHeader = kTreeHeader, kSum = kTreeSum;

/// The largest number of edges of a graph. `vertices` is at most 2^32 - 2, so the sum of both
/// numbers fits into 63 bits.
std::int64_t most_edges(std::int64_t vertices) {
  const auto n = static_cast<std::uint64_t>(vertices);
  return n == 0 ? 0 : static_cast<std::int64_t>(n * (n - 1) / 2);
}

/// Reads a tree and reports the byte at which something is wrong.
class TreeReader {
 public:
  explicit TreeReader(const Input& input)
      : input_(input), cursor_(input, std::endian::little, kTreeMagic.size()) {}

  SceneTree read() {
    read_header();
    require_size_and_sum();
    const auto n = static_cast<std::size_t>(vertices_);
    // This includes the arrays, and the memory for rebuilding the tree.
    constexpr std::size_t bytes_a_vertex = 400;
    input_.require_memory(input_.size() + n * bytes_a_vertex);
    read_surfaces();
    read_noise();
    read_vertices(n);
    read_tree(n);
    read_points();
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(std::string what, std::string found, std::string expected) const {
    input_.fail_at_byte(at_, {std::move(what), std::move(found), std::move(expected), {}});
  }
  std::int64_t integer(const char* what, std::int64_t least, std::int64_t most) {
    at_ = cursor_.offset();
    const auto value = cursor_.read<std::int64_t>(what);
    if (value < least || value > most)
      fail(what, fmt::format("{}", value), fmt::format("{} to {}", least, most));
    return value;
  }
  /// A number from `least` to `most`. Infinite bounds are left out of the message.
  double number(const char* what, double least = -kInfinity, double most = kInfinity,
                bool infinite = false) {
    at_ = cursor_.offset();
    const auto value = cursor_.read<double>(what);
    const bool is_fine = value >= least && value <= most && (infinite || std::isfinite(value));
    if (is_fine) return value;
    std::string expected = infinite ? "a number" : "a finite number";
    if (least != -kInfinity) expected += fmt::format(" of at least {}", least);
    if (most != kInfinity) expected += fmt::format(", at most {}", most);
    fail(what, fmt::format("{}", value), expected);
  }
  Vec3 finite(const char* what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
  }
  void require_unit(const char* what, const Vec3& v) const {
    constexpr double tolerance = 1e-6;
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(std::abs(length - 1) <= tolerance))
      fail(what, fmt::format("length {}", length), "length 1");
  }

  void require_version() {
    at_ = cursor_.offset();
    const auto version = cursor_.read<std::int64_t>("version");
    if (version != kTreeVersion)
      input_.fail_at_byte(at_,
                          {"version", fmt::format("{}", version), fmt::format("{}", kTreeVersion),
                           "another version of libph wrote this tree; segment the cloud again"});
  }
  void read_header() {
    constexpr std::int64_t most_steps = std::numeric_limits<int>::max();
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    constexpr std::int64_t most_noise = 64;
    require_version();
    scene_.method = static_cast<Method>(integer("method", 0, 2));
    scene_.width = integer("width", 0, kMost);
    scene_.height = integer("height", scene_.width > 0 ? 1 : 0, kMost);
    vertices_ =
        integer("number of vertices", 0, kMost - 2 - static_cast<std::int64_t>(kMostSurfaces));
    merges_ = integer("number of merges", 0, std::max<std::int64_t>(vertices_ - 1, 0));
    points_ = integer("number of points with a vertex", 0, kMost);
    scene_.edges = integer("number of edges", merges_, most_edges(vertices_));
    scene_.voxel = number("voxel", vertices_ > 0 ? kLeastVoxel : 0, kMostVoxel);
    scene_.viewpoint = finite("viewpoint");
    scene_.distance = number("distance", 0);
    scene_.steps = static_cast<int>(integer("steps", 0, most_steps));
    const bool has_plane = integer("plane", 0, 1) == 1;
    // Without a plane, the numbers of the plane are zeros.
    const double end = has_plane ? kInfinity : 0;
    Plane plane;
    for (double& n : plane.normal) n = number("normal of the plane", -end, end);
    if (has_plane) require_unit("normal of the plane", plane.normal);
    plane.offset = number("offset of the plane", -end, end);
    plane.share = number("share of the plane", 0, has_plane ? 1 : 0);
    if (has_plane) scene_.plane = plane;
    CutOptions& cut = scene_.first_cut;
    const bool paper = scene_.method == Method::paper;
    cut.value = number("value of the cut", 0, paper ? scene_.distance : kInfinity, !paper);
    cut.min_part = integer("fewest voxels of a part", 1, most);
    cut.min_size = integer("fewest voxels of a segment", 1, most);
    cut.objects = integer("whether parts are joined", 0, 1) == 1;
    surfaces_ = integer("number of surfaces", has_plane ? 1 : 0,
                        has_plane ? static_cast<std::int64_t>(kMostSurfaces) : 0);
    scene_.removed = integer("number of removed surfaces", has_plane ? 1 : 0, surfaces_);
    noise_ = integer("number of noises", 0, has_plane && !paper ? most_noise : 0);
  }

  void read_surfaces() {
    for (std::int64_t k = 0; k < surfaces_; ++k) {
      SceneSurface& surface = scene_.surfaces.emplace_back();
      surface.role = static_cast<Role>(integer("role of a surface", 1, std::ssize(kRoleNames) - 1));
      if (surface.role == Role::container)
        fail("role of a surface", "a container", "a surface, which is no segment");
      if (k == 0 && !is_support(surface.role))
        fail("role of the first surface", std::string(role_name(surface.role)), "a support");
      surface.plane.normal = finite("normal of a surface");
      require_unit("normal of a surface", surface.plane.normal);
      surface.plane.offset = number("offset of a surface");
      surface.plane.share = number("share of a surface", 0, 1);
      OrientedBox& box = surface.oriented_box;
      box.centre = finite("centre of a surface");
      for (Vec3& axis : box.axes) axis = finite("axis of a surface");
      for (double& size : box.size) size = number("size of a surface", 0);
      if (k == 0 && surface.plane != *scene_.plane)
        fail("first surface", "a different plane", "the plane of the header");
    }
  }

  void read_noise() {
    double range = 0;
    for (std::int64_t k = 0; k < noise_; ++k) {
      NoiseAt& noise = scene_.noise.emplace_back();
      noise.range = range = number("range of a noise", range);
      noise.concavity = number("noise", 0);
    }
  }

  /// Checks the size of the file and its checksum before anything is allocated. No product
  /// overflows. The factors are below 2^33, and the product of width and height is checked before
  /// it is multiplied again.
  void require_size_and_sum() {
    const auto cloud = checked_product(static_cast<std::size_t>(scene_.width),
                                       static_cast<std::size_t>(scene_.height));
    at_ = 3 * kWord;
    if (!cloud || *cloud > static_cast<std::size_t>(kMost))
      fail("width times height", "more than 2^32", "at most 2^32");
    const std::size_t vectors = scene_.method != Method::paper ? 3 : 2;  // 3 with normals
    const std::size_t expected = kHeader + static_cast<std::size_t>(surfaces_) * kTreeSurface +
                                 static_cast<std::size_t>(noise_) * kTreeNoise +
                                 static_cast<std::size_t>(vertices_) * (3 * vectors + 2) * kWord +
                                 static_cast<std::size_t>(merges_) * 2 * kWord +
                                 *cloud * sizeof(std::uint32_t) +
                                 static_cast<std::size_t>(points_) * 3 * sizeof(float) + kSum;
    at_ = input_.size();
    if (input_.size() != expected) {
      fail(input_.size() < expected ? "truncated" : "trailing data",
           fmt::format("{} bytes", input_.size()), fmt::format("{}, as the header says", expected));
    }
    at_ = input_.size() - kSum;
    const auto stored = load<std::uint32_t>(input_.bytes().data() + at_, std::endian::little);
    const std::uint32_t sum = tree_sum(input_.text().substr(0, at_));
    if (stored != sum)
      fail("checksum", fmt::format("{:#010x}", stored), fmt::format("{:#010x}", sum));
  }

  void read_vertices(std::size_t n) {
    scene_.cells.resize(n);
    for (std::size_t v = 0; v < n; ++v) {
      Vec3& cell = scene_.cells[v];
      cell = finite("corner of a voxel");
      for (const double c : cell) {
        if (c != std::floor(c)) fail("corner of a voxel", fmt::format("{}", c), "a whole number");
        if (scene_.method != Method::paper && !(std::abs(c) <= kMostExactCell))
          fail("corner of a voxel", fmt::format("{}", c),
               fmt::format("at most {} in absolute value", kMostExactCell));
      }
      // In the order of the grid, z varies slowest.
      if (v > 0 &&
          !std::ranges::lexicographical_compare(
              scene_.cells[v - 1].rbegin(), scene_.cells[v - 1].rend(), cell.rbegin(), cell.rend()))
        fail("corner of a voxel", "one that is out of order", "the order of the grid");
    }
    scene_.vertices = Points(vertices_, 3);
    for (std::size_t v = 0; v < n; ++v) {
      const Vec3 c = finite("centroid");
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr double tolerance = 1e-6;
        const double middle = (scene_.cells[v][k] + 0.5) * scene_.voxel;
        const double reach = (0.5 + tolerance) * scene_.voxel + 1e-12 * std::abs(middle);
        if (!(std::abs(c[k] - middle) <= reach))
          fail("centroid", fmt::format("{}", c[k]), "a point of its voxel");
        scene_.vertices(static_cast<Index>(v), static_cast<Index>(k)) = c[k];
      }
    }
    if (scene_.method != Method::paper) read_normals();
    scene_.counts.resize(n);
    for (Index& count : scene_.counts) count = integer("points of a voxel", 1, points_);
  }

  void read_normals() {
    scene_.normals = Points(vertices_, 3);
    for (Index v = 0; v < vertices_; ++v) {
      at_ = cursor_.offset();
      Vec3 normal;
      for (double& n : normal) n = cursor_.read<double>("normal");
      if (!std::ranges::all_of(normal, [](double n) { return std::isnan(n); }))
        require_unit("normal", normal);
      std::ranges::copy(normal, scene_.normals.row(v).begin());
    }
  }

  void read_tree(std::size_t n) {
    std::vector<double> births(n);
    const double latest = scene_.method == Method::paper ? 0 : kInfinity;
    for (double& birth : births) birth = number("birth", 0, latest);
    const std::size_t first = cursor_.offset();
    std::vector<WeightedEdge> forest;
    forest.reserve(static_cast<std::size_t>(merges_));
    for (std::int64_t i = 0; i < merges_; ++i) {
      const double value = number("value of a merge", 0);
      const auto u = cursor_.read<std::uint32_t>("edge of a merge");
      const auto v = cursor_.read<std::uint32_t>("edge of a merge");
      if (u >= n || v >= n || u == v)
        fail("edge of a merge", fmt::format("{}-{}", u, v), fmt::format("two of {} vertices", n));
      if (value < std::max(births[u], births[v]))
        fail("value of a merge", fmt::format("{}", value), "no less than the births of its edge");
      forest.push_back({Index{u}, Index{v}, value});
    }
    RunContext none;
    const RunContext& context = input_.context() ? *input_.context() : none;
    scene_.merge_tree = merge_tree(FilteredGraph(births, forest, context), context);
    for (std::size_t i = 0; i < forest.size(); ++i) {
      at_ = first + i * 2 * kWord;
      const auto& merges = scene_.merge_tree.merges;
      if (i < merges.size() && merges[i].u == forest[i].u && merges[i].v == forest[i].v &&
          merges[i].value == forest[i].value)
        continue;
      fail("merge", fmt::format("edge {}-{}", forest[i].u, forest[i].v),
           "the edges of a forest, by value");
    }
  }

  void read_points() {
    const auto n = static_cast<std::uint32_t>(vertices_);
    scene_.points.reserve(static_cast<std::size_t>(points_));
    scene_.vertex_of_point.reserve(static_cast<std::size_t>(points_));
    std::int64_t with_vertex = 0;
    scene_.removed_with.resize(scene_.cloud_size());
    for (Index i = 0; i < scene_.width * scene_.height; ++i) {
      at_ = cursor_.offset();
      const auto v = cursor_.read<std::uint32_t>("vertex of a point");
      if (const std::uint32_t surface = kTreeNoVertex - v; surface <= scene_.removed) {
        scene_.removed_with[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(surface);
        continue;
      }
      if (v >= n)
        fail("vertex of a point", fmt::format("{}", v), fmt::format("one of {} vertices", n));
      if (++with_vertex > points_) continue;
      scene_.points.push_back(i);
      scene_.vertex_of_point.push_back(v);
    }
    if (with_vertex != points_)
      fail("points with a vertex", fmt::format("{}", with_vertex), fmt::format("{}", points_));
    read_coordinates(n);
  }

  void read_coordinates(std::uint32_t n) {
    std::vector<Index> inside(n);
    scene_.xyz.reserve(3 * static_cast<std::size_t>(points_));
    for (const std::uint32_t v : scene_.vertex_of_point) {
      at_ = cursor_.offset();
      Vec3 point;
      for (double& x : point) {
        const auto coordinate = cursor_.read<float>("coordinate");
        if (!std::isfinite(coordinate))
          fail("coordinate", fmt::format("{}", coordinate), "a finite number");
        scene_.xyz.push_back(coordinate);
        x = coordinate;
      }
      if (is_inside(point, scene_.cells[v]))
        ++inside[v];
      else if (!may_be_base(point, v) && !may_be_bottom(point, v))
        fail("coordinates", fmt::format("({}, {}, {})", point[0], point[1], point[2]),
             "a point of its voxel, of the plane at its base, or seen through an opening above it");
    }
    for (std::uint32_t v = 0; v < n; ++v)
      if (inside[v] < scene_.counts[v])
        fail("points of a voxel", fmt::format("{}", inside[v]),
             fmt::format("at least {}", scene_.counts[v]));
  }
  bool is_inside(const Vec3& point, const Vec3& cell) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (std::floor(point[k] / scene_.voxel) != cell[k]) return false;
    return true;
  }
  /// True if the point may have been recovered from a removed plane for this voxel.
  bool may_be_base(const Vec3& point, std::uint32_t v) const {
    if (scene_.method == Method::paper) return false;
    const auto removed = std::span(scene_.surfaces).first(static_cast<std::size_t>(scene_.removed));
    return std::ranges::any_of(
        removed, [&](const SceneSurface& s) { return is_in_strip(s.plane, point, centroid(v)); });
  }
  /// True if the point may be in the strip of the plane below a voxel. The margin of the plane is
  /// not stored in the tree. It is only known that the voxel is beyond the margin.
  bool is_in_strip(const Plane& plane, const Vec3& point, const Vec3& of_voxel) const {
    // `aside` is in voxels, and `up` is a multiple of the voxel's height.
    constexpr double aside = 3, up = 4;
    const double height = plane.signed_distance(point[0], point[1], point[2]);
    const double voxel_height = plane.signed_distance(of_voxel[0], of_voxel[1], of_voxel[2]);
    if (!(height > 0 && height <= up * (voxel_height + scene_.voxel))) return false;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k)
      square += std::pow(point[k] - of_voxel[k] - (height - voxel_height) * plane.normal[k], 2);
    return square <= std::pow(aside * scene_.voxel, 2);
  }

  /// True if the point may belong to the bottom of a vessel, and v is the lowest voxel of this
  /// vessel.
  bool may_be_bottom(const Vec3& point, std::uint32_t v) const {
    // mutant: opening-supervoxels
    return scene_.plane && scene_.method == Method::surface &&
           may_be_in_opening(*scene_.plane, point, centroid(v));
  }
  Vec3 centroid(std::uint32_t v) const {
    return {scene_.vertices(v, 0), scene_.vertices(v, 1), scene_.vertices(v, 2)};
  }

  const Input& input_;
  BinaryCursor cursor_;
  SceneTree scene_;
  std::size_t at_ = 0;  // the place of the current value
  std::int64_t vertices_ = 0, merges_ = 0, points_ = 0, surfaces_ = 0, noise_ = 0;
};

}  // namespace

bool is_tree(const Input& input) { return input.text().starts_with(kTreeMagic); }

SceneTree read_tree(const Input& input) {
  if (!is_tree(input)) {
    input.fail_at_byte(0, {"not a stored tree",
                           printable(input.text().substr(0, kTreeMagic.size())),
                           printable(kTreeMagic),
                           {}});
  }
  return TreeReader(input).read();
}

SceneTree read_tree(const std::filesystem::path& path) { return read_tree(Input::open(path)); }

}  // namespace ph::segment
