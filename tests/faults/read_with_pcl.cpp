// SPDX-License-Identifier: MIT
// read_with_pcl FILE.pcd|FILE.ply: reads a cloud as PCL's users do and prints its number of points.
// Exits with 1 if PCL reports an error. compare_peers.py calls this program.
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <iostream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  const std::string path = argv[1];
  pcl::PointCloud<pcl::PointXYZ> cloud;
  const int code = path.ends_with(".ply") ? pcl::io::loadPLYFile(path, cloud)
                                          : pcl::io::loadPCDFile(path, cloud);
  if (code < 0) return 1;
  double sum = 0;  // reads every point, as any user of the cloud would
  for (const pcl::PointXYZ& point : cloud) sum += point.x + point.y + point.z;
  std::cerr << "sum of the coordinates " << sum << "\n";
  std::cout << cloud.size() << "\n";
}
