// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "common/arguments/option_scope.hpp"
#include "vectorise/fit/fit.hpp"

namespace ph::vectorise {

/// The bit of a kind of vectors.
constexpr app::Situations situation_of(Kind kind) { return 1U << static_cast<unsigned>(kind); }
/// The situations of a run: vectors that are fitted now or were fitted before, and the input of an
/// Euler curve.
inline constexpr app::Situations kFitting = 1U << 20, kFitted = 1U << 21, kOfBarcode = 1U << 22,
                                 kOfImage = 1U << 23;

/// All options that have no effect in some of them.
std::span<const app::OptionScope> option_scopes();

}  // namespace ph::vectorise
