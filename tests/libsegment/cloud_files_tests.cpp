// SPDX-License-Identifier: MIT
#include "cloud_files.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>

#include "libsegment/scenery.hpp"
#include "ph/error.hpp"

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

/// 3 x 2 points with a hole, a colour whose float is NaN and, if wanted, labels.
Cloud small_cloud(bool labelled) {
  std::vector<float> xyz(18, 1.5F);
  xyz[3] = xyz[4] = xyz[5] = test::kHole;
  Cloud cloud = test::cloud_of(xyz, 3, 2);
  const std::size_t rgb = cloud.add_field("rgb", FieldType::uint32);
  cloud.fields[rgb].type = FieldType::float32;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::uint32_t bits = 0xFFFFFF00U + static_cast<std::uint32_t>(i);  // a NaN
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

TEST(CloudFormat, ByExtension) {
  EXPECT_EQ(cloud_format_of("a/b.pcd"), CloudFormat::pcd);
  EXPECT_EQ(cloud_format_of("B.PLY"), CloudFormat::ply);
  EXPECT_EQ(cloud_format_of("-"), CloudFormat::pcd);
  EXPECT_THROW(cloud_format_of("pcd"), Error);
}

}  // namespace
}  // namespace ph::segment
