// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>
#include <tuple>

namespace ph {

/// A member of a struct of options with its name.
template <class Options, class Value>
struct Member {
  std::string_view name;
  Value Options::*member;
};

/// The members of a struct of options that keywords in Python set without conversion. A
/// specialisation for each such struct stands next to the struct's definition.
template <class Options>
inline constexpr std::tuple<> members_of{};

}  // namespace ph
