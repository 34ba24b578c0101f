// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

#include "common/arguments/option_scope.hpp"

namespace ph::barcode {

/// What was read, with what is made of it: options differ in where they do something.
enum Situation : app::Situations {
  kPoints = 1 << 0,       ///< their Rips complex
  kMatrix = 1 << 1,       ///< of all distances, a full square
  kTriangle = 1 << 2,     ///< the same, half of it
  kSomePairs = 1 << 3,    ///< sparse distances
  kImage = 1 << 4,        ///< with cubical complex
  kVoxels = 1 << 5,       ///< points with --complex cubical
  kSimplices = 1 << 6,    ///< with values of their own
  kLowerStar = 1 << 7,    ///< simplices with values of the vertices
  kBoundary = 1 << 8,     ///< a boundary matrix
  kMesh = 1 << 9,         ///< with values of the vertices
  kOwn = 1 << 10,         ///< points with a complex that the program added
  kBarcode = 1 << 11,     ///< a stored one, computed earlier
  kComparison = 1 << 12,  ///< of two stored ones
  kAlpha = 1 << 13,       ///< points with an alpha complex, or another of their triangulation
  kImagePart = 1 << 14,   ///< some layers of an image
  kParts = 1 << 15,       ///< parts to join
  kRanks = 1 << 16,       ///< an image on several ranks
  kCloudPart = 1 << 17,   ///< some blocks of a point cloud
  kCloudRanks = 1 << 18,  ///< a point cloud on several ranks
};
constexpr app::Situations kSomeBlocks = kCloudPart | kCloudRanks;

/// All options that do nothing in some of them.
std::span<const app::OptionScope> option_scopes();

/// What a message calls a situation.
std::string_view name_of(Situation situation);

}  // namespace ph::barcode
