// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <ph/pcl.hpp>
#include <stdexcept>

#include "tests/libsegment/scenery.hpp"
#include "tests/support/run_contexts.hpp"

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

TEST(PclAdapter, TellsWhatIsDoubtful) {
  const auto cloud = cloud_of<::pcl::PointXYZ>(TableScene::two_boxes());
  PersistenceSegmentation<::pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<::pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  EXPECT_TRUE(segmentation.getNotes().empty());
  for (auto& point : *cloud) point.getVector3fMap() *= 1000;
  segmentation.segment(clusters);
  EXPECT_TRUE(clusters.empty());
  ASSERT_EQ(segmentation.getNotes().size(), 1U);
  EXPECT_NE(segmentation.getNotes().front().find("are these millimetres?"), std::string::npos);
}

TYPED_TEST(Adapter, AgreesWithPlainArrays) {
  const TableScene scene = TableScene::two_boxes();
  const auto expected = ph::segment::segment(ph::segment::CloudView{scene.xyz(), {}});
  const auto cloud = cloud_of<TypeParam>(scene);
  const ph::segment::CloudView view = cloud_view(*cloud);
  EXPECT_EQ(view.xyz.data(), &(*cloud)[0].x) << "a copy";
  ASSERT_EQ(view.size(), cloud->size());
  EXPECT_EQ(view.point(cloud->size() - 1), &cloud->back().x);
  const auto organised = segment_cloud(*cloud);
  EXPECT_EQ(organised.cut.labels, expected.cut.labels);
  EXPECT_EQ(organised.tree.width, scene.kWidth);
  EXPECT_EQ(organised.tree.height, scene.kHeight);

  PersistenceSegmentation<TypeParam> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<::pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  ASSERT_EQ(clusters.size(), 2U);
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    EXPECT_EQ(static_cast<Index>(clusters[k].indices.size()), expected.cut.segments[k].points);
    for (const auto i : clusters[k].indices) {
      EXPECT_EQ(expected.cut.labels[static_cast<std::size_t>(i)], k + 1);
    }
  }
  EXPECT_EQ(segmentation.getTree().width, scene.kWidth);
  EXPECT_EQ(segmentation.getTree().height, scene.kHeight);
  const auto labelled = segmentation.getLabeledCloud();
  EXPECT_EQ(labelled.width, cloud->width);
  EXPECT_EQ(labelled.height, cloud->height);
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    ASSERT_EQ(labelled[i].label, expected.cut.labels[i]);
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
  EXPECT_EQ(segmentation.result().cut.labels.size(), cloud->size());
}

TEST(PclAdapter, NoCloudAndEmptyCloud) {
  PersistenceSegmentation<::pcl::PointXYZ> segmentation;
  std::vector<::pcl::PointIndices> clusters(3);
  EXPECT_TRUE(segmentation.getLabeledCloud().empty());
  EXPECT_TRUE(segmentation.getColoredCloud()->empty());
  segmentation.segment(clusters);
  EXPECT_TRUE(clusters.empty());
  segmentation.setInputCloud(std::make_shared<::pcl::PointCloud<::pcl::PointXYZ>>());
  segmentation.segment(clusters);
  EXPECT_TRUE(clusters.empty());
}

TEST(PclAdapter, ACloudWhoseRowsDoNotHoldItIsARow) {
  const TableScene scene = TableScene::two_boxes();
  const auto cloud = cloud_of<::pcl::PointXYZ>(scene);
  cloud->points.pop_back();  // fewer points than width times height
  const auto s = segment_cloud(*cloud);
  EXPECT_EQ(s.tree.height, 1);
  EXPECT_EQ(s.cut.segments.size(), 2U);
}

TEST(PclAdapter, ARunContextStopsAndBoundsIt) {
  const TableScene scene = TableScene::two_boxes();
  PersistenceSegmentation<::pcl::PointXYZ> s;
  s.setInputCloud(cloud_of<::pcl::PointXYZ>(scene));
  std::vector<::pcl::PointIndices> clusters;
  ph::test::StoppableContext context;
  s.setRunContext(context);
  s.segment(clusters);
  EXPECT_EQ(clusters.size(), 2U);
  EXPECT_GT(context.memory.peak(), 0U);
  context.request_stop();
  EXPECT_THROW(s.cut(0.1, clusters), ph::Error);
  EXPECT_THROW(s.segment(clusters), ph::Error);
  ph::test::LimitedContext small(1000);
  s.setRunContext(small);
  EXPECT_THROW(s.segment(clusters), ph::Error);
}

TEST(PclAdapter, TheSensorsOriginIsTheViewpoint) {
  const TableScene scene = TableScene::two_boxes();
  const auto cloud = cloud_of<::pcl::PointXYZ>(scene);
  cloud->width *= cloud->height;  // in an organised cloud, the rays would reveal the viewpoint
  cloud->height = 1;
  cloud->sensor_origin_[2] = 2.5F;  // a viewpoint below the table
  EXPECT_TRUE(segment_cloud(*cloud, {.max_range = 5}).cut.segments.empty());
}

TEST(PclAdapter, EverySetterReachesItsOption) {
  PersistenceSegmentation<::pcl::PointXYZ> s;
  s.setMethod(ph::segment::Method::paper);
  EXPECT_EQ(s.getVoxelSize(), 0.01);  // the default of this method
  EXPECT_EQ(s.getPlaneDistance(), 0.006);
  s.setMaxRange(3), s.setCropBox({-1, -2, -3}, {1, 2, 3}), s.setPlaneRemoval(false);
  s.setPlaneDistance(0.02), s.setViewPoint(1, 2, 3), s.setVoxelSize(0.004);
  s.setMinClusterSize(5), s.setMinPersistence(0.25), s.setMinPartSize(6), s.setObjects(false);
  s.setDistance(0.125), s.setSteps(7), s.setCheck(false), s.setSpacing(0.05);
  s.setPlaneNoise(0.003);
  const ph::segment::SegmentOptions& o = s.getOptions();
  EXPECT_EQ(o.max_range, 3);
  EXPECT_EQ(o.crop, (ph::segment::Box{{-1, -2, -3}, {1, 2, 3}}));
  EXPECT_EQ(o.viewpoint, (ph::segment::Vec3{1, 2, 3}));
  EXPECT_EQ(s.getMethod(), ph::segment::Method::paper);
  EXPECT_EQ(s.getMaxRange(), 3);
  EXPECT_FALSE(s.getPlaneRemoval());
  EXPECT_EQ(s.getPlaneDistance(), 0.02);
  EXPECT_EQ(s.getVoxelSize(), 0.004);
  EXPECT_EQ(s.getMinClusterSize(), 5);
  EXPECT_EQ(s.getMinPersistence(), 0.25);
  EXPECT_EQ(s.getMinPartSize(), 6);
  EXPECT_FALSE(s.getObjects());
  EXPECT_EQ(s.getDistance(), 0.125);
  EXPECT_EQ(s.getSteps(), 7);
  EXPECT_FALSE(s.getCheck());
  EXPECT_EQ(s.getSpacing(), 0.05);
  EXPECT_EQ(o.spacing, 0.05);
  EXPECT_EQ(s.getPlaneNoise(), 0.003);
  EXPECT_EQ(o.plane_noise, 0.003);
  Eigen::Vector3f min, max;
  s.getCropBox(min, max);
  EXPECT_EQ(min, Eigen::Vector3f(-1, -2, -3));
  EXPECT_EQ(max, Eigen::Vector3f(1, 2, 3));
  float x = 0, y = 0, z = 0;
  s.getViewPoint(x, y, z);
  EXPECT_EQ(Eigen::Vector3f(x, y, z), Eigen::Vector3f(1, 2, 3));
  s.unsetCropBox(), s.useSensorOriginAsViewPoint();
  EXPECT_FALSE(o.crop || o.viewpoint);
  s.getCropBox(min, max);
  EXPECT_TRUE(std::isinf(min[2]) && min[2] < 0 && std::isinf(max[0]) && max[0] > 0);
  const auto cloud = std::make_shared<::pcl::PointCloud<::pcl::PointXYZ>>();
  cloud->sensor_origin_[1] = 4;
  s.setInputCloud(cloud);
  s.getViewPoint(x, y, z);
  EXPECT_EQ(Eigen::Vector3f(x, y, z), Eigen::Vector3f(0, 4, 0));
  s.setMethod(ph::segment::Method::supervoxels);
  PersistenceSegmentation<::pcl::PointXYZ> fresh;
  EXPECT_EQ(fresh.getMinPersistence(), 1);
  fresh.setMethod(ph::segment::Method::supervoxels);
  EXPECT_EQ(fresh.getMinPersistence(), 0);
}

TEST(PclAdapter, WhatIsKnownOfTheSegments) {
  const TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  const auto cloud = cloud_of<::pcl::PointXYZRGB>(scene);
  cloud->header.frame_id = "camera";
  PersistenceSegmentation<::pcl::PointXYZRGB> s;
  s.setInputCloud(cloud);
  std::vector<::pcl::PointIndices> clusters;
  s.segment(clusters);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].header.frame_id, "camera");
  const auto confidences = s.getConfidences();
  EXPECT_EQ(confidences[1], s.getSegments()[1].persistence);
  EXPECT_GT(s.getTree().merge_tree.size(), 0);

  ::pcl::ModelCoefficients plane;
  s.getPlane(plane);
  ASSERT_EQ(plane.values.size(), 4U);
  EXPECT_EQ(plane.header.frame_id, "camera");
  EXPECT_NEAR(plane.values[3], std::sqrt(0.5), 1e-3);

  Eigen::Vector3f centre, size;
  Eigen::Matrix3f rotation;
  s.getOrientedBox(1, centre, rotation, size);
  EXPECT_NEAR(rotation.determinant(), 1, 1e-5);
  EXPECT_NEAR(rotation.col(2).dot(Eigen::Vector3f(plane.values.data())), 1, 1e-5);
  EXPECT_NEAR(size[0], 0.12, 0.01);
  EXPECT_THROW(s.getOrientedBox(2, centre, rotation, size), std::out_of_range);

  const auto coloured = s.getColoredCloud();
  ASSERT_EQ(coloured->size(), cloud->size());
  EXPECT_EQ(coloured->width, cloud->width);
  const auto colour_of = [&](std::size_t k) {
    return (*coloured)[static_cast<std::size_t>(clusters[k].indices[0])].rgba & 0xFFFFFF;
  };
  EXPECT_NE(colour_of(0), colour_of(1));

  s.cut(1000.0, clusters);  // no basin is that persistent
  EXPECT_EQ(clusters.size(), 1U);
  EXPECT_EQ(s.getSegments().size(), 1U);
  s.cut(s.getTree().first_cut, clusters);
  EXPECT_EQ(clusters.size(), 2U);
  EXPECT_THROW(s.cut(-1.0, clusters), ph::Error);
}

}  // namespace
}  // namespace ph::pcl
