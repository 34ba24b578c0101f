// SPDX-License-Identifier: MIT
#include "libph/src/io/clouds/camera_members.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "libph/src/io/clouds/camera_file.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"

namespace ph::detail {
namespace {

using Members = CameraMembers;

// Depth units per metre. Open3D writes them; the SDK of RealSense writes metres per unit, and BOP
// writes millimetres per unit.
double scale_of(const Members& m, const Input& input) {
  if (!m.depth_scale) return 0;
  constexpr double kLeastUnit = 0.01, kMillimetres = 1000, kFewest = 100;
  const double found = *m.depth_scale;
  const bool is_bop_unit = m.is_bop && found >= kLeastUnit && found <= 1;
  const double least = m.is_bop ? kFewest : 1;
  // A number below 1 must be in metres per unit, because no unit is longer than a metre.
  const double scale = is_bop_unit ? kMillimetres / found : found < 1 ? 1 / found : found;
  if (!std::isfinite(scale) || (!is_bop_unit && found >= 1 && found < least)) m.refuse_scale(input);
  return scale;
}

Lens lens_of(const Members& m, const Input& input) {
  if (std::ranges::all_of(m.coefficients, [](double c) { return c == 0; })) return {};
  constexpr std::size_t count = 5;
  // The SDK of RealSense writes "distortion.brown_conrady" or "Brown Conrady".
  std::string model = lower_case(m.model.substr(m.model.find('.') + 1));  // npos + 1 is 0
  std::ranges::replace(model, ' ', '_');
  if (model != "brown_conrady" || m.coefficients.size() != count)
    input.fail_at(
        m.lens_place.line, m.lens_place.column,
        {"lens model",
         fmt::format("{} coefficients of \"{}\"", m.coefficients.size(), printable(m.model, 40)),
         "5 coefficients of brown_conrady, or only zeros",
         "rectify the image, and use a camera without distortion"});
  Lens lens;
  lens.model = Lens::Model::polynomial;
  std::ranges::copy(m.coefficients, lens.coefficients.begin());
  return lens;
}

void require_numbers(const Members& m, const Input& input) {
  std::vector<std::string_view> missing;
  const auto refuse_missing = [&](std::string_view kind, std::string_view expected) {
    if (!missing.empty())
      input.fail({std::string(kind), fmt::format("{}", fmt::join(missing, " and ")),
                  std::string(expected), way_to_intrinsics()});
  };
  if (!m.has_any()) {
    missing.emplace_back("no intrinsic_matrix, cam_K or fx");
    refuse_missing("not a camera",
                   "the numbers of Open3D (intrinsic_matrix, width, height), of RealSense (fx, fy, "
                   "ppx, ppy) or of BOP (cam_K, or fx, fy, cx, cy)");
  }
  if (m.matrix && m.needs_size) {
    if (m.width == 0) missing.emplace_back("no width");
    if (m.height == 0) missing.emplace_back("no height");
    refuse_missing("not an Open3D camera", "intrinsic_matrix, width and height");
  }
  if (m.matrix && (m.fx || m.fy || m.cx || m.cy))
    input.fail({"several cameras", "a matrix and fx", "one of them", way_to_intrinsics()});
  if (!m.matrix) {
    if (!m.fx) missing.emplace_back("no fx");
    if (!m.fy) missing.emplace_back("no fy");
    if (!m.cx) missing.emplace_back(m.is_bop ? "no cx" : "no ppx");
    if (!m.cy) missing.emplace_back(m.is_bop ? "no cy" : "no ppy");
    refuse_missing("not a camera", "fx, fy, ppx and ppy, or fx, fy, cx and cy");
  }
  if ((m.width == 0) != (m.height == 0))
    input.fail({"not a camera",
                m.width == 0 ? "no width" : "no height",
                "both width and height, or neither",
                {}});
}

}  // namespace

void CameraMembers::complete(const CameraMembers& around) {
  if (width == 0 && height == 0) {
    width = around.width;
    height = around.height;
  }
  if (depth_scale) return;
  depth_scale = around.depth_scale;
  scale_place = around.scale_place;
}

void CameraMembers::refuse_scale(const Input& input) const {
  input.fail_at(scale_place.line, scale_place.column,
                {"depth_scale",
                 fmt::format("{}", *depth_scale),
                 is_bop ? "millimetres per unit, from 0.01 to 1, or units per metre, at least 100"
                        : "units per metre, at least 1, or metres per unit, above 0 and below 1",
                 {}});
}

Camera camera_of(const CameraMembers& m, const Input& input) {
  require_numbers(m, input);
  Camera camera;
  camera.intrinsics = m.matrix ? *m.matrix : Intrinsics{*m.fx, *m.fy, *m.cx, *m.cy};
  if (const auto& k = camera.intrinsics;
      !(k.fx > 0 && k.fy > 0 && std::isfinite(k.fx + k.fy + k.cx + k.cy)))
    input.fail({"focal lengths", fmt::format("{} and {}", k.fx, k.fy), "numbers above 0",
                way_to_intrinsics()});
  camera.width = m.width;
  camera.height = m.height;
  camera.depth_scale = scale_of(m, input);
  camera.lens = lens_of(m, input);
  return camera;
}

Camera camera_of(const std::vector<std::pair<std::string, CameraMembers>>& named,
                 const Input& input) {
  const Camera camera = camera_of(named.front().second, input);
  const auto numbers_of = [](const Camera& c) {
    const auto& [fx, fy, cx, cy] = c.intrinsics;
    return std::tuple(fx, fy, cx, cy, c.width, c.height, c.depth_scale, c.lens.model,
                      c.lens.coefficients);
  };
  const auto is_number = [](std::string_view name) {
    return name.find_first_not_of("0123456789") == name.npos;
  };
  for (const auto& [name, members] : named) {
    if (numbers_of(camera_of(members, input)) == numbers_of(camera)) continue;
    const std::string& first = named.front().first;
    const bool are_pictures = is_number(first) && is_number(name);
    input.fail({"several cameras",
                fmt::format("{}{} and {} with different ones", are_pictures ? "pictures " : "",
                            printable(first, 40), printable(name, 40)),
                are_pictures ? "the same cam_K and depth_scale for all pictures" : "one camera",
                way_to_intrinsics()});
  }
  return camera;
}

}  // namespace ph::detail
