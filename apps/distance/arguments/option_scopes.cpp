// SPDX-License-Identifier: MIT
#include "distance/arguments/option_scopes.hpp"

#include <array>

namespace ph::distance_program {
namespace {

using app::DistanceKind;
using app::OptionScope;
using app::Situations;

constexpr Situations kBottleneck = situation_of(DistanceKind::bottleneck),
                     kWasserstein = situation_of(DistanceKind::wasserstein),
                     kSliced = situation_of(DistanceKind::sliced),
                     kAnyDistance = kBottleneck | kWasserstein | kSliced, kAnyNumber = kTwo | kMany,
                     kAnyAim = kGroups | kNoGroups | kMatching;

constexpr std::array kScopes{
    OptionScope{"order", kWasserstein | kAnyNumber | kAnyAim, "--distance wasserstein"},
    OptionScope{"ground", kWasserstein | kAnyNumber | kAnyAim, "--distance wasserstein"},
    OptionScope{"directions", kSliced | kAnyNumber | kAnyAim, "--distance sliced"},
    OptionScope{"error", kBottleneck | kWasserstein | kAnyNumber | kAnyAim,
                "--distance bottleneck and wasserstein"},
    OptionScope{"at-most", kBottleneck | kWasserstein | kAnyNumber | kNoGroups,
                "bottleneck and Wasserstein distances without --groups and --matching"},
    OptionScope{"matching", kBottleneck | kWasserstein | kTwo | kNoGroups | kMatching,
                "two barcodes with --distance bottleneck or wasserstein"},
    OptionScope{"shuffles", kAnyDistance | kAnyNumber | kGroups, "--groups"},
    OptionScope{"power", kAnyDistance | kAnyNumber | kGroups, "--groups"},
    OptionScope{"seed", kAnyDistance | kAnyNumber | kGroups, "--groups"},
};

}  // namespace

std::span<const OptionScope> option_scopes() { return kScopes; }

}  // namespace ph::distance_program
