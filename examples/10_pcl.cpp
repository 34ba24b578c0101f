// SPDX-License-Identifier: MIT
// Segments a table top with the manners of the Point Cloud Library.
//   10_pcl table.pcd
#include <iostream>
#include <ph/pcl.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 10_pcl CLOUD\n";
    return 64;
  }
  // Any cloud of points with x, y, z will do; the strict reader is ours.
  const std::vector<float> xyz = ph::segment::read_cloud(argv[1]).xyz();
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (std::size_t i = 0; i < xyz.size(); i += 3)
    cloud->emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);

  ph::pcl::PersistenceSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setVoxelSize(0.01);  // metres
  std::vector<pcl::PointIndices> clusters;
  segmentation.segment(clusters);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Eigen::Vector3f centre, size;
    Eigen::Matrix3f axes;
    segmentation.getOrientedBox(i, centre, axes, size);
    std::cout << clusters[i].indices.size() << " points, persistence "
              << segmentation.getConfidences()[i] << ", box of " << size.transpose() << " m around "
              << centre.transpose() << "\n";
  }
  segmentation.cut(0.1, clusters);  // a coarser cut of the same tree: nothing is computed anew
  std::cout << clusters.size() << " segments when cut at 0.1\n";
}
