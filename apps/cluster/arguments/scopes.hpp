// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/arguments/option_scope.hpp"
#include "ph/detail/core/names.hpp"

namespace ph::cluster {

/// The kinds of input, the methods, and the two kinds of runs. Each option has an effect only for
/// some of them.
enum Situation : app::Situations {
  kPoints = 1 << 0,
  kMatrix = 1 << 1,    ///< a square matrix of all distances
  kTriangle = 1 << 2,  ///< one triangle of a matrix of distances
  kSomePairs = 1 << 3,
  kEom = 1 << 4,
  kLeaf = 1 << 5,
  kFullRun = 1 << 6,  ///< a run without --dry-run
  kDryRun = 1 << 7,
};
constexpr app::Situations kDistances = kMatrix | kTriangle | kSomePairs,
                          kAllData = kPoints | kDistances, kAllMethods = kEom | kLeaf,
                          kAllRuns = kFullRun | kDryRun;

constexpr app::Scope kOfData{kAllData | kAllMethods | kAllRuns, "points and distances"};
constexpr app::Scope kOfPoints{kPoints | kAllMethods | kAllRuns, "points"};
constexpr app::Scope kOfMatrices{kMatrix | kAllMethods | kAllRuns,
                                 "full distance matrices (--format distance)"};
constexpr app::Scope kOfDistances{kDistances | kAllMethods | kAllRuns,
                                  "distances (--format distance)"};
constexpr app::Scope kOfEom{kAllData | kEom | kFullRun, "--method eom"};
constexpr app::Scope kOfFullRuns{kAllData | kAllMethods | kFullRun, "runs without --dry-run"};

}  // namespace ph::cluster

namespace ph {

/// The words that messages use for a situation.
template <>
inline constexpr std::array names_of<cluster::Situation>{
    Named{cluster::kPoints, "points"},
    Named{cluster::kMatrix, "a full distance matrix"},
    Named{cluster::kTriangle, "a triangle without its diagonal"},
    Named{cluster::kSomePairs, "some distances only"},
    Named{cluster::kEom, "--method eom"},
    Named{cluster::kLeaf, "--method leaf"},
};

}  // namespace ph
