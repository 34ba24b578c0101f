// SPDX-License-Identifier: MIT
#include "apps/common/arguments/option_scope.hpp"

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph::app {

void require_in_scope(std::span<const GivenOption> given, Situations here, std::string_view found) {
  for (const auto& [name, scope] : given)
    if ((scope.where & here) == 0)
      throw Error(ErrorKind::usage, fmt::format("--{}: makes sense for {} only, found {}", name,
                                                scope.meant_for, found));
}

}  // namespace ph::app
