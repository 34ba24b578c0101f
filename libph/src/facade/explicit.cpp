// SPDX-License-Identifier: MIT
#include "libph/src/facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<ExplicitComplex>>& engines<ExplicitComplex>() {
  static auto list = all_engines<ExplicitComplex>();
  return list;
}
template <>
std::vector<EngineFor<FilteredGraph>>& engines<FilteredGraph>() {
  static auto list = all_engines<FilteredGraph>();
  return list;
}

}  // namespace ph::detail
