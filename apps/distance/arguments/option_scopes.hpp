// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "common/arguments/option_scope.hpp"
#include "common/distances/distance_choice.hpp"

namespace ph::distance_program {

/// The bit of a distance.
constexpr app::Situations situation_of(app::DistanceKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
/// The situations of a run: the number of barcodes and the requested results.
inline constexpr app::Situations kTwo = 1U << 3, kMany = 1U << 4, kGroups = 1U << 5,
                                 kNoGroups = 1U << 6, kMatching = 1U << 7;

/// All options that have no effect in some of them.
std::span<const app::OptionScope> option_scopes();

}  // namespace ph::distance_program
