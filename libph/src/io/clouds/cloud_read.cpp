// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

void refuse_picture(const Input& input) {
  if (!detail::is_png(input)) return;
  input.fail({"a picture", "PNG", "a cloud in PCD, PLY, NPY or text",
              fmt::format("a depth image needs a camera: {} or {}", mark(Setting::camera),
                          mark(Setting::intrinsics))});
}

}  // namespace

Cloud read_cloud(const Input& input, const ReadOptions& options) {
  refuse_picture(input);
  if (!input.member().empty()) {
    input.fail({"a part of a file", printable(input.member(), 40), "the file itself", {}});
  }
  const auto read = [&] {
    if (detail::is_pcd(input) || input.extension() == ".pcd") return read_pcd(input, options);
    if (detail::is_ply(input) || input.extension() == ".ply") return read_ply(input, options);
    if (detail::is_npy(input)) return read_npy_cloud(input, options);
    if (input.extension() == ".pts" && detail::is_counted(input)) return read_pts(input, options);
    if (detail::is_off(input))
      input.fail({"a mesh", "OFF", "a cloud in PCD, PLY, NPY or text", "convert it to PLY"});
    if (!detail::is_text(input.text()))
      detail::refuse_bytes(input,
                           "numpy.save writes numbers without a header as NPY, one point "
                           "per row");
    return read_xyz(input, options);
  };
  Cloud cloud = read();
  for (const std::string_view name : {"x", "y", "z"}) {
    const CloudField* field = cloud.find(name);
    if (field == nullptr || field->count != 1) {
      input.fail({fmt::format("no coordinate {}", name), {}, "fields x, y and z", {}});
    }
  }
  return cloud;
}

Input::StartCheck cloud_start_check() {
  return [](const Input& start) {
    refuse_picture(start);
    const bool is_mesh = detail::is_ply(start) || start.extension() == ".ply";
    const bool is_pcd = detail::is_pcd(start) || start.extension() == ".pcd";
    const bool is_array = detail::is_npy(start);
    detail::start_check(is_pcd     ? Format::pcd
                        : is_mesh  ? Format::ply
                        : is_array ? Format::npy
                                   : Format::xyz)(start);
  };
}

Cloud read_cloud(const std::filesystem::path& path, const ReadOptions& options) {
  return read_cloud(Input::open(path, options.context, Input::Excess::refused, cloud_start_check()),
                    options);
}

}  // namespace ph
