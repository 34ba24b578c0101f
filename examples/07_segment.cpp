// SPDX-License-Identifier: MIT
// Segments a table top: reads a cloud, and writes the same cloud with labels.
//
// 07_segment table.pcd labels.pcd
#include <iostream>
#include <ph/segment.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: 07_segment CLOUD.pcd|.ply LABELS.pcd|.ply\n";
    return 64;
  }
  const auto cloud = ph::segment::read_cloud(argv[1]);
  const ph::segment::SegmentOptions options{.voxel = 0.01};  // metres
  const auto parts = ph::segment::segment(cloud, options);
  for (const ph::Message& note : ph::segment::notes(parts, options, cloud))
    std::cerr << note.str() << "\n";  // why nothing was found, or what looks wrong
  for (const auto& segment : parts.cut.segments) {
    std::cout << "segment " << segment.label << ": " << segment.points << " points, "
              << segment.voxels << " voxels around (" << segment.centroid[0] << ", "
              << segment.centroid[1] << ", " << segment.centroid[2] << ")\n";
  }
  ph::segment::write_cloud(argv[2], cloud, parts.cut.labels);
}
