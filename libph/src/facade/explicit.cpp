// SPDX-License-Identifier: MIT
#include "libph/src/facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<ExplicitComplex>>& engines<ExplicitComplex>() {
  static constinit OnFirstUse list([] { return all_engines<ExplicitComplex>(); });
  return *list;
}
template <>
std::vector<EngineFor<FilteredGraph>>& engines<FilteredGraph>() {
  static constinit OnFirstUse list([] { return all_engines<FilteredGraph>(); });
  return *list;
}

}  // namespace ph::detail
