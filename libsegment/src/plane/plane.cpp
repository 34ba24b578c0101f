// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/plane.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace ph::segment {
namespace {

constexpr std::size_t kSample = 4096;  // the number of points that take part in the refits
constexpr std::size_t kScored = 1024;  // the number of points that score a hypothesis
// This number is enough to find a plane that contains a quarter of the points with a probability of
// 99.96 %.
constexpr int kHypotheses = 500;
constexpr int kRefits = 4;
// A plane with a smaller share of the points supports nothing.
constexpr double kSmallestShare = 0.1;

/// Mixes the bits of a word by the finaliser of splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// A hash of the sign and the mantissa of each coordinate. Scaling by 2^k does not change it. The
/// upper half of the hash is strongly universal (multiply-shift of vectors; M. Thorup, High speed
/// hashing for integers and strings, 2015).
std::uint64_t hash_of(const float* p) {
  const auto word = [](float x) -> std::uint64_t {
    constexpr std::uint32_t no_exponent = 0x807fffffU;
    return std::bit_cast<std::uint32_t>(x + 0.0F) & no_exponent;
  };
  return word(p[0]) * 0x9e3779b97f4a7c15ULL + word(p[1]) * 0xbf58476d1ce4e5b9ULL +
         word(p[2]) * 0x94d049bb133111ebULL + 0xd6e8feb86659fd93ULL;
}

/// Some of the points, with an array for each coordinate, so that the compiler can vectorise over
/// them.
struct Sample {
  std::vector<double> x, y, z;
  std::size_t size() const { return x.size(); }
  Eigen::Vector3d operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// The kSample distinct points with the smallest hashes, in the order of their hashes. If there are
/// fewer points, all points are taken. This is a random sample in random order that depends only on
/// the set of points.
Sample draw_sample(const CloudView& cloud, const std::vector<Index>& points) {
  struct Drawn {
    std::uint64_t hash;
    float x, y, z;
    auto key() const { return std::tie(hash, x, y, z); }
  };
  std::vector<Drawn> drawn;
  const double wanted = 1.25 * kSample;
  for (double share = wanted / static_cast<double>(points.size());; share *= 8) {
    const bool all = share >= 1;
    const auto limit = all ? UINT64_MAX : static_cast<std::uint64_t>(std::ldexp(share, 64));
    drawn.clear();
    for (const Index i : points) {
      const float* p = cloud.point(static_cast<std::size_t>(i));
      const std::uint64_t hash = hash_of(p);
      if (hash <= limit) drawn.push_back({hash, p[0], p[1], p[2]});
    }
    std::ranges::sort(drawn, [](const Drawn& a, const Drawn& b) { return a.key() < b.key(); });
    const auto same = std::ranges::unique(
        drawn, [](const Drawn& a, const Drawn& b) { return a.key() == b.key(); });
    drawn.erase(same.begin(), same.end());
    if (drawn.size() >= kSample || all) break;
  }
  if (drawn.size() > kSample) drawn.resize(kSample);
  Sample sample;
  for (const Drawn& d : drawn) {
    sample.x.push_back(d.x);
    sample.y.push_back(d.y);
    sample.z.push_back(d.z);
  }
  return sample;
}

struct Candidate {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0;
};

/// The sum of the squared distances of the first `count` points, where each distance is in units of
/// `distance` and each square is capped at one (the score of MSAC). A low cost is good. A sum of
/// `enough` or more is only a lower bound, because the summation then stops.
double cost_of(const Candidate& plane, const Sample& sample, std::size_t count, double distance,
               double enough) {
  const double nx = plane.normal.x() / distance, ny = plane.normal.y() / distance;
  const double nz = plane.normal.z() / distance, d = plane.offset / distance;
  double cost = 0;
  constexpr std::size_t block = 128;
  for (std::size_t begin = 0; begin < count && cost < enough; begin += block) {
    for (std::size_t i = begin; i < std::min(count, begin + block); ++i) {
      const double r = nx * sample.x[i] + ny * sample.y[i] + nz * sample.z[i] + d;
      cost += std::min(r * r, 1.0);
    }
  }
  return cost;
}

/// The best of kHypotheses planes through three points of the sample. Empty if all points are
/// collinear.
std::optional<Candidate> best_hypothesis(const Sample& sample, double distance) {
  const std::size_t scored = std::min(sample.size(), kScored);
  std::uint64_t state = 0;  // a fixed seed gives the same plane for the same input
  const auto any = [&] {
    state += 0x9e3779b97f4a7c15ULL;
    return sample[static_cast<std::size_t>(mix(state) % sample.size())];
  };
  std::optional<Candidate> best;
  double best_cost = static_cast<double>(scored);
  for (int i = 0; i < kHypotheses; ++i) {
    const Eigen::Vector3d a = any(), b = any(), c = any();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double area = normal.norm();
    // A triangle that is thinner than the plane is left out, because its normal would be noise.
    if (!(area > distance * (b - a).norm()) || !(area > distance * (c - a).norm())) continue;
    const Candidate plane{normal / area, -normal.dot(a) / area};
    const double cost = cost_of(plane, sample, scored, distance, best_cost);
    if (cost < best_cost) {
      best_cost = cost;
      best = plane;
    }
  }
  return best;
}

/// The least-squares plane of the points within `distance` of a plane. Empty if these points are
/// collinear. The sum is repeatable, because it follows the order of the sample.
std::optional<Candidate> refit(const Candidate& plane, const Sample& sample, double distance) {
  std::vector<std::size_t> inliers;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (std::abs(plane.normal.dot(sample[i]) + plane.offset) > distance) continue;
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
  if (!(spread[1] > 1e-9 * spread[2])) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return Candidate{normal, -normal.dot(mean)};
}

double share_of(const Candidate& plane, const Sample& sample, double distance) {
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    inliers += std::abs(plane.normal.dot(sample[i]) + plane.offset) <= distance;
  }
  return static_cast<double>(inliers) / static_cast<double>(sample.size());
}

/// The plane of the previous frame. Empty if there is no such plane, or if it has lost more than a
/// small share of its points.
std::optional<Candidate> as_good_as_before(const std::optional<Plane>& guess, const Sample& sample,
                                           double distance) {
  constexpr double most_lost = 0.1;
  if (!guess) return std::nullopt;
  const Candidate plane{Eigen::Vector3d(guess->normal.data()), guess->offset};
  const double share = share_of(plane, sample, distance);
  return share >= (1 - most_lost) * guess->share ? std::optional(plane) : std::nullopt;
}

/// The median, or 0 if there are no values.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Computes PlaneSearch::range. @param distance half the thickness of the plane.
double range_of(const Plane& plane, const Sample& sample, const Vec3& viewpoint, double distance) {
  const Eigen::Vector3d eye(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < sample.size(); ++i)
    if (std::abs(plane.signed_distance(sample.x[i], sample.y[i], sample.z[i])) <= distance)
      ranges.push_back((sample[i] - eye).norm());
  return median(ranges);
}

/// Computes PlaneSearch::noise. @param reach points at least this far behind the plane belong to
/// another surface.
double noise_of(const Plane& plane, const Sample& sample, const Vec3& viewpoint, double reach) {
  constexpr std::size_t fewest = 30;
  constexpr double median_of_half_normal = 0.6745;  // in standard deviations
  const Eigen::Vector3d eye(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::vector<double> depths;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double depth = -plane.signed_distance(sample.x[i], sample.y[i], sample.z[i]);
    if (depth > 0 && depth < reach) depths.push_back(depth / (sample[i] - eye).squaredNorm());
  }
  if (depths.size() < fewest) return 0;
  return median(depths) / median_of_half_normal;
}

}  // namespace

PlaneSearch find_plane(const CloudView& cloud, const std::vector<Index>& points, double distance,
                       const std::optional<Plane>& guess) {
  if (points.size() < 3) return {std::nullopt, "no plane: fewer than three points in range"};
  const Sample sample = draw_sample(cloud, points);
  // The search uses twice the thickness, because a plane through three noisy points is rarely exact
  // to a millimetre.
  std::optional<Candidate> found = as_good_as_before(guess, sample, distance);
  if (!found) found = best_hypothesis(sample, 2 * distance);
  if (!found) return {std::nullopt, "no plane: the points in range lie on a line or at one point"};
  for (int i = 0; i < kRefits; ++i) {
    const std::optional<Candidate> better = refit(*found, sample, i == 0 ? 2 * distance : distance);
    if (better) found = better;
  }
  const double share = share_of(*found, sample, distance);
  if (share < kSmallestShare) {
    return {std::nullopt,
            fmt::format("no plane: the largest one holds {:.1f} % of the points in range, less "
                        "than {:.0f} %",
                        100 * share, 100 * kSmallestShare)};
  }
  const auto& [vx, vy, vz] = cloud.viewpoint;
  if (found->normal.dot(Eigen::Vector3d(vx, vy, vz)) + found->offset < 0) {
    found->normal = -found->normal;
    found->offset = -found->offset;
  }
  const Eigen::Vector3d& n = found->normal;
  const Plane plane{{n.x(), n.y(), n.z()}, found->offset, share};
  // The largest multiple of the margin that noise may reach.
  constexpr double margins = 6;
  return {plane, "", noise_of(plane, sample, cloud.viewpoint, margins * distance),
          range_of(plane, sample, cloud.viewpoint, distance)};
}

Cleared remove_plane(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                     const PlaneMargin& margin) {
  // The share of the margin that is left out of the strip.
  constexpr double lowest_share = 0.2;
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
      if (height > lowest_share * limit) cleared.strip.push_back(i);
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

double cosine_between(const Plane& a, const Plane& b) {
  return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
}

}  // namespace ph::segment
