// SPDX-License-Identifier: MIT
#pragma once
#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>
#include <vector>

#include "ph/core/error.hpp"
#include "ph/segment.hpp"

/// Clouds of the Point Cloud Library in, its indices and labels out. Data are copied: PCL's types
/// stay here.
namespace ph::pcl {

/// The x, y, z of all points, a hole for each that is not in `indices`.
/// @throws Error (bad_data) on an index beyond the cloud.
template <class PointT>
std::vector<float> coordinates(const ::pcl::PointCloud<PointT>& cloud,
                               const ::pcl::Indices* indices = nullptr) {
  std::vector<float> xyz(3 * cloud.size(), std::numeric_limits<float>::quiet_NaN());
  const auto take = [&](std::size_t i) {
    const PointT& p = cloud[i];
    xyz[3 * i] = p.x;
    xyz[3 * i + 1] = p.y;
    xyz[3 * i + 2] = p.z;
  };
  if (!indices) {
    for (std::size_t i = 0; i < cloud.size(); ++i) take(i);
    return xyz;
  }
  for (const auto i : *indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= cloud.size()) {
      throw Error(ErrorKind::bad_data, "index " + std::to_string(i) + " of a cloud of " +
                                           std::to_string(cloud.size()) + " points");
    }
    take(static_cast<std::size_t>(i));
  }
  return xyz;
}

/// Where the cloud says that its sensor stood.
template <class PointT>
segment::Vec3 viewpoint(const ::pcl::PointCloud<PointT>& cloud) {
  const auto& origin = cloud.sensor_origin_;
  return {double{origin[0]}, double{origin[1]}, double{origin[2]}};
}

/// ph::segment::segment on a PCL cloud.
template <class PointT>
segment::Segmentation segment_cloud(const ::pcl::PointCloud<PointT>& cloud,
                                    const segment::SegmentOptions& options = {},
                                    const RunContext& context = default_context()) {
  const std::vector<float> xyz = coordinates(cloud);
  return segment::segment(segment::CloudView{xyz, viewpoint(cloud)}, options, context);
}

/// The points of each segment, by label, as PCL's segmentations give them.
inline std::vector<::pcl::PointIndices> point_indices(const segment::Segmentation& segmentation,
                                                      const ::pcl::PCLHeader& header = {}) {
  std::vector<::pcl::PointIndices> clusters(segmentation.segments.size());
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    clusters[k].header = header;
    clusters[k].indices.reserve(static_cast<std::size_t>(segmentation.segments[k].points));
  }
  for (std::size_t i = 0; i < segmentation.labels.size(); ++i) {
    const std::uint32_t label = segmentation.labels[i];
    if (label != 0) clusters[label - 1].indices.push_back(static_cast<::pcl::index_t>(i));
  }
  return clusters;
}

/// The same points in the same order and organisation with their labels.
template <class PointT>
::pcl::PointCloud<::pcl::PointXYZL> labelled_cloud(const ::pcl::PointCloud<PointT>& cloud,
                                                   const std::vector<std::uint32_t>& labels) {
  if (labels.size() != cloud.size()) {
    throw Error(ErrorKind::usage, "found " + std::to_string(labels.size()) + " labels, expected " +
                                      std::to_string(cloud.size()) + ", one a point");
  }
  ::pcl::PointCloud<::pcl::PointXYZL> result;
  result.header = cloud.header;
  result.width = cloud.width;
  result.height = cloud.height;
  result.is_dense = cloud.is_dense;
  result.sensor_origin_ = cloud.sensor_origin_;
  result.sensor_orientation_ = cloud.sensor_orientation_;
  result.points.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ::pcl::PointXYZL& p = result.points[i];
    p.x = cloud[i].x;
    p.y = cloud[i].y;
    p.z = cloud[i].z;
    p.label = labels[i];
  }
  return result;
}

/// The pipeline with the manners of PCL's segmentations: setInputCloud, setIndices, segment.
template <class PointT>
class PersistenceSegmentation : public ::pcl::PCLBase<PointT> {
 public:
  /// Lengths in metres; see ph/segment.hpp.
  void setOptions(const segment::SegmentOptions& options) { options_ = options; }
  const segment::SegmentOptions& getOptions() const { return options_; }

  /// The points of each segment, largest first. Without an input cloud there are none.
  /// @throws ph::Error as ph::segment::segment does.
  void segment(std::vector<::pcl::PointIndices>& clusters) {
    clusters.clear();
    result_ = segment::Segmentation();
    if (!this->initCompute()) return;
    const std::vector<float> xyz = coordinates(*this->input_, this->indices_.get());
    result_ = ph::segment::segment(segment::CloudView{xyz, viewpoint(*this->input_)}, options_);
    clusters = point_indices(result_, this->input_->header);
    this->deinitCompute();
  }
  /// Everything the last call of `segment` found: persistence, boxes, the merge tree, times.
  const segment::Segmentation& result() const { return result_; }
  /// The label of each point of the input cloud; 0 for points outside the indices.
  ::pcl::PointCloud<::pcl::PointXYZL> getLabeledCloud() const {
    return labelled_cloud(*this->input_, result_.labels);
  }

 private:
  segment::SegmentOptions options_;
  segment::Segmentation result_;
};

}  // namespace ph::pcl
