// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"

namespace ph {

/// The name of a way to compute a barcode. The engines of libph are listed below; a program can add
/// its own with add_engine, see ph/custom.hpp.
class Engine {
 public:
  constexpr Engine() = default;  ///< Engine::automatic
  /// @param name words in lower case, joined by hyphens; the text must live as long as the program.
  explicit constexpr Engine(std::string_view name) : name_(name) {}

  constexpr std::string_view name() const { return name_; }
  friend constexpr bool operator==(Engine, Engine) = default;

  static const Engine automatic;   ///< chosen from the complex and the task
  static const Engine standard;    ///< the oracle: slow textbook reduction
  static const Engine twist;       ///< boundary matrix with clearing
  static const Engine cohomology;  ///< coboundary matrix with clearing and shortcuts
  static const Engine union_find;  ///< H0 only
  static const Engine edge_links;  ///< Rips, H0 to H3: edge by edge
  /// Rips of points with few coordinates, H0 and H1; lists no edges.
  static const Engine beta_skeleton;
  static const Engine gradient;  ///< images voxel by voxel, alpha complexes interval by interval

 private:
  std::string_view name_ = "auto";
};

inline constexpr Engine Engine::automatic{};
inline constexpr Engine Engine::standard{"standard"};
inline constexpr Engine Engine::twist{"twist"};
inline constexpr Engine Engine::cohomology{"cohomology"};
inline constexpr Engine Engine::union_find{"union-find"};
inline constexpr Engine Engine::edge_links{"edge-links"};
inline constexpr Engine Engine::beta_skeleton{"beta-skeleton"};
inline constexpr Engine Engine::gradient{"gradient"};

/// The engine with this name or former name ("lens", "arrows", "union_find"); empty if there is
/// none.
std::optional<Engine> engine_named(std::string_view name);
/// The names of all engines: "auto" comes first, and engines that the program added come last.
std::vector<std::string_view> engine_names();

/// The form in which a Rips filtration is stored while something is computed from it. Each form is
/// enough for some tasks; `plan` chooses one (ph/persistence.hpp).
enum class RipsForm : std::uint8_t {
  edges,           ///< all edges up to the threshold: enough for everything
  distinct_edges,  ///< the edges of the distinct points; see RipsOptions::merge_equal_points
  forest,          ///< a minimum spanning forest: enough for H0 with its cells, and for merge trees
  points,          ///< only the distinct points: enough for Engine::beta_skeleton
};

/// A Rips filtration that has no form yet; see ph/rips.hpp.
struct RipsInput;

/// A task for an engine.
struct Task {
  int max_dim = 0;  ///< highest dimension of homology
  Representatives representatives = Representatives::none;
  bool zero_length = false;  ///< pairs of cells of equal value are wanted as well
  bool collapses = false;    ///< an edge collapse is wanted
  /// True if no sets of voxels are requested: the bars need chains at most.
  bool wants_no_sets() const { return representatives != Representatives::voxels; }
};

/// How well an engine suits a task.
struct Suitability {
  /// The engine with the highest rank is chosen; an engine with rank 0 runs only on request.
  int rank = 0;
  std::string_view reason;  ///< the reason for choosing it, in one phrase
};

/// Properties of an engine that hold for every complex.
struct EngineFacts {
  Engine id;
  bool goes_by_edges = false;  ///< it uses vertices and edges only
  bool is_oracle = false;      ///< the other engines are checked against it
  bool stops_early = false;    ///< it may stop before it has seen the entire complex
  /// The highest dimension of the cells that it lists for homology up to max_dim, or -1 if it lists
  /// none.
  int (*listed_dim)(int max_dim) = nullptr;
  /// Bytes that the engine takes for a Rips complex, whatever dimensions are requested; null if it
  /// takes as many bytes as the adjacency of the graph.
  double (*rips_bytes)(std::size_t vertices, std::size_t edges) = nullptr;
  /// The forms of a Rips filtration that it accepts, best first; empty if it accepts all edges or
  /// the edges of the distinct points.
  std::span<const RipsForm> rips_forms = {};
  /// Returns the condition that prevents the engine from using the best of these forms, or an empty
  /// text if there is none. If null, can_run decides from the edges.
  std::string_view (*rips_obstacle)(const RipsInput&, const Task&) = nullptr;
  /// Returns how well the engine suits a task that it does in the best of these forms; if null,
  /// `suitability` decides from the edges.
  Suitability (*rips_suitability)(const RipsInput&, const Task&) = nullptr;
};
/// The facts of an engine. @throws Error (usage) if no engine has that name.
const EngineFacts& facts_of(Engine engine);

}  // namespace ph
