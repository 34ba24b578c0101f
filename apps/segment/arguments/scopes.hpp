// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/arguments/option_scope.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The kind of input, the method, and whether a plane is removed. Each option has an effect only in
/// some of these situations. Exactly one bit of each group applies to a run.
enum Situation : app::Situations {
  kCloud = 1 << 0,       ///< a point cloud
  kDepthImage = 1 << 1,  ///< a depth image with its camera
  kStoredTree = 1 << 2,  ///< a merge tree that --tree wrote

  /// The methods. A stored tree has the method that made it.
  kPaper = 1 << 3,
  kSurface = 1 << 4,
  kSupervoxels = 1 << 5,

  kPlane = 1 << 6,
  kNoPlane = 1 << 7,
};

constexpr app::Situations kScene = kCloud | kDepthImage, kAnyInput = kScene | kStoredTree,
                          kBySurface = kSurface | kSupervoxels, kAnyMethod = kPaper | kBySurface,
                          kAnyPlane = kPlane | kNoPlane;

// If an option depends on more than one of input, method and plane, its words name the rarest
// condition.
constexpr app::Scope kOfScenes{kScene | kAnyMethod | kAnyPlane, "clouds and depth images"};
constexpr app::Scope kOfDepth{kDepthImage | kAnyMethod | kAnyPlane, "depth images"};
constexpr app::Scope kOfPaper{kScene | kPaper | kAnyPlane, "--method paper"};
constexpr app::Scope kOfSurface{kAnyInput | kSurface | kAnyPlane, "--method surface"};
constexpr app::Scope kOfBoth{kAnyInput | kBySurface | kAnyPlane,
                             "--method surface and supervoxels"};

/// @throws Error (usage) on an option that has no effect for this kind of input.
void require_input(std::span<const app::GivenOption> given, Situation input);
/// Does the same for an option that has no effect for this method.
void require_method(std::span<const app::GivenOption> given, Method method);
/// Does the same for an option that has no effect if the plane is removed, or if it is not removed.
void require_plane(std::span<const app::GivenOption> given, bool plane);

}  // namespace ph::segment
