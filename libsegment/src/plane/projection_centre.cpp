// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/projection_centre.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ph::segment {
namespace {

constexpr double kSample = 4096;      // the number of points that are used
constexpr std::size_t kFewest = 100;  // with fewer points, the result is empty
constexpr double kNear = 0.1;         // a share of the range; closer places count as the same
// The share of the range within which two halves of the points agree.
constexpr double kSure = 0.05;
// In pixels; the error of a pinhole camera is below this.
constexpr double kGoodPixels = 0.5;
// A viewpoint that explains the pixels so much worse is wrong.
constexpr double kTimesWorse = 5;
constexpr double kOutlierPixels = 3;  // a pixel with a larger error shows something else
// The first projection is less exact than the next ones. Its outliers are this many times
// farther away.
constexpr double kFirstLimit = 3;
constexpr double kFewestInliers = 0.75;  // a share of all sightings
// The distance is in units of the points' spread. Rays that meet farther away than this count as
// parallel.
constexpr double kFar = 20;

/// A pixel and the point that it shows. All numbers are normalised, so that over all sightings the
/// mean is 0 and the mean square is 1.
struct Sighting {
  Eigen::Vector3d point;
  Eigen::Vector2d pixel;
};
using Sightings = std::vector<Sighting>;

/// The shift and the scales of this normalisation.
struct Frame {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double spread = 0;  // spread of the points, in the unit of the cloud
  double pixels = 0;  // pixels per unit of Sighting::pixel
};

/// The sums for fitting a projection by least squares. They are sums of the products v vᵀ of
/// vectors of N numbers. Some are plain sums, and others are weighted by the terms that a pixel
/// adds to the equations.
template <int N>
struct Equations {
  using Square = Eigen::Matrix<double, N, N>;
  Square one = Square::Zero(), u = Square::Zero(), v = Square::Zero(), squares = Square::Zero();

  void add(const Eigen::Matrix<double, N, 1>& seen, const Eigen::Vector2d& pixel) {
    const Square product = seen * seen.transpose();
    one += product;
    u += pixel.x() * product;
    v += pixel.y() * product;
    squares += pixel.squaredNorm() * product;
  }
  /// The matrix that maps each vector to its pixel (up to a factor), by least squares.
  Eigen::Matrix<double, 3, N> solved() const {
    Eigen::Matrix<double, 3 * N, 3 * N> all;
    const Square zero = Square::Zero();
    all << one, zero, -u, zero, one, -v, -u, -v, squares;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 3 * N, 3 * N>> solver(all);
    const auto least = solver.eigenvectors().col(0);
    Eigen::Matrix<double, 3, N> matrix;
    for (int row = 0; row < 3; ++row)
      matrix.row(row) = least.template segment<N>(row * N).transpose();
    return matrix;
  }
};

/// The homogeneous coordinates x, y, z, 1 of a point.
Eigen::Vector4d place_of(const Sighting& s) { return s.point.homogeneous(); }

/// Fits the projection matrix to the sightings. `seen_by(sighting)` returns the vector that
/// represents the point.
template <int N, class SeenBy>
Eigen::Matrix<double, 3, N> fit(const Sightings& sightings, SeenBy&& seen_by, std::size_t first = 0,
                                std::size_t step = 1) {
  Equations<N> equations;
  for (std::size_t i = first; i < sightings.size(); i += step)
    equations.add(seen_by(sightings[i]), sightings[i].pixel);
  return equations.solved();
}

/// The error of each pixel, in units of Sighting::pixel. It is infinite for a point whose image is
/// at infinity.
template <int N, class SeenBy>
std::vector<double> errors_of(const Eigen::Matrix<double, 3, N>& matrix, const Sightings& sightings,
                              SeenBy&& seen_by, std::size_t step = 1) {
  std::vector<double> errors;
  errors.reserve(sightings.size() / step + 1);
  for (std::size_t i = 0; i < sightings.size(); i += step) {
    const Eigen::Vector3d image = matrix * seen_by(sightings[i]);
    const double error = (image.template head<2>() / image.z() - sightings[i].pixel).norm();
    errors.push_back(std::isfinite(error) ? error : kInfinity);
  }
  return errors;
}

/// The root of the mean square, with each error capped at `limit`.
double root_mean_square(const std::vector<double>& errors, double limit) {
  double sum = 0;
  for (const double e : errors) sum += std::min(e, limit) * std::min(e, limit);
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The sightings of points on a raster of pixels. Empty if there are too few points.
Sightings sightings_of(const CloudView& cloud, Frame& frame) {
  const Index columns = cloud.columns(), rows = cloud.rows();
  const auto step = std::max<Index>(
      1, static_cast<Index>(std::sqrt(static_cast<double>(columns * rows) / kSample)));
  Sightings sightings;
  Eigen::Vector2d middle_pixel = Eigen::Vector2d::Zero();
  for (Index row = step / 2; row < rows; row += step) {
    for (Index column = step / 2; column < columns; column += step) {
      const float* p = cloud.point(static_cast<std::size_t>(row * columns + column));
      const Sighting s{{p[0], p[1], p[2]}, {static_cast<double>(column), static_cast<double>(row)}};
      if (!s.point.allFinite()) continue;
      frame.middle += s.point;
      middle_pixel += s.pixel;
      sightings.push_back(s);
    }
  }
  if (sightings.size() < kFewest) return {};
  const auto count = static_cast<double>(sightings.size());
  frame.middle /= count;
  middle_pixel /= count;
  double of_points = 0, of_pixels = 0;
  for (const Sighting& s : sightings) {
    of_points += (s.point - frame.middle).squaredNorm();
    of_pixels += (s.pixel - middle_pixel).squaredNorm();
  }
  frame.spread = std::sqrt(of_points / count);
  frame.pixels = std::sqrt(of_pixels / count);
  if (!(frame.spread > 0 && frame.pixels > 0)) return {};
  for (Sighting& s : sightings) {
    s.point = (s.point - frame.middle) / frame.spread;
    s.pixel = (s.pixel - middle_pixel) / frame.pixels;
  }
  return sightings;
}

using Projection = Eigen::Matrix<double, 3, 4>;

/// The projection with the least median of errors, among projections that are each fitted to a few
/// points.
Projection robust_fit(const Sightings& sightings) {
  // If a sixth of the points are outliers, one in nine draws of 12 points has no outlier.
  constexpr int hypotheses = 60, points = 12;
  constexpr std::size_t scored = 1024;  // the number of sightings that score a projection
  const std::size_t step = std::max<std::size_t>(1, sightings.size() / scored);
  std::minstd_rand random;  // this gives the same numbers in each run
  Projection best = Projection::Zero();
  double least = kInfinity;
  for (int i = 0; i < hypotheses; ++i) {
    Equations<4> equations;
    for (int k = 0; k < points; ++k) {
      const Sighting& s = sightings[random() % sightings.size()];
      equations.add(place_of(s), s.pixel);
    }
    const Projection projection = equations.solved();
    const double error = median(errors_of(projection, sightings, place_of, step));
    if (error >= least) continue;
    least = error;
    best = projection;
  }
  return best;
}

/// The sightings that a projection explains to within `limit`.
Sightings inliers_of(const Projection& projection, const Sightings& sightings, double limit) {
  const std::vector<double> errors = errors_of(projection, sightings, place_of);
  Sightings inliers;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    if (errors[i] <= limit) inliers.push_back(sightings[i]);
  return inliers;
}

Eigen::Vector3d centre_of(const Projection& projection) {
  return -projection.leftCols<3>().fullPivLu().solve(projection.col(3));
}

/// True if all points, except a few, are on the same side of the camera.
bool sees_forward(const Projection& projection, const Sightings& sightings) {
  constexpr double few = 0.05;
  const auto before = static_cast<double>(std::ranges::count_if(
      sightings, [&](const Sighting& s) { return projection.row(2).dot(place_of(s)) > 0; }));
  const double share = before / static_cast<double>(sightings.size());
  return share <= few || share >= 1 - few;
}

/// The median distance of the points from a place.
double median_range(const Sightings& sightings, const Eigen::Vector3d& from) {
  std::vector<double> ranges;
  for (const Sighting& s : sightings) ranges.push_back((s.point - from).norm());
  return median(std::move(ranges));
}

}  // namespace

std::optional<Vec3> centre_elsewhere(const CloudView& cloud) {
  if (cloud.rows() < 2 || cloud.columns() < 2) return std::nullopt;
  Frame frame;
  Sightings sightings = sightings_of(cloud, frame);
  if (sightings.empty()) return std::nullopt;
  const double good = kGoodPixels / frame.pixels, outlier = kOutlierPixels / frame.pixels;
  const auto& [vx, vy, vz] = cloud.viewpoint;
  const Eigen::Vector3d viewpoint = (Eigen::Vector3d(vx, vy, vz) - frame.middle) / frame.spread;
  // Seen from the viewpoint, the projection is a homography of the directions of the points.
  const auto direction = [&viewpoint](const Sighting& s) -> Eigen::Vector3d {
    return (s.point - viewpoint).normalized();
  };
  std::erase_if(sightings, [&](const Sighting& s) { return s.point == viewpoint; });
  if (sightings.size() < kFewest) return std::nullopt;
  const auto error_of_viewpoint = [&] {
    return root_mean_square(errors_of(fit<3>(sightings, direction), sightings, direction), 1);
  };
  if (error_of_viewpoint() < good) return std::nullopt;  // this is nearly always true

  const std::size_t all = sightings.size();
  Projection projection = fit<4>(sightings, place_of);
  if (root_mean_square(errors_of(projection, sightings, place_of), 1) > good) {
    projection = robust_fit(sightings);
    // mutant: viewpoint-outliers
    for (const double limit : {kFirstLimit * outlier, outlier, outlier}) {
      sightings = inliers_of(projection, sightings, limit);
      if (static_cast<double>(sightings.size()) < kFewestInliers * static_cast<double>(all))
        return std::nullopt;
      projection = fit<4>(sightings, place_of);
    }
  }
  const double error = root_mean_square(errors_of(projection, sightings, place_of), 1);
  // mutant: viewpoint-bent
  if (error > good || error_of_viewpoint() < std::max(good, kTimesWorse * error) ||
      !sees_forward(projection, sightings))
    return std::nullopt;

  const Eigen::Vector3d centre = centre_of(projection);
  if (!(centre.norm() < kFar)) return std::nullopt;
  const double range = median_range(sightings, centre);
  const auto half = [&](std::size_t first) {
    return centre_of(fit<4>(sightings, place_of, first, 2));
  };
  if (!((half(0) - half(1)).norm() < kSure * range) || (centre - viewpoint).norm() < kNear * range)
    return std::nullopt;
  const Eigen::Vector3d place = frame.middle + frame.spread * centre;
  return Vec3{place.x(), place.y(), place.z()};
}

}  // namespace ph::segment
