// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_files.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>

#include "ph/error.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment {
namespace {

std::vector<std::uint32_t> numbers(const Cloud& cloud, std::string_view name) {
  const CloudField* field = cloud.find(name);
  std::vector<std::uint32_t> values;
  if (!field || field->type != FieldType::uint32) return values;
  for (Index i = 0; i < cloud.size(); ++i) {
    std::uint32_t value = 0;
    std::memcpy(&value, &cloud.data[static_cast<std::size_t>(i) * cloud.stride + field->offset], 4);
    values.push_back(value);
  }
  return values;
}

/// A cloud of 3 x 2 points with a hole, with a colour whose bits are a NaN as a float and, if
/// requested, with labels.
Cloud small_cloud(bool labelled) {
  std::vector<float> xyz(18, 1.5F);
  xyz[3] = xyz[4] = xyz[5] = test::kHole;
  Cloud cloud = test::cloud_of(xyz, 3, 2);
  const std::size_t rgb = cloud.add_field("rgb", FieldType::uint32);
  cloud.fields[rgb].type = FieldType::float32;
  for (std::size_t i = 0; i < 6; ++i) {
    // As a float, these bits are a NaN.
    const std::uint32_t bits = 0xFFFFFF00U + static_cast<std::uint32_t>(i);
    std::memcpy(&cloud.data[i * cloud.stride + cloud.fields[rgb].offset], &bits, 4);
  }
  if (labelled) cloud.set_uint32(cloud.add_field("label", FieldType::uint32), {9, 8, 7, 6, 5, 4});
  return cloud;
}

class Folder {
 public:
  Folder() { path_ = mkdtemp(name_); }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* file) const { return path_ / file; }

 private:
  char name_[32] = "/tmp/ph_segment_XXXXXX";
  std::filesystem::path path_;
};

TEST(WithLabels, KeepsAllFieldsAndOrganisation) {
  const Cloud in = small_cloud(false);
  const Cloud out = with_labels(in, std::vector<std::uint32_t>{1, 0, 2, 2, 1, 0});
  EXPECT_EQ(out.width, 3);
  EXPECT_EQ(out.height, 2);
  EXPECT_EQ(out.fields.size(), 5U);
  EXPECT_EQ(numbers(out, "label"), (std::vector<std::uint32_t>{1, 0, 2, 2, 1, 0}));
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(std::memcmp(&out.data[i * out.stride], &in.data[i * in.stride], in.stride), 0);
  }
}

TEST(WithLabels, AnExistingLabelBecomesLabelIn) {
  const std::vector<std::uint32_t> ones(6, 1), twos(6, 2);
  const Cloud once = with_labels(small_cloud(true), ones);
  EXPECT_EQ(numbers(once, "label_in"), (std::vector<std::uint32_t>{9, 8, 7, 6, 5, 4}));
  EXPECT_EQ(numbers(once, "label"), ones);
  const Cloud again = with_labels(once, twos);
  EXPECT_EQ(numbers(again, "label_in"), (std::vector<std::uint32_t>{9, 8, 7, 6, 5, 4}));
  EXPECT_EQ(numbers(again, "label_in_2"), ones);
  EXPECT_EQ(numbers(again, "label"), twos);
}

TEST(WithLabels, OneLabelAPoint) {
  EXPECT_THROW(with_labels(small_cloud(false), std::vector<std::uint32_t>(5)), Error);
}

TEST(WriteCloud, ReadsBackFromPcdAndPly) {
  const Folder folder;
  const std::vector<std::uint32_t> labels = {1, 0, 2, 2, 1, 0};
  const Cloud cloud = small_cloud(true);
  write_cloud(folder / "a.pcd", cloud, labels);
  const Cloud pcd = read_cloud(folder / "a.pcd");
  EXPECT_EQ(pcd.width, 3);
  EXPECT_EQ(pcd.height, 2);
  EXPECT_EQ(pcd.data, with_labels(cloud, labels).data);
  write_cloud(folder / "a.PLY", cloud, labels);
  const Cloud ply = read_cloud(folder / "a.PLY");
  EXPECT_EQ(ply.size(), 6);
  EXPECT_EQ(numbers(ply, "label"), labels);
  EXPECT_EQ(numbers(ply, "label_in"), numbers(cloud, "label"));
  EXPECT_EQ(ply.rgb(), cloud.rgb());
  EXPECT_THROW(write_cloud(folder / "a.txt", cloud, labels), Error);
}

/// The name, the type and the value of a field, for a cloud of one point.
struct Column {
  std::string name;
  FieldType type;
  double value;
};
Cloud one_point(const std::vector<Column>& columns) {
  Cloud cloud;
  cloud.width = 1;
  for (const auto& [name, type, value] : columns) {
    const std::size_t at = cloud.data.size();
    cloud.fields.push_back({name, type, 1, at});
    cloud.data.resize(at + size_of(type));
    const auto narrow = static_cast<float>(value);
    const auto byte = static_cast<std::byte>(value);
    if (type == FieldType::float64) std::memcpy(&cloud.data[at], &value, 8);
    if (type == FieldType::float32) std::memcpy(&cloud.data[at], &narrow, 4);
    if (type == FieldType::uint8) cloud.data[at] = byte;
  }
  cloud.stride = cloud.data.size();
  return cloud;
}
std::string names_in(const Cloud& cloud) {
  std::string names;
  for (const CloudField& field : cloud.fields)
    names += field.name + (field.type == FieldType::float64 ? "(double) " : " ");
  return names;
}
constexpr auto kDouble = FieldType::float64;
constexpr auto kSingle = FieldType::float32;
constexpr auto kByte = FieldType::uint8;

TEST(CloudTerms, PcdHasSinglePrecisionWhereThatIsFineEnough) {
  const auto told = [](double x) {
    return in_terms_of(CloudFormat::pcd, one_point({{"x", kDouble, x},
                                                    {"y", kDouble, 0.1},
                                                    {"z", kDouble, test::kHole},
                                                    {"time", kDouble, 1.7e9}}));
  };
  EXPECT_EQ(names_in(told(-1024)), "x y z time(double) ");
  EXPECT_EQ(told(-1024).xyz()[1], 0.1F);
  EXPECT_EQ(names_in(told(1025)), "x(double) y(double) z(double) time(double) ");
  const Cloud ply = in_terms_of(CloudFormat::ply, one_point({{"x", kDouble, 1}}));
  EXPECT_EQ(names_in(ply), "x(double) ");
}

TEST(CloudTerms, NormalsHaveTheNamesOfTheFormat) {
  const std::vector<Column> pcd{{"x", kSingle, 1},
                                {"normal_x", kSingle, 0.5},
                                {"normal_y", kSingle, 0.25},
                                {"normal_z", kSingle, 0}};
  const Cloud ply = in_terms_of(CloudFormat::ply, one_point(pcd));
  EXPECT_EQ(names_in(ply), "x nx ny nz ");
  EXPECT_EQ(ply.data, one_point(pcd).data);
  EXPECT_EQ(names_in(in_terms_of(CloudFormat::pcd, ply)), "x normal_x normal_y normal_z ");
  // If only one of the three names exists, the field is not part of a normal. A name that already
  // exists is not used again.
  EXPECT_EQ(names_in(in_terms_of(CloudFormat::pcd, one_point({{"nx", kSingle, 1}}))), "nx ");
  std::vector<Column> both = pcd;
  for (const char* name : {"nx", "ny", "nz"}) both.push_back({name, kSingle, 1});
  EXPECT_EQ(names_in(in_terms_of(CloudFormat::pcd, one_point(both))),
            "x normal_x normal_y normal_z nx ny nz ");
}

TEST(CloudTerms, ColoursAreOneNumberInPcd) {
  const auto rgba_of = [](const std::vector<Column>& columns, const std::string& names) {
    const Cloud cloud = in_terms_of(CloudFormat::pcd, one_point(columns));
    EXPECT_EQ(names_in(cloud), names);
    return numbers(cloud, "rgba").at(0);
  };
  EXPECT_EQ(rgba_of({{"red", kByte, 1}, {"green", kByte, 2}, {"blue", kByte, 3}, {"t", kByte, 4}},
                    "rgba t "),
            0xFF010203U);
  EXPECT_EQ(rgba_of({{"alpha", kByte, 9},
                     {"x", kSingle, 1},
                     {"blue", kByte, 3},
                     {"green", kByte, 2},
                     {"red", kByte, 1}},
                    "rgba x "),
            0x09010203U);
  EXPECT_EQ(rgba_of({{"r", kByte, 1}, {"g", kByte, 2}, {"b", kByte, 3}}, "rgba "), 0xFF010203U);
  EXPECT_EQ(rgba_of({{"red", kDouble, 1}, {"green", kDouble, 0}, {"blue", kDouble, 0.2}},
                    "red(double) green(double) blue(double) rgba "),
            0xFFFF0033U);
  const std::vector<Column> alone{{"alpha", kByte, 9}, {"x", kSingle, 1}};
  EXPECT_EQ(names_in(in_terms_of(CloudFormat::pcd, one_point(alone))), "alpha x ");
  const Cloud packed = small_cloud(false);
  EXPECT_EQ(names_in(in_terms_of(CloudFormat::pcd, packed)), names_in(packed));
}

TEST(CloudTerms, PaddingIsLeftOut) {
  const std::vector<Column> padded{
      {"x", kSingle, 1}, {"_", kByte, 2}, {"y", kSingle, 3}, {"_", kSingle, 4}};
  for (const CloudFormat format : {CloudFormat::pcd, CloudFormat::ply}) {
    const Cloud cloud = in_terms_of(format, one_point(padded));
    EXPECT_EQ(names_in(cloud), "x y ");
    EXPECT_EQ(cloud.data, one_point({{"x", kSingle, 1}, {"y", kSingle, 3}}).data);
  }
}

TEST(CloudFormat, ByExtension) {
  EXPECT_EQ(cloud_format_of("a/b.pcd"), CloudFormat::pcd);
  EXPECT_EQ(cloud_format_of("B.PLY"), CloudFormat::ply);
  EXPECT_EQ(cloud_format_of("-"), CloudFormat::pcd);
  EXPECT_THROW(cloud_format_of("pcd"), Error);
}

}  // namespace
}  // namespace ph::segment
