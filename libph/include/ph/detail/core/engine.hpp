// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"

namespace ph {

/// The name of a way to compute a barcode. Those of libph are listed below; a program can add its
/// own, see add_engine in ph/custom.hpp.
class Engine {
 public:
  constexpr Engine() = default;  ///< Engine::automatic
  /// @param name that lives as long as the program: words of lower case joined by hyphens.
  explicit constexpr Engine(std::string_view name) : name_(name) {}

  constexpr std::string_view name() const { return name_; }
  friend constexpr bool operator==(Engine, Engine) = default;

  static const Engine automatic;      ///< chosen from the complex and the task
  static const Engine standard;       ///< the oracle: textbook reduction, slow, any filtration
  static const Engine twist;          ///< boundary matrix with clearing
  static const Engine cohomology;     ///< coboundary matrix with clearing and shortcuts
  static const Engine union_find;     ///< H0 only
  static const Engine edge_links;     ///< Rips, H0 to H3: edge by edge
  static const Engine beta_skeleton;  ///< Rips of points of few coordinates, H0 and H1: no edges
  static const Engine gradient;       ///< images voxel by voxel, alpha complexes by intervals

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

/// The engine of that name, or of that earlier name ("lens", "arrows", "union_find"); nothing if
/// there is none.
std::optional<Engine> engine_named(std::string_view name);
/// The names of all engines, "auto" first, those that the program added last.
std::vector<std::string_view> engine_names();

/// How a Rips filtration is held while something is computed of it. Each form is enough for some
/// tasks; `plan` chooses one (ph/persistence.hpp).
enum class RipsForm : std::uint8_t {
  edges,           ///< all edges up to the threshold: enough for everything
  distinct_edges,  ///< the edges of the distinct points, see RipsOptions::merge_equal_points
  forest,          ///< a minimum spanning forest: enough for H0, cell by cell, and merge trees
  points,          ///< the distinct points alone: enough for Engine::beta_skeleton
};

/// A Rips filtration of which no form was made yet; see ph/rips.hpp.
struct RipsInput;

/// What an engine is asked for.
struct Task {
  int max_dim = 0;  ///< highest dimension of homology
  Representatives representatives = Representatives::none;
  bool zero_length = false;  ///< pairs of one value are asked for as well
  bool collapses = false;    ///< an edge collapse is asked for
  /// Whether chains are all that must come with the bars, if anything.
  bool wants_no_sets() const { return representatives != Representatives::voxels; }
};

/// How well an engine suits a task.
struct Suitability {
  int rank = 0;             ///< the highest is taken; 0: never unless asked for
  std::string_view reason;  ///< why it is taken, one phrase
};

/// What an engine says about itself whatever the complex.
struct EngineFacts {
  Engine id;
  bool goes_by_edges = false;  ///< it looks at nothing but vertices and edges
  bool is_oracle = false;      ///< it is what the others are checked with
  bool stops_early = false;    ///< it may stop before it has seen the whole complex
  /// The highest dimension of which it lists cells for homology up to max_dim; -1: of none.
  int (*listed_dim)(int max_dim) = nullptr;
  /// Bytes that it takes for a Rips complex, whatever the homology; null: those of its adjacency.
  double (*rips_bytes)(std::size_t vertices, std::size_t edges) = nullptr;
  /// The forms of a Rips filtration that it takes, the best first; empty: all edges or those of the
  /// distinct points.
  std::span<const RipsForm> rips_forms = {};
  /// What it would need to take the best of these forms; empty: nothing more. Null: whatever
  /// can_run says of the edges holds.
  std::string_view (*rips_obstacle)(const RipsInput&, const Task&) = nullptr;
  /// How well it suits a task by the best of these forms; null: as by the edges.
  Suitability (*rips_suitability)(const RipsInput&, const Task&) = nullptr;
};
/// Those of an engine that is there. @throws Error (usage) if none has that name.
const EngineFacts& facts_of(Engine engine);

}  // namespace ph
