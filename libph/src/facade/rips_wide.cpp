// SPDX-License-Identifier: MIT
#include "libph/src/facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<RipsFiltration<RipsLayout::any, 4>>>&
engines<RipsFiltration<RipsLayout::any, 4>>() {
  static constinit OnFirstUse list(
      [] { return all_engines<RipsFiltration<RipsLayout::any, 4>>(); });
  return *list;
}

}  // namespace ph::detail
