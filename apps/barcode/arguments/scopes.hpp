// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "apps/common/arguments/option_scope.hpp"
#include "ph/detail/core/names.hpp"

namespace ph::barcode {

/// The kinds of input, each with the complex that is built from it. Each option has an effect only
/// for some of these kinds.
enum Situation : app::Situations {
  kPoints = 1 << 0,       ///< points with their Rips complex
  kMatrix = 1 << 1,       ///< a square matrix of all distances
  kTriangle = 1 << 2,     ///< one triangle of a matrix of distances
  kSomePairs = 1 << 3,    ///< sparse distances
  kImage = 1 << 4,        ///< an image with its cubical complex
  kVoxels = 1 << 5,       ///< points with --complex cubical
  kSimplices = 1 << 6,    ///< simplices that have their own values
  kLowerStar = 1 << 7,    ///< simplices with values of the vertices
  kBoundary = 1 << 8,     ///< a boundary matrix
  kMesh = 1 << 9,         ///< a mesh with values of its vertices
  kOwn = 1 << 10,         ///< points with a complex that the program added
  kBarcode = 1 << 11,     ///< a stored barcode
  kComparison = 1 << 12,  ///< two stored barcodes to compare
  kAlpha = 1 << 13,       ///< points with a complex of their triangulation, such as alpha
  kImagePart = 1 << 14,   ///< some layers of an image
  kParts = 1 << 15,       ///< parts to join
  kRanks = 1 << 16,       ///< an image on several ranks
  kCloudPart = 1 << 17,   ///< some blocks of a point cloud
  kCloudRanks = 1 << 18,  ///< a point cloud on several ranks
};
constexpr app::Situations kAllPairs = kPoints | kMatrix | kTriangle, kRips = kAllPairs | kSomePairs,
                          kCubical = kImage | kVoxels,
                          kListed = kSimplices | kLowerStar | kBoundary | kMesh,
                          kComputed = kRips | kCubical | kListed | kOwn | kAlpha,
                          kSomeLayers = kImagePart | kRanks, kSomeBlocks = kCloudPart | kCloudRanks;

constexpr app::Scope kOfInputs{kComputed, "a computation"};
constexpr app::Scope kOfPoints{kPoints, "Rips complexes of points"};
constexpr app::Scope kOfRips{kRips, "Rips complexes of points and distances"};
constexpr app::Scope kOfAllPairs{kAllPairs, "points and distance matrices"};
constexpr app::Scope kOfMatrices{kMatrix, "full distance matrices (--format distance)"};
constexpr app::Scope kOfDistances{kMatrix | kTriangle | kSomePairs,
                                  "distances (--format distance)"};
constexpr app::Scope kOfAlpha{kAlpha, "points with --complex alpha"};
constexpr app::Scope kOfRaw{kImage | kSomeLayers, "images"};
constexpr app::Scope kOfRawPoints{kPoints | kVoxels | kOwn | kAlpha | kSomeBlocks, "points"};
constexpr app::Scope kOfRawNumbers{kOfRaw.where | kOfRawPoints.where, "images and points"};
constexpr app::Scope kOfMeshes{kMesh, "meshes with --values"};
constexpr app::Scope kOfCubical{kCubical | kSomeLayers, "images"};
constexpr app::Scope kOfVoxels{kVoxels, "points with --complex cubical"};
constexpr app::Scope kOfOneBarcode{kComputed | kBarcode | kParts | kRanks | kCloudRanks,
                                   "one barcode"};
constexpr app::Scope kOffRanks{~(kRanks | kCloudRanks), "one process"};

}  // namespace ph::barcode

namespace ph {

/// The words that messages use for a situation.
template <>
inline constexpr std::array names_of<barcode::Situation>{
    Named{barcode::kPoints, "points"},
    Named{barcode::kMatrix, "a full distance matrix"},
    Named{barcode::kTriangle, "a triangle without its diagonal"},
    Named{barcode::kSomePairs, "some distances only"},
    Named{barcode::kImage, "an image"},
    Named{barcode::kVoxels, "points with --complex cubical"},
    Named{barcode::kSimplices, "simplices"},
    Named{barcode::kLowerStar, "simplices with --complex lower-star"},
    Named{barcode::kBoundary, "a boundary matrix"},
    Named{barcode::kMesh, "a mesh with values"},
    Named{barcode::kOwn, "points with another complex"},
    Named{barcode::kBarcode, "a barcode"},
    Named{barcode::kComparison, "two barcodes to compare"},
    Named{barcode::kAlpha, "points with --complex alpha"},
    Named{barcode::kImagePart, "a part of an image (--part)"},
    Named{barcode::kParts, "parts to join (--join)"},
    Named{barcode::kRanks, "an image on several processes"},
    Named{barcode::kCloudPart, "a part of a cloud (--part)"},
    Named{barcode::kCloudRanks, "points on several processes"},
};

}  // namespace ph
