// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace ph::segment {
namespace {

using Names = std::array<std::string_view, 3>;
constexpr Names kCoordinates{"x", "y", "z"};
constexpr Names kNormals{"normal_x", "normal_y", "normal_z"};
constexpr Names kNormalsOfPly{"nx", "ny", "nz"};
constexpr std::array<Names, 3> kColours{
    {{"red", "green", "blue"}, {"r", "g", "b"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}}};

std::optional<std::size_t> place_in(const Names& names, std::string_view name) {
  const auto* const found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// True if the cloud has all three fields, each with one number per point.
bool has(const Cloud& cloud, const Names& names) {
  return std::ranges::all_of(names, [&](std::string_view name) {
    const CloudField* const field = cloud.find(name);
    return field != nullptr && field->count == 1;
  });
}

bool is_double(const CloudField& field) {
  return field.type == FieldType::float64 && field.count == 1;
}

double double_at(const Cloud& cloud, std::size_t point, const CloudField& field) {
  double value = 0;
  std::memcpy(&value, cloud.data.data() + point * cloud.stride + field.offset, sizeof(value));
  return value;
}

/// True if single precision is exact enough for all coordinates.
bool is_near(const Cloud& cloud) {
  for (const std::string_view name : kCoordinates) {
    const CloudField* const field = cloud.find(name);
    if (field == nullptr || !is_double(*field)) continue;
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i)
      // mutant: cloud-single
      if (std::abs(double_at(cloud, i, *field)) > kSinglePrecisionReach) return false;
  }
  return true;
}

/// The fields of the new cloud, and their sources.
class Terms {
 public:
  Terms(CloudFormat format, const Cloud& cloud) : format_(format), cloud_(cloud) {
    const bool is_pcd = format == CloudFormat::pcd;
    is_narrowed_ = is_pcd && is_near(cloud);
    if (is_pcd && cloud.find("rgba") == nullptr && cloud.find("rgb") == nullptr)
      colours_ = cloud.rgb();
    const CloudField* const alpha = cloud.find("alpha");
    if (colours_ && alpha != nullptr && is_part_of_colour(*alpha)) alpha_ = alpha;
    for (const CloudField& field : cloud.fields) take(field);
    if (colours_ && !has_colours_) add("rgba", FieldType::uint32, 1, nullptr);
  }

  bool change_nothing() const {
    return fields_.size() == cloud_.fields.size() &&
           std::ranges::equal(fields_, cloud_.fields, [](const CloudField& a, const CloudField& b) {
             return a.name == b.name && a.type == b.type;
           });
  }

  Cloud cloud() const {
    Cloud result;
    result.width = cloud_.width;
    result.height = cloud_.height;
    result.viewpoint = cloud_.viewpoint;
    result.fields = fields_;
    result.stride = stride_;
    result.data.resize(stride_ * static_cast<std::size_t>(cloud_.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud_.size()); ++i) {
      std::byte* const record = result.data.data() + i * stride_;
      for (std::size_t k = 0; k < fields_.size(); ++k) put(i, k, record + fields_[k].offset);
    }
    return result;
  }

 private:
  void add(std::string name, FieldType type, std::size_t count, const CloudField* source) {
    fields_.push_back({std::move(name), type, count, stride_});
    sources_.push_back(source);
    stride_ += count * size_of(type);
  }

  void take(const CloudField& field) {
    if (field.name == "_") return;  // mutant: cloud-padding
    if (colours_ && is_part_of_colour(field)) {
      if (!std::exchange(has_colours_, true)) add("rgba", FieldType::uint32, 1, nullptr);
      return;
    }
    const bool is_measure = place_in(kCoordinates, field.name) || place_in(kNormals, field.name) ||
                            place_in(kNormalsOfPly, field.name);
    const bool narrows = is_narrowed_ && is_measure && is_double(field);
    add(name_of(field), narrows ? FieldType::float32 : field.type, field.count, &field);
  }

  std::string name_of(const CloudField& field) const {
    const bool is_pcd = format_ == CloudFormat::pcd;
    const Names& from = is_pcd ? kNormalsOfPly : kNormals;
    const Names& to = is_pcd ? kNormals : kNormalsOfPly;
    const auto place = place_in(from, field.name);
    // mutant: cloud-normals
    if (!place || !has(cloud_, from) || cloud_.find(to[*place]) != nullptr) return field.name;
    return std::string(to[*place]);
  }

  bool is_part_of_colour(const CloudField& field) const {
    if (field.type != FieldType::uint8 || field.count != 1) return false;
    const auto* const names =
        std::ranges::find_if(kColours, [&](const Names& n) { return has(cloud_, n); });
    if (names == kColours.end()) return false;
    const bool are_bytes = std::ranges::all_of(
        *names, [&](std::string_view name) { return cloud_.find(name)->type == FieldType::uint8; });
    return are_bytes && (place_in(*names, field.name) || field.name == "alpha");
  }

  void put(std::size_t point, std::size_t k, std::byte* to) const {
    const CloudField* const source = sources_[k];
    if (source == nullptr) {
      // mutant: cloud-opacity
      const std::uint32_t colour = (*colours_)[point] | alpha(point) << 24;
      std::memcpy(to, &colour, sizeof(colour));
    } else if (fields_[k].type != source->type) {
      const auto value = static_cast<float>(double_at(cloud_, point, *source));
      std::memcpy(to, &value, sizeof(value));
    } else {
      std::memcpy(to, cloud_.data.data() + point * cloud_.stride + source->offset,
                  source->count * size_of(source->type));
    }
  }

  /// The alpha value of a point. It is opaque if the cloud has no alpha channel.
  std::uint32_t alpha(std::size_t point) const {
    if (alpha_ == nullptr) return 0xFF;
    return static_cast<std::uint32_t>(cloud_.data[point * cloud_.stride + alpha_->offset]);
  }

  CloudFormat format_;
  const Cloud& cloud_;
  bool is_narrowed_ = false;                           // true if doubles become float32
  std::optional<std::vector<std::uint32_t>> colours_;  // colours to be packed
  const CloudField* alpha_ = nullptr;  // the alpha channel that belongs to these colours
  bool has_colours_ = false;           // true if fields_ contains colours
  std::vector<CloudField> fields_;
  std::vector<const CloudField*> sources_;  // the source of each field; nullptr if it is colours_
  std::size_t stride_ = 0;
};

}  // namespace

Cloud in_terms_of(CloudFormat format, Cloud cloud) {
  const Terms terms(format, cloud);
  if (terms.change_nothing()) return cloud;
  return terms.cloud();
}

}  // namespace ph::segment
