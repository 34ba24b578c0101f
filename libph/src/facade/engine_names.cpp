// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph {

std::string_view engine_name(Engine engine) {
  std::string_view name = "auto";
  for_each_engine([&](auto e) {
    if (e.id == engine) name = e.name;
  });
  return name;
}

std::optional<Engine> engine_named(std::string_view name) {
  if (name == "auto") return Engine::automatic;
  std::optional<Engine> engine;
  for_each_engine([&](auto e) {
    if (e.name == name) engine = e.id;
  });
  return engine;
}

std::vector<std::string_view> engine_names() {
  std::vector<std::string_view> names{engine_name(Engine::automatic)};
  for_each_engine([&](auto e) { names.push_back(e.name); });
  return names;
}

}  // namespace ph
