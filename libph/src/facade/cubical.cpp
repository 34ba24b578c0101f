// SPDX-License-Identifier: MIT
#include "libph/src/facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<Cubical>>& engines<Cubical>() {
  static constinit OnFirstUse list([] { return all_engines<Cubical>(); });
  return *list;
}

}  // namespace ph::detail
