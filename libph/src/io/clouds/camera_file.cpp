// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "libph/src/io/bytes/yaml_words.hpp"
#include "libph/src/io/clouds/camera_file.hpp"
#include "libph/src/io/clouds/camera_members.hpp"
#include "ph/detail/core/floating.hpp"
#include "ph/detail/io/camera.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using detail::YamlWords;

using detail::kMostPixels;

/// Advice on a file that is not a camera.
std::string what_it_is() {
  return "a camera_info YAML file from ROS has image_width, image_height and camera_matrix, other "
         "files have fx, fy, cx and cy; " +
         detail::way_to_intrinsics();
}

/// The data of a calibration while its file is read.
class CameraYaml {
 public:
  explicit CameraYaml(const Input& input) : yaml_(input) {}

  Camera camera() const {
    if (find_matrix() == nullptr)
      if (const auto named = cameras_of_numbers(); !named.empty())
        return detail::camera_of(named, yaml_.input());
    Camera camera;
    camera.width = whole({"image_width", "width"}, 1, kMostPixels);
    camera.height = whole({"image_height", "height"}, 1, kMostPixels);
    camera.intrinsics = intrinsics();
    camera.lens = lens();
    take_part(camera);
    return camera;
  }

 private:
  using Names = std::initializer_list<std::string_view>;
  [[noreturn]] void fail(const YamlWords::Word& word, std::string what,
                         std::string expected) const {
    yaml_.input().fail_at(
        word.line, word.column,
        {std::move(what), '"' + printable(word.text, 40) + '"', std::move(expected), {}});
  }
  [[noreturn]] void fail(const YamlWords::Value& value, const Fault& fault) const {
    yaml_.input().fail_at(value.line, value.column, fault);
  }

  /// The value of the first of these names that has words, or null.
  const YamlWords::Value* find(Names names) const {
    for (const std::string_view name : names)
      if (const YamlWords::Value* value = yaml_.find(name);
          value != nullptr && !value->words.empty())
        return value;
    return nullptr;
  }
  const YamlWords::Value& require(Names names) const {
    const YamlWords::Value* value = find(names);
    if (value == nullptr) {
      yaml_.input().fail(
          {fmt::format("no {}", *names.begin()), {}, "a camera's calibration", what_it_is()});
    }
    return *value;
  }

  const YamlWords::Value* find_matrix() const {
    return find({"camera_matrix.data", "camera_matrix", "k"});
  }

  double number(const YamlWords::Word& word) const {
    double number = 0;
    std::string_view text = word.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [stop, error] = floating_from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number))
      fail(word, "not a number", "a finite decimal number");
    return number;
  }
  std::vector<double> numbers(const YamlWords::Value& value) const {
    std::vector<double> result;
    for (const YamlWords::Word& word : value.words) result.push_back(number(word));
    return result;
  }
  Index whole(const YamlWords::Value& value, Index least, Index most) const {
    const YamlWords::Word& word = value.words.front();
    const double found = number(word);
    if (value.words.size() != 1 || found != std::floor(found) ||
        found < static_cast<double>(least) || found > static_cast<double>(most))
      fail(word, "not a number of pixels",
           fmt::format("a whole number from {} to {}", least, most));
    return static_cast<Index>(found);
  }
  Index whole(Names names, Index least, Index most) const {
    return whole(require(names), least, most);
  }
  Index whole_or(std::string_view name, Index other, Index most) const {
    const YamlWords::Value* value = find({name});
    return value == nullptr ? other : whole(*value, 0, most);
  }

  Intrinsics intrinsics() const {
    const YamlWords::Value* found = find_matrix();
    const YamlWords::Value& value = found != nullptr ? *found : require({"camera_matrix.data"});
    const std::vector<double> k = numbers(value);
    if (k.size() != 9) {
      fail(value, {"camera matrix", fmt::format("{} numbers", k.size()), "9, row by row", {}});
    }
    return detail::intrinsics_of(std::span<const double, 9>(k),
                                 [&](const Fault& fault) { fail(value, fault); });
  }

  /// The cameras of a file that has no matrix but fx, fy and the principal point: in its outermost
  /// mapping, or under names such as color and depth.
  std::vector<std::pair<std::string, detail::CameraMembers>> cameras_of_numbers() const {
    std::vector<std::pair<std::string, detail::CameraMembers>> cameras;
    for (const std::string& owner : yaml_.owners_of("fx")) {
      const auto number_of = [&](std::string_view name) -> std::optional<double> {
        const YamlWords::Value* value = find({owner + std::string(name)});
        if (value == nullptr) return std::nullopt;
        if (value->words.size() != 1) fail(value->words[1], "more than one number", "one");
        return number(value->words.front());
      };
      detail::CameraMembers m;
      m.fx = number_of("fx");
      m.fy = number_of("fy");
      m.is_bop = number_of("cx").has_value();
      m.cx = number_of(m.is_bop ? "cx" : "ppx");
      m.cy = number_of(m.is_bop ? "cy" : "ppy");
      m.width = whole_or(owner + "width", 0, kMostPixels);
      m.height = whole_or(owner + "height", 0, kMostPixels);
      take_scale(m, {owner + "depth_scale", "depth_scale"});
      if (!m.depth_scale) {
        take_scale(m, {"depthmapfactor", "rgbd.depthmapfactor"});  // of ORB-SLAM: units per metre
        m.is_bop = m.is_bop && !m.depth_scale;
      }
      cameras.emplace_back(owner.substr(0, owner.find_last_of('.')), std::move(m));
    }
    if (!cameras.empty()) refuse_coefficients();
    return cameras;
  }

  void take_scale(detail::CameraMembers& m, Names names) const {
    const YamlWords::Value* value = find(names);
    if (value == nullptr) return;
    m.depth_scale = number(value->words.front());
    m.scale_place = {value->words.front().line, value->words.front().column};
    if (!(*m.depth_scale > 0)) m.refuse_scale(yaml_.input());
  }

  /// Refuses lens coefficients beside fx, because files of this kind do not name their model.
  /// Coefficients that are all zero are accepted.
  void refuse_coefficients() const {
    for (const std::string_view name :
         {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "d", "coeffs", "dist", "dist_coeffs",
          "distortion", "distortion_coefficients"})
      for (std::string path : yaml_.owners_of(name)) {
        path += name;
        const YamlWords::Value* value = find({path + ".data", path});
        if (value == nullptr || std::ranges::all_of(value->words, is_zero)) continue;
        fail(*value, {"lens coefficients", '"' + path + '"', "none, or only zeros",
                      "rectify the image, and use a camera without distortion"});
      }
  }

  static bool is_zero(const YamlWords::Word& word) { return detail::number_in(word.text) == 0.0; }

  static bool is_known(std::string_view model) {
    constexpr std::array<std::string_view, 6> kKnown{
        "plumb_bob", "rational_polynomial", "equidistant", "fisheye", "none", "pinhole"};
    return std::ranges::find(kKnown, model) != kKnown.end();
  }

  /// Refuses lens coefficients under names that are not read. Coefficients that are all zero are
  /// accepted, because they mean a lens without distortion.
  void refuse_other_names() const {
    for (const std::string_view name :
         {"dist_coeffs", "dist_coeff", "distcoeffs", "distcoeff", "dist_coefs", "distortion",
          "distortion_coeffs", "distortion_coefficient", "distortion_parameters", "dist"}) {
      const YamlWords::Value* value = find({std::string(name) + ".data", name});
      if (value == nullptr || std::ranges::all_of(value->words, is_zero)) continue;
      fail(*value,
           {"lens coefficients", '"' + std::string(name) + '"', "distortion_coefficients", {}});
    }
  }

  Lens lens() const {
    const YamlWords::Value* value =
        find({"distortion_coefficients.data", "distortion_coefficients", "d.data", "d"});
    if (value == nullptr) refuse_other_names();
    std::vector<double> d = value == nullptr ? std::vector<double>{} : numbers(*value);
    const YamlWords::Value* named = find({"distortion_model"});
    const YamlWords::Value* fisheye = find({"fisheye_model"});
    // Files of OpenCV do not name the model. A flag or the number of coefficients determines it.
    const std::string_view name = named != nullptr ? named->words.front().text
                                  : fisheye != nullptr && number(fisheye->words[0]) != 0 ? "fisheye"
                                  : d.size() >= 8                  ? "rational_polynomial"
                                  : d.size() == 4 || d.size() == 5 ? "plumb_bob"
                                                                   : "";
    const bool is_zero = std::ranges::all_of(d, [](double c) { return c == 0; });
    if (is_zero && (!d.empty() || named == nullptr || is_known(name))) return {};
    Lens lens;
    std::size_t least = 0, most = 0;
    if (name == "plumb_bob") {
      lens.model = Lens::Model::polynomial;
      least = 4;
      most = 5;
    } else if (name == "rational_polynomial") {
      lens.model = Lens::Model::polynomial;
      least = most = 8;
    } else if (name == "equidistant" || name == "fisheye") {
      lens.model = Lens::Model::equidistant;
      least = most = 4;
    } else {
      fail(named == nullptr ? *value : *named,
           {"lens model",
            named == nullptr ? fmt::format("none, and {} coefficients", d.size())
                             : '"' + printable(name, 40) + '"',
            "plumb_bob, rational_polynomial or equidistant",
            "rectify the image, and use a camera without distortion"});
    }
    // OpenCV writes up to 14 coefficients. The last coefficients are for thin prisms and tilted
    // sensors, which most lenses do not have.
    while (d.size() > most && d.back() == 0) d.pop_back();  // mutant: camera-coefficients
    if (d.size() < least || d.size() > most) {
      fail(*value, {fmt::format("coefficients of {}", name),
                    fmt::format("{}", d.size()),
                    least == most ? fmt::format("{}", most) : fmt::format("{} or {}", least, most),
                    {}});
    }
    std::ranges::copy(d, lens.coefficients.begin());
    return lens;
  }

  /// Adapts the camera to an image that is only a part of the calibrated image, or in which several
  /// pixels are merged into one.
  void take_part(Camera& camera) const {
    const Index left = whole_or("roi.x_offset", 0, camera.width);
    const Index top = whole_or("roi.y_offset", 0, camera.height);
    if (const Index width = whole_or("roi.width", 0, camera.width); width > 0) camera.width = width;
    if (const Index height = whole_or("roi.height", 0, camera.height); height > 0)
      camera.height = height;
    const Index across = std::max<Index>(1, whole_or("binning_x", 1, camera.width));
    const Index down = std::max<Index>(1, whole_or("binning_y", 1, camera.height));
    camera.width /= across;
    camera.height /= down;
    Intrinsics& k = camera.intrinsics;
    k = {k.fx / static_cast<double>(across), k.fy / static_cast<double>(down),
         (k.cx - static_cast<double>(left)) / static_cast<double>(across),
         (k.cy - static_cast<double>(top)) / static_cast<double>(down)};
  }

  YamlWords yaml_;
};

}  // namespace

Camera read_camera(const Input& input) {
  const std::string_view text = input.text();
  constexpr std::size_t most = 1 << 20;
  if (text.size() > most) {
    input.fail({"not a camera", fmt::format("{} bytes", text.size()),
                fmt::format("at most {}", most), what_it_is()});
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '{') return detail::read_json_camera(input);
  // A camera matrix begins with a focal length, which is positive.
  if (first != text.npos && std::string_view("0123456789.+[").find(text[first]) != text.npos &&
      text.find_first_not_of("0123456789+-.eE,;[] \t\r\n") == text.npos)
    return detail::read_matrix_camera(input);
  return CameraYaml(input).camera();
}

Camera read_camera(const std::filesystem::path& path, const RunContext* context) {
  return read_camera(
      Input::open(path, context, Input::Excess::refused, detail::start_check(Format::points)));
}

}  // namespace ph
