// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/arguments/option_scope.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// What is looked at, how, and whether a plane is removed: options differ in where they do
/// something. One bit of each line applies to a run.
enum Situation : app::Situations {
  kCloud = 1 << 0,       ///< a point cloud
  kDepthImage = 1 << 1,  ///< with its camera
  kStoredTree = 1 << 2,  ///< that --tree wrote

  kPaper = 1 << 3,  ///< methods, of a tree that by which it was made
  kSurface = 1 << 4,
  kSupervoxels = 1 << 5,

  kPlane = 1 << 6,
  kNoPlane = 1 << 7,
};

constexpr app::Situations kScene = kCloud | kDepthImage, kAnyInput = kScene | kStoredTree,
                          kBySurface = kSurface | kSupervoxels, kAnyMethod = kPaper | kBySurface,
                          kAnyPlane = kPlane | kNoPlane;

// Where input, method and plane each have a say, the words name the one that is rarest.
constexpr app::Scope kOfScenes{kScene | kAnyMethod | kAnyPlane, "clouds and depth images"};
constexpr app::Scope kOfDepth{kDepthImage | kAnyMethod | kAnyPlane, "depth images"};
constexpr app::Scope kOfPaper{kScene | kPaper | kAnyPlane, "--method paper"};
constexpr app::Scope kOfSurface{kAnyInput | kSurface | kAnyPlane, "--method surface"};
constexpr app::Scope kOfBoth{kAnyInput | kBySurface | kAnyPlane,
                             "--method surface and supervoxels"};

/// @throws Error (usage) on an option that does nothing with such an input.
void require_input(std::span<const app::GivenOption> given, Situation input);
/// The same of a method.
void require_method(std::span<const app::GivenOption> given, Method method);
/// The same of the removal of the plane.
void require_plane(std::span<const app::GivenOption> given, bool plane);

}  // namespace ph::segment
