// SPDX-License-Identifier: MIT
// Segments a box that stands on a box. The interface has the style of the Point Cloud Library.
//
// 10_pcl stack.pcd
#include <iostream>
#include <ph/pcl.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 10_pcl CLOUD\n";
    return 64;
  }
  // Any cloud of points with x, y and z can be used. This example reads it with libph's strict
  // reader.
  const ph::Cloud file = ph::segment::read_cloud(argv[1]);
  const std::vector<float> xyz = file.xyz();
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(
      static_cast<std::uint32_t>(file.width), static_cast<std::uint32_t>(file.height));
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  cloud->is_dense = false;  // points are NaN where the sensor saw nothing

  ph::pcl::PersistenceSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setMaxRange(1.5);  // metres
  std::vector<pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  for (const std::string& note : segmentation.getNotes()) std::cerr << note << "\n";
  const ph::segment::SceneTree& tree = segmentation.getTree();
  std::cout << clusters.size() << " segments of " << tree.width << " x " << tree.height
            << " points\n";
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Eigen::Vector3f centre, size;
    Eigen::Matrix3f axes;
    segmentation.getOrientedBox(i, centre, axes, size);
    std::cout << clusters[i].indices.size() << " points, persistence "
              << segmentation.getConfidences()[i] << ", box of " << size.transpose() << " m around "
              << centre.transpose() << "\n";
  }
  // Computes a coarser cut of the same tree. The plane, the voxels and the normals are not computed
  // again.
  segmentation.cut(200, clusters);
  std::cout << clusters.size() << " segments when cut at 200\n";
}
