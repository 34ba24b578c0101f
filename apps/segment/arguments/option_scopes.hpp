// SPDX-License-Identifier: MIT
#pragma once
#include "common/arguments/option_scope.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The situations of a run: the kind of input, the method, and whether a plane is removed. Options
/// differ in where they have an effect. One bit of each line applies to a run.
enum Situation : app::Situations {
  kCloud = 1 << 0,       ///< a point cloud
  kDepthImage = 1 << 1,  ///< with its camera
  kStoredTree = 1 << 2,  ///< that --tree wrote

  kPaper = 1 << 3,  ///< methods; for a tree, the one that made it
  kSurface = 1 << 4,
  kSupervoxels = 1 << 5,

  kPlane = 1 << 6,
  kNoPlane = 1 << 7,
};

/// All options that have no effect in some of them.
std::span<const app::OptionScope> option_scopes();

/// @throws Error (usage) on an option that has no effect with such an input.
void require_input(std::span<const app::OptionScope* const> given, Situation input);
/// The same for a method.
void require_method(std::span<const app::OptionScope* const> given, Method method);
/// The same for the removal of the plane.
void require_plane(std::span<const app::OptionScope* const> given, bool plane);

}  // namespace ph::segment
