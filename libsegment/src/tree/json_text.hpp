// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "io/bytes/json_writer.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

inline std::string json_of(Method method) {
  return json::string(kMethodNames[static_cast<std::size_t>(method)]);
}
inline std::string json_of(const CutOptions& o) {
  return json::object({{"value", json::number(o.value)},
                       {"min_part", json::integer(o.min_part)},
                       {"min_size", json::integer(o.min_size)},
                       {"objects", json::boolean(o.objects)}});
}

}  // namespace ph::segment
