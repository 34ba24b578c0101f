// SPDX-License-Identifier: MIT
#include "libph/src/facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<RipsFiltration<RipsLayout::dense, 1>>>&
engines<RipsFiltration<RipsLayout::dense, 1>>() {
  static constinit OnFirstUse list(
      [] { return all_engines<RipsFiltration<RipsLayout::dense, 1>>(); });
  return *list;
}

}  // namespace ph::detail
