// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ph::app {

/// The situations in which an option may be used, such as kinds of input, complexes and methods.
/// Each situation has one bit, and each program names its own situations.
using Situations = std::uint32_t;

/// The situations in which an option has an effect. In any other situation the option is refused,
/// because the user must have misunderstood it.
struct Scope {
  Situations where = ~Situations{0};  ///< the option has an effect in any of these situations
  std::string_view meant_for = {};    ///< the words for these situations, such as "points"

  /// This scope, extended by more situations. The words stay the same.
  constexpr Scope with(Situations more) const { return {where | more, meant_for}; }
};

/// A given option that has no effect in some situations.
struct GivenOption {
  /// The first long name, without dashes, such as "metric".
  std::string name;
  Scope scope;
};

/// @param here the actual situation, as one bit. @param found the word for this situation.
/// @throws Error (usage): "--metric: makes sense for points only, found an image".
void require_in_scope(std::span<const GivenOption> given, Situations here, std::string_view found);

}  // namespace ph::app
