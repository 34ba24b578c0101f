// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/detail/io/json_writer.hpp"
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

inline std::string json_of(const OrientedBox& box) {
  return json::object({{"centre", json::numbers(box.centre)},
                       {"axes", json::array(box.axes, json::numbers<Vec3>)},
                       {"size", json::numbers(box.size)}});
}
inline std::string json_of(const std::vector<SceneSurface>& surfaces) {
  return json::lines(surfaces, [number = Index{0}](const SceneSurface& surface) mutable {
    return json::object({{"number", json::integer(++number)},
                         {"role", json::string(role_name(surface.role))},
                         {"normal", json::numbers(surface.plane.normal)},
                         {"offset", json::number(surface.plane.offset)},
                         {"oriented_box", json_of(surface.oriented_box)}});
  });
}
inline std::string json_of(const std::vector<NoiseAt>& noise) {
  return json::array(noise, [](const NoiseAt& at) {
    return json::object(
        {{"range", json::number(at.range)}, {"concavity", json::number(at.concavity)}});
  });
}

}  // namespace ph::segment
