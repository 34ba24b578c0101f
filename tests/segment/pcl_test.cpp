// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <ph/pcl.hpp>

#include "scenery.hpp"

namespace ph::pcl {
namespace {

using ph::segment::test::TableScene;

template <class PointT>
typename ::pcl::PointCloud<PointT>::Ptr cloud_of(const TableScene& scene) {
  auto cloud = std::make_shared<::pcl::PointCloud<PointT>>(
      static_cast<std::uint32_t>(scene.kWidth), static_cast<std::uint32_t>(scene.kHeight));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].x = scene.xyz()[3 * i];
    (*cloud)[i].y = scene.xyz()[3 * i + 1];
    (*cloud)[i].z = scene.xyz()[3 * i + 2];
  }
  cloud->is_dense = false;
  return cloud;
}

template <class PointT>
class Adapter : public testing::Test {};
using PointTypes = testing::Types<::pcl::PointXYZ, ::pcl::PointXYZRGB, ::pcl::PointXYZRGBNormal>;
TYPED_TEST_SUITE(Adapter, PointTypes);

TYPED_TEST(Adapter, AgreesWithPlainArrays) {
  const TableScene scene = TableScene::two_boxes();
  const auto expected = ph::segment::segment(ph::segment::CloudView{scene.xyz(), {}});
  const auto cloud = cloud_of<TypeParam>(scene);
  EXPECT_EQ(segment_cloud(*cloud).labels, expected.labels);

  PersistenceSegmentation<TypeParam> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<::pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  ASSERT_EQ(clusters.size(), 2U);
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    EXPECT_EQ(static_cast<Index>(clusters[k].indices.size()), expected.segments[k].points);
    for (const auto i : clusters[k].indices) {
      EXPECT_EQ(expected.labels[static_cast<std::size_t>(i)], k + 1);
    }
  }
  const auto labelled = segmentation.getLabeledCloud();
  EXPECT_EQ(labelled.width, cloud->width);
  EXPECT_EQ(labelled.height, cloud->height);
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    ASSERT_EQ(labelled[i].label, expected.labels[i]);
  }
}

TEST(PclAdapter, IndicesAndOptions) {
  const TableScene scene = TableScene::two_boxes();
  const auto cloud = cloud_of<::pcl::PointXYZ>(scene);
  const auto left = std::make_shared<::pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (scene.truth()[i] == 1) left->push_back(static_cast<::pcl::index_t>(i));
  }
  PersistenceSegmentation<::pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setIndices(left);
  segmentation.setOptions({.plane = false});
  std::vector<::pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].indices, *left);
  EXPECT_EQ(segmentation.result().labels.size(), cloud->size());
}

TEST(PclAdapter, NoCloudAndEmptyCloud) {
  PersistenceSegmentation<::pcl::PointXYZ> segmentation;
  std::vector<::pcl::PointIndices> clusters(3);
  segmentation.segment(clusters);
  EXPECT_TRUE(clusters.empty());
  segmentation.setInputCloud(std::make_shared<::pcl::PointCloud<::pcl::PointXYZ>>());
  segmentation.segment(clusters);
  EXPECT_TRUE(clusters.empty());
}

TEST(PclAdapter, TheSensorsOriginIsTheViewpoint) {
  const TableScene scene = TableScene::two_boxes();
  const auto cloud = cloud_of<::pcl::PointXYZ>(scene);
  cloud->sensor_origin_[2] = 2.5F;  // below the table
  EXPECT_TRUE(segment_cloud(*cloud, {.max_range = 5}).segments.empty());
}

}  // namespace
}  // namespace ph::pcl
