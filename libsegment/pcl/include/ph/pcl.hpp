// SPDX-License-Identifier: MIT
#pragma once
#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "ph/error.hpp"
#include "ph/segment.hpp"

/// The functions and the class below accept clouds of the Point Cloud Library (PCL), and return
/// PCL's indices and labels. A cloud is read in place. If indices select some of its points, the
/// coordinates are copied instead. PCL's types occur only in this header.
namespace ph::pcl {

/// The coordinates x, y and z of all points. A point that is not in `indices` becomes a hole.
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
      throw Error(ErrorKind::bad_data, "found index " + std::to_string(i) + " in a cloud of " +
                                           std::to_string(cloud.size()) + " points");
    }
    take(static_cast<std::size_t>(i));
  }
  return xyz;
}

/// The sensor position that the cloud states.
template <class PointT>
segment::Vec3 viewpoint(const ::pcl::PointCloud<PointT>& cloud) {
  const auto& origin = cloud.sensor_origin_;
  return {double{origin[0]}, double{origin[1]}, double{origin[2]}};
}

/// The cloud in the form that the pipeline reads. The view has the rows and columns of the cloud if
/// width * height is the number of points; otherwise the view is unorganised.
/// @param xyz the result of `coordinates` for this cloud, which must outlive the view.
template <class PointT>
segment::CloudView cloud_view(const ::pcl::PointCloud<PointT>& cloud, std::span<const float> xyz) {
  segment::CloudView view{xyz, viewpoint(cloud)};
  if (cloud.width > 0 && std::size_t{cloud.width} * cloud.height == cloud.size()) {
    view.width = static_cast<Index>(cloud.width);
    view.height = static_cast<Index>(cloud.height);
  }
  return view;
}

/// The same view without a copy of the coordinates. The cloud must outlive the view. All point
/// types of PCL store x, y and z side by side. @throws Error (usage) if another type of points does
/// not.
template <class PointT>
segment::CloudView cloud_view(const ::pcl::PointCloud<PointT>& cloud) {
  static_assert(sizeof(PointT) % sizeof(float) == 0, "points lie at whole numbers of floats");
  if (cloud.empty()) return cloud_view(cloud, std::span<const float>());
  const PointT& first = cloud[0];
  if (&first.y != &first.x + 1 || &first.z != &first.x + 2)
    throw Error(ErrorKind::usage,
                "this type of point has no x, y, z side by side; copy the coordinates");
  constexpr std::size_t stride = sizeof(PointT) / sizeof(float);
  segment::CloudView view =
      cloud_view(cloud, std::span<const float>(&first.x, (cloud.size() - 1) * stride + 3));
  view.stride = stride;
  return view;
}

/// Calls ph::segment::segment for a PCL cloud, which is read in place.
template <class PointT>
segment::Segmentation segment_cloud(const ::pcl::PointCloud<PointT>& cloud,
                                    const segment::SegmentOptions& options = {},
                                    const RunContext& context = default_context()) {
  return segment::segment(cloud_view(cloud), options, context);
}

/// The points of each segment, by label, in the form that PCL's segmentations return.
inline std::vector<::pcl::PointIndices> point_indices(const segment::SceneCut& segmentation,
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

/// The points on each surface that bounds the scene, in the order of
/// ph::segment::SceneTree::surfaces.
inline std::vector<::pcl::PointIndices> surface_indices(const segment::Segmentation& segmentation,
                                                        const ::pcl::PCLHeader& header = {}) {
  std::vector<::pcl::PointIndices> surfaces(segmentation.tree.surfaces.size());
  for (::pcl::PointIndices& surface : surfaces) surface.header = header;
  for (std::size_t i = 0; i < segmentation.cut.surface_labels.size(); ++i) {
    const std::uint8_t number = segmentation.cut.surface_labels[i];
    if (number != 0) surfaces[number - 1U].indices.push_back(static_cast<::pcl::index_t>(i));
  }
  return surfaces;
}

/// Copies a cloud to another type of points, with the same order, rows and columns. Each point gets
/// its coordinates, and whatever `paint(i, point)` adds.
template <class To, class PointT, class Paint>
::pcl::PointCloud<To> converted(const ::pcl::PointCloud<PointT>& cloud,
                                const std::vector<std::uint32_t>& labels, Paint&& paint) {
  if (labels.size() != cloud.size()) {
    throw Error(ErrorKind::usage, "found " + std::to_string(labels.size()) + " labels, expected " +
                                      std::to_string(cloud.size()) + ", one per point");
  }
  ::pcl::PointCloud<To> result;
  result.header = cloud.header;
  result.width = cloud.width;
  result.height = cloud.height;
  result.is_dense = cloud.is_dense;
  result.sensor_origin_ = cloud.sensor_origin_;
  result.sensor_orientation_ = cloud.sensor_orientation_;
  result.points.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    To& p = result.points[i];
    p.x = cloud[i].x;
    p.y = cloud[i].y;
    p.z = cloud[i].z;
    paint(i, p);
  }
  return result;
}

/// The points with their labels.
template <class PointT>
::pcl::PointCloud<::pcl::PointXYZL> labelled_cloud(const ::pcl::PointCloud<PointT>& cloud,
                                                   const std::vector<std::uint32_t>& labels) {
  return converted<::pcl::PointXYZL>(
      cloud, labels, [&](std::size_t i, ::pcl::PointXYZL& p) { p.label = labels[i]; });
}

/// The points in the colours of their segments. Points without a segment are grey.
template <class PointT>
::pcl::PointCloud<::pcl::PointXYZRGB> coloured_cloud(const ::pcl::PointCloud<PointT>& cloud,
                                                     const segment::SceneCut& cut) {
  constexpr std::uint32_t grey = 0x606060;
  const std::vector<std::uint32_t> colours = segment::label_colours(cut);
  return converted<::pcl::PointXYZRGB>(
      cloud, cut.labels, [&](std::size_t i, ::pcl::PointXYZRGB& p) {
        const std::uint32_t colour = cut.labels[i] == 0 ? grey : colours[cut.labels[i] - 1];
        p.r = static_cast<std::uint8_t>(colour >> 16 & 0xFF);
        p.g = static_cast<std::uint8_t>(colour >> 8 & 0xFF);
        p.b = static_cast<std::uint8_t>(colour & 0xFF);
      });
}

/// The pipeline with the interface of PCL's segmentations: setInputCloud, setIndices, segment. All
/// lengths are in metres, and no option is an angle. The defaults are the defaults of
/// segment::SegmentOptions.
template <class PointT>
class PersistenceSegmentation : public ::pcl::PCLBase<PointT> {
 public:
  using Ptr = ::pcl::shared_ptr<PersistenceSegmentation<PointT>>;
  using ConstPtr = ::pcl::shared_ptr<const PersistenceSegmentation<PointT>>;
  using Method = segment::Method;

  /// Sets all options at once.
  void setOptions(const segment::SegmentOptions& options) { options_ = options; }
  const segment::SegmentOptions& getOptions() const { return options_; }

  /// The rule that decides which voxels belong together: surface (default), paper or supervoxels.
  void setMethod(Method method) { options_.method = method; }
  Method getMethod() const { return options_.method; }
  /// The largest distance from the viewpoint, in metres. Points farther away are left out. The
  /// distance may be infinite.
  void setMaxRange(double metres) { options_.max_range = metres; }
  double getMaxRange() const { return options_.max_range; }
  /// Only points inside this box are used.
  void setCropBox(const Eigen::Vector3f& min, const Eigen::Vector3f& max) {
    options_.crop = segment::Box{{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
  }
  void unsetCropBox() { options_.crop.reset(); }
  /// The default box is all of space, from -infinity to infinity.
  void getCropBox(Eigen::Vector3f& min, Eigen::Vector3f& max) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    min.setConstant(-infinity), max.setConstant(infinity);
    for (int k = 0; k < 3 && options_.crop; ++k) {
      min[k] = static_cast<float>(options_.crop->min[static_cast<std::size_t>(k)]);
      max[k] = static_cast<float>(options_.crop->max[static_cast<std::size_t>(k)]);
    }
  }
  /// If true, the supporting plane and everything behind it are removed.
  void setPlaneRemoval(bool remove) { options_.plane = remove; }
  bool getPlaneRemoval() const { return options_.plane; }
  /// The largest number of supports, the supporting plane included, at least 1.
  void setMostSupports(Index count) { options_.most_supports = count; }
  Index getMostSupports() const { return options_.most_supports; }
  /// Half the thickness of the plane, in metres.
  void setPlaneDistance(double metres) { options_.plane_distance = metres; }
  double getPlaneDistance() const { return options_.plane_margin(); }
  /// The least value for half the thickness of the plane at a range of one metre, in metres. This
  /// least value grows with the square of the range.
  void setPlaneNoise(double metres) { options_.plane_noise = metres; }
  double getPlaneNoise() const { return options_.plane_noise; }
  /// The supporting plane of the previous frame. unsetPlaneGuess removes it.
  void setPlaneGuess(const segment::Plane& plane) { options_.plane_guess = plane; }
  void unsetPlaneGuess() { options_.plane_guess.reset(); }
  const std::optional<segment::Plane>& getPlaneGuess() const { return options_.plane_guess; }
  /// The position of the sensor. The default is the point at which the rays of the pixels of an
  /// organised cloud meet. If this point cannot be determined, the default is the origin that the
  /// cloud states.
  void setViewPoint(float x, float y, float z) { options_.viewpoint = segment::Vec3{x, y, z}; }
  void useSensorOriginAsViewPoint() { options_.viewpoint.reset(); }
  /// The sensor position that was set with setViewPoint. If none was set, the position that the
  /// input cloud states.
  void getViewPoint(float& x, float& y, float& z) const {
    segment::Vec3 point{};
    if (this->input_) point = viewpoint(*this->input_);
    if (options_.viewpoint) point = *options_.viewpoint;
    x = static_cast<float>(point[0]), y = static_cast<float>(point[1]);
    z = static_cast<float>(point[2]);
  }
  /// The edge of a voxel, in metres.
  void setVoxelSize(double metres) { options_.voxel = metres; }
  double getVoxelSize() const { return options_.voxel_size(); }
  /// The fewest voxels of a segment.
  void setMinClusterSize(Index voxels) { options_.min_size = voxels; }
  Index getMinClusterSize() const { return options_.cut().min_size; }
  /// Methods surface and supervoxels: the least persistence of a part, in units of the noise
  /// (surface) or in metres (supervoxels).
  void setMinPersistence(double persistence) { options_.min_persistence = persistence; }
  double getMinPersistence() const { return options_.part_persistence(); }
  /// Method supervoxels: the largest distance from the surface to a seed, in metres.
  void setSpacing(double metres) { options_.spacing = metres; }
  double getSpacing() const { return options_.spacing; }
  /// Methods surface and supervoxels: the fewest voxels of a part.
  void setMinPartSize(Index voxels) { options_.min_part = voxels; }
  Index getMinPartSize() const { return options_.cut().min_part; }
  /// Method surface: true if the visible parts of an object are joined.
  void setObjects(bool join) { options_.objects = join; }
  bool getObjects() const { return options_.objects; }
  /// Method paper: the maximum distance of the Vietoris-Rips complex, in metres.
  void setDistance(double metres) { options_.distance = metres; }
  double getDistance() const { return options_.distance; }
  /// Method paper: the number of levels up to this distance, or 0 for exact deaths.
  void setSteps(int steps) { options_.steps = steps; }
  int getSteps() const { return options_.steps; }
  /// If true, the result of union-find is compared with the reduction of the boundary matrix.
  void setCheck(bool check) { options_.check = check; }
  bool getCheck() const { return options_.check; }

  /// The context that stops, monitors and limits calls of `segment` and `cut`. It must outlive
  /// these calls.
  void setRunContext(const RunContext& context) { context_ = &context; }

  /// Stores the points of each segment in `clusters`, the largest segment first. Without an input
  /// cloud, there are no segments. @throws ph::Error like ph::segment::segment.
  void segment(std::vector<::pcl::PointIndices>& clusters) {
    clusters.clear();
    result_ = segment::Segmentation();
    notes_.clear();
    if (!this->initCompute()) return;
    std::vector<float> chosen;  // points without an index are holes
    if (!this->fake_indices_) chosen = coordinates(*this->input_, this->indices_.get());
    const segment::CloudView cloud =
        this->fake_indices_ ? cloud_view(*this->input_) : cloud_view(*this->input_, chosen);
    result_ = ph::segment::segment(cloud, options_, *context_);
    for (const Message& note : segment::notes(result_, options_, cloud))
      notes_.push_back(note.str());
    clusters = point_indices(result_.cut, this->input_->header);
    this->deinitCompute();
  }
  /// Cuts the tree of the last call of `segment` more coarsely or more finely, within milliseconds.
  /// The getters below then describe this cut.
  /// @param value see segment::CutOptions. @throws ph::Error (usage) on a value out of its range.
  void cut(double value, std::vector<::pcl::PointIndices>& clusters) {
    segment::CutOptions options = result_.tree.first_cut;
    options.value = value;
    cut(options, clusters);
  }
  void cut(const segment::CutOptions& options, std::vector<::pcl::PointIndices>& clusters) {
    result_.cut = ph::segment::cut(result_.tree, options, *context_);
    clusters = point_indices(result_.cut, this->input_ ? this->input_->header : ::pcl::PCLHeader());
  }

  /// The entire result of the last call: the segments with boxes and neighbours, the tree, and
  /// times.
  const segment::Segmentation& result() const { return result_; }
  /// What to know before one trusts the result of the last call of `segment`: a missing plane, the
  /// reason for an empty result, implausible units, coordinates or viewpoints.
  const std::vector<std::string>& getNotes() const { return notes_; }
  const std::vector<segment::Segment>& getSegments() const { return result_.cut.segments; }
  /// The supports and walls, which are not segments. Segment::on names the support of a segment.
  const std::vector<segment::SceneSurface>& getSurfaces() const { return result_.tree.surfaces; }
  /// The points on each surface that getSurfaces returns.
  std::vector<::pcl::PointIndices> getSurfaceIndices() const {
    return surface_indices(result_, this->input_ ? this->input_->header : ::pcl::PCLHeader());
  }
  /// The merge tree, with the data that other cuts need.
  const segment::SceneTree& getTree() const { return result_.tree; }
  /// The persistence of each segment. It is infinite for a segment that touches no other segment.
  std::vector<double> getConfidences() const {
    std::vector<double> confidences;
    for (const segment::Segment& s : result_.cut.segments) confidences.push_back(s.persistence);
    return confidences;
  }
  /// The removed plane in the form of SACMODEL_PLANE: a x + b y + c z + d = 0. Empty if no plane
  /// was removed.
  void getPlane(::pcl::ModelCoefficients& coefficients) const {
    coefficients = ::pcl::ModelCoefficients();
    if (this->input_) coefficients.header = this->input_->header;
    if (!result_.tree.plane) return;
    for (const double n : result_.tree.plane->normal)
      coefficients.values.push_back(static_cast<float>(n));
    coefficients.values.push_back(static_cast<float>(result_.tree.plane->offset));
  }
  /// The box of a segment. The axes of the box are the columns of `rotation`. @param i the number
  /// of the segment, counted from 0.
  void getOrientedBox(std::size_t i, Eigen::Vector3f& centre, Eigen::Matrix3f& rotation,
                      Eigen::Vector3f& size) const {
    const segment::OrientedBox& box = result_.cut.segments.at(i).oriented_box;
    const auto vector = [](const segment::Vec3& v) -> Eigen::Vector3f {
      return Eigen::Vector3d(v[0], v[1], v[2]).cast<float>();
    };
    centre = vector(box.centre);
    size = vector(box.size);
    for (int k = 0; k < 3; ++k) rotation.col(k) = vector(box.axes[static_cast<std::size_t>(k)]);
  }
  /// The label of each point of the input cloud. Points outside the indices have the label 0. The
  /// result is empty without an input cloud.
  ::pcl::PointCloud<::pcl::PointXYZL> getLabeledCloud() const {
    if (!this->input_) return {};
    return labelled_cloud(*this->input_, result_.cut.labels);
  }
  /// The input cloud with segments in their colours and all other points in grey. The result is
  /// empty without an input cloud.
  typename ::pcl::PointCloud<::pcl::PointXYZRGB>::Ptr getColoredCloud() const {
    const auto coloured = ::pcl::make_shared<::pcl::PointCloud<::pcl::PointXYZRGB>>();
    if (this->input_) *coloured = coloured_cloud(*this->input_, result_.cut);
    return coloured;
  }

 private:
  const RunContext* context_ = &default_context();
  segment::SegmentOptions options_;
  segment::Segmentation result_;
  std::vector<std::string> notes_;
};

}  // namespace ph::pcl
