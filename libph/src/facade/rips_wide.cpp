// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph::detail {

template <>
std::vector<EngineFor<RipsFiltration<RipsLayout::any, 2>>>&
engines<RipsFiltration<RipsLayout::any, 2>>() {
  static auto list = all_engines<RipsFiltration<RipsLayout::any, 2>>();
  return list;
}

}  // namespace ph::detail
