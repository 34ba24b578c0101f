// SPDX-License-Identifier: MIT
#pragma once
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/distances/distance_choice.hpp"

namespace ph::distance_program {

/// The bit for a kind of distance.
constexpr app::Situations situation_of(app::DistanceKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
/// The situations of a run, which are the number of barcodes and the requested results.
inline constexpr app::Situations kTwo = 1U << 3, kMany = 1U << 4, kGroups = 1U << 5,
                                 kNoGroups = 1U << 6, kMatching = 1U << 7;

inline constexpr app::Situations kBottleneck = situation_of(app::DistanceKind::bottleneck),
                                 kWasserstein = situation_of(app::DistanceKind::wasserstein),
                                 kSliced = situation_of(app::DistanceKind::sliced),
                                 kAnyDistance = kBottleneck | kWasserstein | kSliced,
                                 kAnyNumber = kTwo | kMany,
                                 kAnyAim = kGroups | kNoGroups | kMatching;

constexpr app::Scope kOfWasserstein{kWasserstein | kAnyNumber | kAnyAim, "--distance wasserstein"};
constexpr app::Scope kOfGroups{kAnyDistance | kAnyNumber | kGroups, "--groups"};

}  // namespace ph::distance_program
