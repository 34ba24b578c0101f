// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_files.hpp"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/output_file.hpp"
#include "ph/error.hpp"
#include "ph/io/cloud.hpp"
#include "ph/segment.hpp"

namespace ph::segment {
namespace {

/// Returns an unused name. This is label_in or, in a cloud that was labelled before, label_in_2,
/// label_in_3, …
std::string free_name(const Cloud& cloud) {
  std::string name = "label_in";
  for (int i = 2; cloud.find(name); ++i) name = fmt::format("label_in_{}", i);
  return name;
}

}  // namespace

CloudFormat cloud_format_of(std::string_view path) {
  if (path == "-" || ends_in(path, ".pcd")) return CloudFormat::pcd;
  if (ends_in(path, ".ply")) return CloudFormat::ply;
  throw Error(ErrorKind::usage,
              fmt::format("{}: expected a file name that ends in .pcd or .ply", path));
}

std::string cloud_bytes(Cloud cloud, CloudFormat format) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // otherwise the stream would hide a lack of memory
  const Cloud told = in_terms_of(format, std::move(cloud));
  if (format == CloudFormat::pcd) {
    write_pcd(out, told);
  } else {
    write_ply(out, told);
  }
  return std::move(out).str();
}

Cloud read_cloud(const std::filesystem::path& path) { return ph::read_cloud(path); }

Cloud with_labels(const Cloud& cloud, std::span<const std::uint32_t> labels) {
  cloud.check();
  if (static_cast<Index>(labels.size()) != cloud.size()) {
    throw Error(ErrorKind::usage, fmt::format("found {} labels, expected {}, one per point",
                                              labels.size(), cloud.size()));
  }
  Cloud result = cloud;
  for (CloudField& field : result.fields) {
    if (field.name == "label") field.name = free_name(cloud);
  }
  const std::size_t field = result.add_field("label", FieldType::uint32);
  result.set_uint32(field, {labels.begin(), labels.end()});
  return result;
}

void write_cloud(const std::filesystem::path& path, const Cloud& cloud,
                 std::span<const std::uint32_t> labels) {
  const CloudFormat format = cloud_format_of(path.string());
  write_file(path.string(), cloud_bytes(with_labels(cloud, labels), format));
}

}  // namespace ph::segment
