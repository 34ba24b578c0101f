// SPDX-License-Identifier: MIT
// Reads cameras in JSON, as Open3D, RealSense's SDK and the BOP data sets write them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libph/src/io/clouds/camera_file.hpp"
#include "libph/src/io/clouds/camera_members.hpp"
#include "ph/detail/io/json_cursor.hpp"
#include "ph/error.hpp"

namespace ph::detail {
namespace {

using Members = CameraMembers;

class CameraJson {
 public:
  /// @param are_named objects in the outermost object may be cameras.
  CameraJson(const Input& input, bool are_named)
      : json_(input), input_(input), are_named_(are_named) {}

  /// Reads the whole file. @return the members of the outermost object.
  Members read() {
    Members members;
    read_members(members, 0);
    json_.expect_end();
    for (auto& [name, camera] : named_) camera.complete(members);
    return members;
  }
  const auto& named() const { return named_; }

 private:
  void read_members(Members& m, int depth) {
    json_.for_each_member([&](const std::string& name) {
      if (name == "width" || name == "height") {
        (name == "width" ? m.width : m.height) = json_.integer(1, kMostPixels, name.c_str());
      } else if (name == "fx" || name == "fy") {
        take(name == "fx" ? m.fx : m.fy, name);
      } else if (name == "ppx" || name == "ppy" || name == "cx" || name == "cy") {
        m.is_bop = name[0] == 'c';
        take(name.back() == 'x' ? m.cx : m.cy, name);
      } else if (name == "intrinsic_matrix" || name == "cam_K") {
        read_matrix(m, name);
      } else if (name == "depth_scale" && json_.peek() != 'n') {  // null: there is no scale
        m.scale_place = place();
        take(m.depth_scale, name);
        if (!(*m.depth_scale > 0)) m.refuse_scale(input_);
      } else if (name == "model" && json_.peek() == '"') {
        m.model = json_.string();
      } else if (name == "coeffs" && json_.peek() == '[') {
        m.lens_place = place();
        m.coefficients = numbers();
      } else if ((name == "intrinsic" || name == "intrinsics") && depth < 2 &&
                 json_.peek() == '{') {
        read_members(m, 2);
      } else if (are_named_ && depth == 0 && json_.peek() == '{') {
        Members camera;
        read_members(camera, 1);
        if (camera.has_any()) named_.emplace_back(name, std::move(camera));
      } else {
        json_.skip_value();
      }
    });
  }

  Members::Place place() const {
    const auto [line, column] = json_.line_and_column(json_.place());
    return {line, column};
  }

  void take(std::optional<double>& number, const std::string& name) {
    json_.peek();
    const std::size_t place = json_.place();
    if (number) json_.fail(place, {name, "a second one", "one", {}});
    number = json_.number();
  }

  std::vector<double> numbers() {
    std::vector<double> result;
    json_.for_each_element([&] { result.push_back(json_.number()); });
    return result;
  }

  void read_matrix(Members& m, const std::string& name) {
    json_.peek();
    const std::size_t place = json_.place();
    if (m.matrix) json_.fail(place, {name, "a second one", "one", {}});
    const std::vector<double> k = numbers();
    const bool by_column = name == "intrinsic_matrix";
    constexpr std::size_t size = 9;
    const auto refuse = [&](const Fault&) {
      json_.fail(place, {name, fmt::format("[{}]", fmt::join(k, ", ")),
                         by_column ? "[fx, 0, 0, 0, fy, 0, cx, cy, 1], column by column"
                                   : "[fx, 0, cx, 0, fy, cy, 0, 0, 1], row by row",
                         way_to_intrinsics()});
    };
    if (k.size() != size) refuse({});
    const std::array<double, size> rows =
        by_column ? std::array{k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]}
                  : std::array{k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7], k[8]};
    m.matrix = intrinsics_of(rows, refuse);
    m.needs_size = by_column;
    m.is_bop = !by_column;
  }

  JsonCursor json_;
  const Input& input_;
  bool are_named_;
  std::vector<std::pair<std::string, Members>> named_;
};

}  // namespace

Camera read_json_camera(const Input& input) {
  const Members alone = CameraJson(input, false).read();
  if (alone.has_any()) return camera_of(alone, input);
  // Only without a camera in the outermost object do its members count as cameras: in other files,
  // they may be anything.
  CameraJson json(input, true);
  json.read();
  return json.named().empty() ? camera_of(alone, input) : camera_of(json.named(), input);
}

}  // namespace ph::detail
