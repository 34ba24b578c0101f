// SPDX-License-Identifier: MIT
// Continues with PCL after a segmentation: computes the normals of each object, its flat top, and
// the place where a suction cup would hold it.
//
// 15_pcl_features stack.pcd
#include <pcl/common/centroid.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <ph/pcl.hpp>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// Any cloud of points with x, y and z can be used. This example reads it with libph's strict
/// reader.
Cloud::Ptr read(const char* path) {
  const ph::Cloud file = ph::segment::read_cloud(path);
  const std::vector<float> xyz = file.xyz();
  const auto cloud = pcl::make_shared<Cloud>(static_cast<std::uint32_t>(file.width),
                                             static_cast<std::uint32_t>(file.height));
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  cloud->is_dense = false;  // points are NaN where the sensor saw nothing
  return cloud;
}

/// The points of an object whose normals are within 20 degrees of `up`.
pcl::PointIndices facing_up(const Cloud::ConstPtr& cloud, const pcl::PointIndices& object,
                            const Eigen::Vector3f& up, const Eigen::Vector3f& viewpoint) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(pcl::make_shared<pcl::PointIndices>(object));
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setRadiusSearch(0.015);  // metres
  estimation.setViewPoint(viewpoint[0], viewpoint[1], viewpoint[2]);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  pcl::PointIndices result;
  result.header = object.header;
  const float least = std::cos(20.0F * 3.14159265F / 180);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (normals[i].getNormalVector3fMap().dot(up) > least)
      result.indices.push_back(object.indices[i]);
  return result;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 15_pcl_features CLOUD\n";
    return 64;
  }
  const Cloud::Ptr cloud = read(argv[1]);
  ph::pcl::PersistenceSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PointIndices> objects;
  segmentation.segment(objects);

  pcl::ModelCoefficients plane;
  segmentation.getPlane(plane);
  if (plane.values.empty()) {
    std::cerr << "no plane, so nobody knows what is above\n";
    return 1;
  }
  const Eigen::Vector3f up(plane.values[0], plane.values[1], plane.values[2]);
  Eigen::Vector3f viewpoint;
  segmentation.getViewPoint(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::cout << std::fixed << std::setprecision(3);  // metres
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const pcl::PointIndices top = facing_up(cloud, objects[i], up, viewpoint);
    std::cout << "object " << i + 1 << ": " << top.indices.size() << " of "
              << objects[i].indices.size() << " points face up";
    Eigen::Vector4f middle;
    if (pcl::compute3DCentroid(*cloud, top, middle) > 0) {
      std::cout << "; a suction cup at " << middle[0] << " " << middle[1] << " " << middle[2]
                << " is " << up.dot(middle.head<3>()) + plane.values[3] << " m above the plane";
    }
    std::cout << "\n";
  }
}
