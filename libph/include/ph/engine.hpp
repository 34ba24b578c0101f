// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"

namespace ph {

/// The engines a user can ask for; see registry.hpp.
enum class Engine {
  automatic,   ///< chosen from the complex and the dimension
  standard,    ///< the oracle: textbook reduction, slow, any filtration
  twist,       ///< boundary matrix with clearing
  cohomology,  ///< coboundary matrix with clearing and shortcuts
  union_find,  ///< H0 only
  lens,        ///< Rips, H0 to H2: edge by edge
  arrows,      ///< images: voxel by voxel
};

/// The name of an engine; "auto" for Engine::automatic.
std::string_view engine_name(Engine engine);
/// The engine of that name, "auto" included; nothing if there is none.
std::optional<Engine> engine_named(std::string_view name);
/// The names of all engines, "auto" first.
std::vector<std::string_view> engine_names();

/// What an engine is asked for.
struct Task {
  int max_dim = 0;  ///< highest dimension of homology
  Representatives representatives = Representatives::none;
  bool zero_length = false;  ///< pairs of one value, too
  /// Whether chains are all that must come with the bars, if anything.
  bool wants_no_sets() const { return representatives != Representatives::voxels; }
};

// AN ENGINE is a struct of static members that says all about itself:
//
//   id, name           what it is called
//   can_run(f, task)   whether it can do the task
//   suitability(f, task)   how well, where it can: the best of all engines is taken
//   listed_dim(max_dim)    the highest dimension whose cells it lists
//   goes_by_edges      whether it looks at nothing but vertices and edges
//   is_oracle          whether it is what the others are checked with
//   run(f, field, bars, context)   computes
//
// A new one is this and a line in generic_engines.hpp or all_engines.hpp.

/// How well an engine suits a task.
struct Suitability {
  int rank = 0;             ///< the highest is taken; 0: never unless asked for
  std::string_view reason;  ///< why it is taken, one phrase
};

}  // namespace ph
