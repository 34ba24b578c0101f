// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ph::app {

/// The situations that an option may meet: kinds of input, complexes, methods. Each has one bit;
/// each program names its own.
using Situations = std::uint32_t;

/// The situations in which an option has an effect. In any other situation the option is refused,
/// because the user must have misunderstood it.
struct Scope {
  Situations where = ~Situations{0};  ///< the option has an effect in any of these
  std::string_view meant_for = {};    ///< the words for them: "points"

  /// This scope, extended by more situations; the words stay the same.
  constexpr Scope with(Situations more) const { return {where | more, meant_for}; }
};

/// A given option that has no effect in some situations.
struct GivenOption {
  std::string name;  ///< "metric": the first long name, without dashes
  Scope scope;
};

/// @param here the actual situation, one bit. @param found the word for it.
/// @throws Error (usage): "--metric: makes sense for points only, found an image".
void require_in_scope(std::span<const GivenOption> given, Situations here, std::string_view found);

}  // namespace ph::app
