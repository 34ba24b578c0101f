// SPDX-License-Identifier: MIT
// Reads cameras in JSON, as Open3D, RealSense's SDK and the BOP data sets write them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libph/src/io/clouds/camera_file.hpp"
#include "ph/detail/io/json_cursor.hpp"
#include "ph/error.hpp"

namespace ph::detail {
namespace {

/// The numbers of a camera, with the places where they stand.
struct Members {
  std::optional<Intrinsics> matrix;  // of Open3D, column by column, or of BOP, row by row
  std::optional<double> fx, fy, cx, cy;
  bool is_bop = false;  // the principal point is named as in BOP
  Index width = 0, height = 0;
  std::optional<double> depth_scale;
  std::size_t scale_place = 0;
  std::string model;
  std::vector<double> coefficients;
  std::size_t lens_place = 0;
};

class CameraJson {
 public:
  explicit CameraJson(const Input& input) : json_(input), input_(input) {}

  Camera camera() {
    Members members;
    read_members(members, 0);
    json_.expect_end();
    if (has_pictures_) return of_pictures();
    return of(members);
  }

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
        m.scale_place = json_.place();
        take(m.depth_scale, name);
        if (!(*m.depth_scale > 0)) refuse_scale(m);
      } else if (name == "model" && json_.peek() == '"') {
        m.model = json_.string();
      } else if (name == "coeffs" && json_.peek() == '[') {
        m.lens_place = json_.place();
        m.coefficients = numbers();
      } else if ((name == "intrinsic" || name == "intrinsics") && depth == 0 &&
                 json_.peek() == '{') {
        read_members(m, depth + 1);
      } else if (depth == 0 && is_number_of_picture(name) && json_.peek() == '{') {
        Members picture;
        read_members(picture, depth + 1);
        add_picture(name, picture);
      } else {
        json_.skip_value();
      }
    });
  }

  static bool is_number_of_picture(std::string_view name) {
    return !name.empty() && name.find_first_not_of("0123456789") == name.npos;
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
    m.is_bop = !by_column;
  }

  // Each picture of BOP has a camera of its own. A file is one camera if they are all equal.
  void add_picture(const std::string& name, const Members& picture) {
    if (!picture.matrix) return;
    if (!has_pictures_) {
      picture_ = picture;
      first_ = name;
      has_pictures_ = true;
      return;
    }
    const auto numbers_of = [](const Members& m) {
      return std::array{m.matrix->fx, m.matrix->fy, m.matrix->cx, m.matrix->cy,
                        m.depth_scale.value_or(0)};
    };
    if (numbers_of(picture) != numbers_of(picture_))
      input_.fail({"several cameras",
                   fmt::format("pictures {} and {} with different ones", first_, name),
                   "the same cam_K and depth_scale for all pictures", way_to_intrinsics()});
  }

  Camera of_pictures() const {
    Camera camera;
    camera.intrinsics = *picture_.matrix;
    camera.depth_scale = scale_of(picture_);
    return camera;
  }

  [[noreturn]] void refuse_scale(const Members& m) const {
    json_.fail(m.scale_place,
               {"depth_scale",
                fmt::format("{}", *m.depth_scale),
                m.is_bop ? "millimetres per unit, from 0.01 to 1, or units per metre, at least 100"
                         : "units per metre, at least 1, or metres per unit, above 0 and below 1",
                {}});
  }

  // Depth units per metre. Open3D writes them; the SDK of RealSense writes metres per unit, and BOP
  // writes millimetres per unit.
  double scale_of(const Members& m) const {
    if (!m.depth_scale) return 0;
    constexpr double kLeastUnit = 0.01, kMillimetres = 1000, kFewest = 100;
    const double found = *m.depth_scale;
    const bool is_bop_unit = m.is_bop && found >= kLeastUnit && found <= 1;
    const double least = m.is_bop ? kFewest : 1;
    // A number below 1 must be in metres per unit, because no unit is longer than a metre.
    const double scale = is_bop_unit ? kMillimetres / found : found < 1 ? 1 / found : found;
    if (!std::isfinite(scale) || (!is_bop_unit && found >= 1 && found < least)) refuse_scale(m);
    return scale;
  }

  Camera of(const Members& m) const {
    const bool has_numbers = m.fx && m.fy && m.cx && m.cy;
    if (!m.matrix && (m.fx || m.fy || m.cx || m.cy) && !has_numbers) {
      std::vector<std::string_view> missing;
      if (!m.fx) missing.emplace_back("no fx");
      if (!m.fy) missing.emplace_back("no fy");
      if (!m.cx) missing.emplace_back(m.is_bop ? "no cx" : "no ppx");
      if (!m.cy) missing.emplace_back(m.is_bop ? "no cy" : "no ppy");
      input_.fail({"not a camera", fmt::format("{}", fmt::join(missing, " and ")),
                   "fx, fy, ppx and ppy, or fx, fy, cx and cy", way_to_intrinsics()});
    }
    if (!has_numbers && (!m.matrix || m.width == 0 || m.height == 0)) {
      std::vector<std::string_view> missing;
      if (!m.matrix) missing.emplace_back("no intrinsic_matrix");
      if (m.width == 0) missing.emplace_back("no width");
      if (m.height == 0) missing.emplace_back("no height");
      input_.fail({"not an Open3D camera", fmt::format("{}", fmt::join(missing, " and ")),
                   "intrinsic_matrix, width and height", way_to_intrinsics()});
    }
    if (m.matrix && has_numbers)
      input_.fail({"several cameras", "a matrix and fx", "one of them", way_to_intrinsics()});
    Camera camera;
    camera.intrinsics = m.matrix ? *m.matrix : Intrinsics{*m.fx, *m.fy, *m.cx, *m.cy};
    if (const auto& k = camera.intrinsics;
        !(k.fx > 0 && k.fy > 0 && std::isfinite(k.fx + k.fy + k.cx + k.cy)))
      input_.fail({"focal lengths", fmt::format("{} and {}", k.fx, k.fy), "numbers above 0",
                   way_to_intrinsics()});
    if ((m.width == 0) != (m.height == 0))
      input_.fail({"not a camera",
                   m.width == 0 ? "no width" : "no height",
                   "both width and height, or neither",
                   {}});
    camera.width = m.width;
    camera.height = m.height;
    camera.depth_scale = scale_of(m);
    camera.lens = lens_of(m);
    return camera;
  }

  Lens lens_of(const Members& m) const {
    if (std::ranges::all_of(m.coefficients, [](double c) { return c == 0; })) return {};
    constexpr std::size_t count = 5;
    // The SDK of RealSense writes "distortion.brown_conrady" or "Brown Conrady".
    std::string model = m.model.substr(m.model.find('.') + 1);  // npos + 1 is 0
    for (char& c : model) c = c == ' ' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (model != "brown_conrady" || m.coefficients.size() != count)
      json_.fail(m.lens_place, {"lens model",
                                fmt::format("{} coefficients of \"{}\"", m.coefficients.size(),
                                            printable(m.model, 40)),
                                "5 coefficients of brown_conrady, or only zeros",
                                "rectify the image, and use a camera without distortion"});
    Lens lens;
    lens.model = Lens::Model::polynomial;
    std::ranges::copy(m.coefficients, lens.coefficients.begin());
    return lens;
  }

  JsonCursor json_;
  const Input& input_;
  Members picture_;
  std::string first_;
  bool has_pictures_ = false;
};

}  // namespace

Camera read_json_camera(const Input& input) { return CameraJson(input).camera(); }

}  // namespace ph::detail
