// SPDX-License-Identifier: MIT
#include "libph/src/alpha/alpha_engine.hpp"
#include "ph/detail/facade/alpha_engines.hpp"
#include "ph/detail/facade/choose_engine.hpp"
#include "ph/detail/facade/generic_engines.hpp"

namespace ph {

template <>
std::vector<detail::EngineFor<Alpha>>& detail::engines<Alpha>() {
  static constinit OnFirstUse list([] {
    auto engines = engines_of_list<Alpha>(static_cast<GenericEngines*>(nullptr));
    engines.push_back(engine_for<AlphaEngine, Alpha>());
    return engines;
  });
  return *list;
}

}  // namespace ph
