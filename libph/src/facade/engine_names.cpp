// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/facade/all_engines.hpp"
#include "ph/custom.hpp"

namespace ph {
namespace {

/// Earlier names of engines.
constexpr std::pair<std::string_view, Engine> kEarlierNames[] = {
    {"lens", Engine::edge_links},
    {"arrows", Engine::gradient},
    {"union_find", Engine::union_find},
};

template <class... E>
std::vector<EngineFacts> facts_of_list(std::tuple<E...>*) {
  return {detail::facts<E>()...};
}

}  // namespace

std::vector<EngineFacts>& detail::engine_facts() {
  static constinit OnFirstUse facts(
      [] { return facts_of_list(static_cast<AllEngines*>(nullptr)); });
  return *facts;
}

void detail::add_facts(const EngineFacts& facts) {
  if (engine_named(facts.id.name()))
    throw Error(ErrorKind::usage,
                fmt::format("engine {}: found a second engine of that name", facts.id.name()));
  engine_facts().push_back(facts);
}

const EngineFacts& facts_of(Engine engine) {
  const auto& all = detail::engine_facts();
  const auto found = std::ranges::find(all, engine, &EngineFacts::id);
  if (found == all.end())
    throw Error(ErrorKind::usage, fmt::format("engine: found the unknown name {}", engine.name()));
  return *found;
}

std::optional<Engine> engine_named(std::string_view name) {
  if (name == Engine::automatic.name()) return Engine::automatic;
  for (const EngineFacts& facts : detail::engine_facts())
    if (facts.id.name() == name) return facts.id;
  for (const auto& [earlier, engine] : kEarlierNames)
    if (earlier == name) return engine;
  return std::nullopt;
}

std::vector<std::string_view> engine_names() {
  std::vector<std::string_view> names{Engine::automatic.name()};
  for (const EngineFacts& facts : detail::engine_facts()) names.push_back(facts.id.name());
  return names;
}

}  // namespace ph
