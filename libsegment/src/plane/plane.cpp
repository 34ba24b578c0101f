// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/plane.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "libsegment/src/plane/sample.hpp"

namespace ph::segment {
namespace {

constexpr std::size_t kScored = 1024;  // the number of points that score a hypothesis
// This number is enough to find a plane that contains a quarter of the points with a probability of
// 99.96 %.
constexpr int kHypotheses = 500;
constexpr int kRefits = 4;
// The search uses twice the thickness, because a plane through three noisy points is rarely exact
// to a millimetre.
constexpr double kOfSearch = 2;
// A share of the largest spread. Points that spread less across it lie on a line.
constexpr double kLeastSpread = 1e-9;
// Points behind a plane by more than this belong to another surface. The unit is a margin, or
// `margins` of them in a search.
constexpr double kFarBehind = 6;

struct Candidate {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0;
  double signed_distance(const Sample& sample, std::size_t i) const {
    return normal.x() * sample.x[i] + normal.y() * sample.y[i] + normal.z() * sample.z[i] + offset;
  }
};

/// The plane whose normal points to the side of a viewpoint.
Candidate facing(const Candidate& plane, const Eigen::Vector3d& viewpoint) {
  if (plane.normal.dot(viewpoint) + plane.offset >= 0) return plane;
  return {-plane.normal, -plane.offset};
}

/// The cost of a plane for the first `count` points, where distances are in units of `margins`
/// margins. The cost of a point is the square of its distance, capped at one (the score of MSAC).
/// A point just behind the plane costs two: a support is solid, so nothing is seen there. A low
/// cost is good. A cost of `enough` or more is only a lower bound, because the summation then
/// stops. @param plane its normal points towards the sensor.
double cost_of(const Candidate& plane, const Sample& sample, std::size_t count, double margins,
               double enough) {
  double cost = 0;
  constexpr std::size_t block = 128;
  for (std::size_t begin = 0; begin < count && cost < enough; begin += block) {
    for (std::size_t i = begin; i < std::min(count, begin + block); ++i) {
      const double r = plane.signed_distance(sample, i) / (margins * sample.limits[i]);
      cost += std::min(r * r, 1.0) + (r < -1 && r > -kFarBehind ? 1.0 : 0.0);
    }
  }
  return cost;
}

/// The best of kHypotheses planes through three points of the sample. Empty if all points are
/// collinear.
std::optional<Candidate> best_hypothesis(const Sample& sample, double margins,
                                         const Eigen::Vector3d& viewpoint) {
  const std::size_t scored = std::min(sample.size(), kScored);
  std::uint64_t state = 0;  // a fixed seed gives the same plane for the same input
  const auto any = [&] {
    state += 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(mix(state) % sample.size());
  };
  std::optional<Candidate> best;
  double best_cost = kInfinity;
  for (int k = 0; k < kHypotheses; ++k) {
    const std::size_t i = any();
    const Eigen::Vector3d a = sample[i], b = sample[any()], c = sample[any()];
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double area = normal.norm();
    // A triangle that is thinner than the plane is left out, because its normal would be noise.
    const double thickness = margins * sample.limits[i];
    if (!(area > thickness * (b - a).norm()) || !(area > thickness * (c - a).norm())) continue;
    const Candidate plane = facing({normal / area, -normal.dot(a) / area}, viewpoint);
    const double cost = cost_of(plane, sample, scored, margins, best_cost);
    if (cost < best_cost) {
      best_cost = cost;
      best = plane;
    }
  }
  return best;
}

/// The best of the planes with a given normal, one through each of some points of the sample. Empty
/// if the viewpoint is in front of none of them.
std::optional<Candidate> best_parallel(const Sample& sample, double margins,
                                       const Eigen::Vector3d& normal,
                                       const Eigen::Vector3d& viewpoint) {
  // This number is enough to find a plane that contains 3 % of the points with a probability of
  // 98 %.
  constexpr std::size_t most = 128;
  const std::size_t scored = std::min(sample.size(), kScored);
  std::optional<Candidate> best;
  double best_cost = kInfinity;
  for (std::size_t i = 0; i < std::min(scored, most); ++i) {
    const Candidate plane{normal, -normal.dot(sample[i])};
    if (!(normal.dot(viewpoint) + plane.offset > 0)) continue;
    const double cost = cost_of(plane, sample, scored, margins, best_cost);
    if (cost < best_cost) {
      best_cost = cost;
      best = plane;
    }
  }
  return best;
}

/// The least-squares plane of the points within `margins` margins of a plane. Empty if these points
/// are collinear. The sum is repeatable, because it follows the order of the sample.
std::optional<Candidate> refit(const Candidate& plane, const Sample& sample, double margins) {
  std::vector<std::size_t> inliers;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (std::abs(plane.signed_distance(sample, i)) > margins * sample.limits[i]) continue;
    inliers.push_back(i);
    mean += sample[i];
  }
  if (inliers.size() < 3) return std::nullopt;
  mean /= static_cast<double>(inliers.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t i : inliers) {
    const Eigen::Vector3d r = sample[i] - mean;
    scatter += r * r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d& spread = solver.eigenvalues();
  if (!(spread[1] > kLeastSpread * spread[2])) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return Candidate{normal, -normal.dot(mean)};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double share_of(const Candidate& plane, const Sample& sample) {
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < sample.size(); ++i)
    inliers += std::abs(plane.signed_distance(sample, i)) <= sample.limits[i] ? 1U : 0U;
  return static_cast<double>(inliers) / static_cast<double>(sample.size());
}

/// The plane of the previous frame. Empty if there is no such plane, or if it has lost more than a
/// small share of its points.
std::optional<Candidate> as_good_as_before(const std::optional<Plane>& guess,
                                           const Sample& sample) {
  constexpr double most_lost = 0.1;
  if (!guess) return std::nullopt;
  const Candidate plane{Eigen::Vector3d(guess->normal.data()), guess->offset};
  return share_of(plane, sample) >= (1 - most_lost) * guess->share ? std::optional(plane)
                                                                   : std::nullopt;
}

/// Computes PlaneSearch::noise and PlaneSearch::noise_along.
void measure_noise(const Candidate& plane, const Sample& sample, const Eigen::Vector3d& viewpoint,
                   PlaneSearch& search) {
  constexpr std::size_t fewest = 30;
  constexpr double median_of_half_normal = 0.6745;  // in standard deviations
  const double height = plane.normal.dot(viewpoint) + plane.offset;
  std::vector<double> across, along;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double depth = -plane.signed_distance(sample, i);
    if (!(depth > 0 && depth < kFarBehind * sample.limits[i])) continue;
    const double range = (sample[i] - viewpoint).norm();
    across.push_back(depth / (range * range));
    along.push_back(depth / (range * height));
  }
  if (across.size() < fewest) return;
  search.noise = median(std::move(across)) / median_of_half_normal;
  search.noise_along = median(std::move(along)) / median_of_half_normal;
}

/// The plane that a hypothesis becomes by refits.
PlaneSearch search_from(Candidate found, const Sample& sample, const Eigen::Vector3d& viewpoint,
                        double least_share) {
  for (int i = 0; i < kRefits; ++i)
    if (const auto better = refit(found, sample, i == 0 ? kOfSearch : 1)) found = *better;
  const double share = share_of(found, sample);
  if (share < least_share) {
    return {
        std::nullopt,
        fmt::format("no plane: the largest candidate holds {:.1f} % of the points in range, less "
                    "than {:.0f} %",
                    100 * share, 100 * least_share)};
  }
  const Candidate plane = facing(found, viewpoint);
  const Eigen::Vector3d& n = plane.normal;
  PlaneSearch search{Plane{{n.x(), n.y(), n.z()}, plane.offset, share}, ""};
  measure_noise(plane, sample, viewpoint, search);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < sample.size(); ++i)
    if (std::abs(plane.signed_distance(sample, i)) <= sample.limits[i])
      ranges.push_back((sample[i] - viewpoint).norm());
  if (!ranges.empty()) search.range = median(std::move(ranges));
  return search;
}

}  // namespace

PlaneSearch find_plane(const CloudView& cloud, const std::vector<Index>& points,
                       const PlaneMargin& margin, const std::optional<Plane>& guess) {
  if (points.size() < 3) return {std::nullopt, std::string(kTooFewPoints)};
  return find_plane(draw_sample(cloud, points, margin), cloud.viewpoint, guess);
}

PlaneSearch find_plane(const Sample& sample, const Vec3& viewpoint,
                       const std::optional<Plane>& guess) {
  const Eigen::Vector3d eye(viewpoint.data());
  std::optional<Candidate> found = as_good_as_before(guess, sample);
  if (!found && !(sample.size() < 3)) found = best_hypothesis(sample, kOfSearch, eye);
  if (!found) return {std::nullopt, "no plane: the points in range lie on a line or at one point"};
  return search_from(*found, sample, eye, kLeastShareOfSupport);
}

PlaneSearch find_parallel(const Plane& like, const Sample& sample, const Vec3& viewpoint) {
  const Eigen::Vector3d eye(viewpoint.data());
  const auto found = best_parallel(sample, kOfSearch, Eigen::Vector3d(like.normal.data()), eye);
  return found ? search_from(*found, sample, eye, 0) : PlaneSearch{};
}

Cleared remove_plane(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                     const PlaneMargin& margin) {
  Cleared cleared;
  cleared.on.reserve(points.size());  // only the memory that is written is touched
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    const double height = plane.signed_distance(p[0], p[1], p[2]);
    const double limit = margin(cloud, p);
    if (height > limit) {
      cleared.beyond.push_back(i);
    } else if (height >= -limit) {
      cleared.on.push_back(i);
      if (height > 0) cleared.strip.push_back(i);
    }
  }
  return cleared;
}

double share_behind(const CloudView& cloud, const Plane& plane, const PlaneMargin& margin) {
  // This many samples are enough to show a share of one in a hundred.
  constexpr std::size_t many = 40000;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / many);
  std::size_t all = 0, behind = 0;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    const float* p = cloud.point(i);
    const double limit = margin(cloud, p), height = plane.signed_distance(p[0], p[1], p[2]);
    all += std::isfinite(height) ? 1U : 0U;
    behind += height < -limit ? 1U : 0U;  // the comparison is false for a hole
  }
  return all == 0 ? 0 : static_cast<double>(behind) / static_cast<double>(all);
}

bool bounds_the_view(const Plane& plane, const CloudView& cloud) {
  return share_behind(cloud, plane, kOfWalls) <= kMostBehind;
}

std::optional<Role> role_of_bound(const Plane& plane, const Plane& support,
                                  const CloudView& cloud) {
  const bool faces_down = cosine_between(plane, support) < -kLeastOfParallel;
  if ((!faces_down && !is_steep(plane, support)) || !bounds_the_view(plane, cloud))
    return std::nullopt;
  return faces_down ? Role::ceiling : Role::wall;
}

bool is_steep(const Plane& plane, const Plane& support) {
  constexpr double largest_cosine = 0.5;
  return std::abs(cosine_between(plane, support)) < largest_cosine;
}

double cosine_between(const Plane& a, const Plane& b) {
  return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
}

}  // namespace ph::segment
