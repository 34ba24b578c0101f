// SPDX-License-Identifier: MIT
#include "libph/src/alpha/periodic/quotient.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "ph/error.hpp"

namespace ph::alpha {
namespace {

std::array<double, 3> coordinates(const Vector<double>& p) { return {p.x, p.y, p.z}; }

/// A margin that is likely to be enough if the sites are uniformly distributed. In the interior,
/// the margin is the radius of the largest empty sphere plus the usual size of a cell. Near the end
/// of an open axis, only a cap of an empty sphere lies in the region of the sites. The flatter this
/// cap is, the wider it is, up to the diagonal of the box along its closed axes.
class LikelyMargin {
 public:
  LikelyMargin(const Sites& sites, const Box& box) : box_(box) {
    low_ = high_ = coordinates(sites.points[0]);
    for (const auto& p : sites.points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = std::min(low_[axis], coordinates(p)[axis]);
        high_[axis] = std::max(high_[axis], coordinates(p)[axis]);
      }
    const auto count = static_cast<double>(sites.size());
    double measure = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = box.is_closed(axis) ? box.period[axis] : high_[axis] - low_[axis];
      around_ = std::hypot(around_, box.period[axis]);
      if (extent == 0) continue;
      measure *= extent;
      ++dim_;
    }
    constexpr double few = 8;  // found by trial: with this value, a run rarely has to start again
    inside_ = std::min(around_, std::pow(measure / count * (std::log(count) + few), 1.0 / dim_));
  }
  double inside() const { return inside_; }
  void set_inside(double margin) { inside_ = margin; }

  double operator()(const Vector<double>& p) const {
    double depth = inside_;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!box_.is_closed(axis) && low_[axis] < high_[axis])
        depth = std::min(
            {depth, coordinates(p)[axis] - low_[axis], high_[axis] - coordinates(p)[axis]});
    if (depth == inside_ || inside_ >= around_) return inside_;
    const double flat = inside_ / depth;  // contains as many sites as an interior sphere
    return std::min(around_, inside_ * std::pow(flat, 1.0 / (dim_ - 1)));
  }

 private:
  const Box& box_;
  std::array<double, 3> low_, high_;
  double around_ = 0;  // the diagonal of the box along its closed axes
  double inside_ = 0;
  int dim_ = 0;
};

/// The smallest margin for which at least one site has an image along each closed axis. With a
/// smaller margin, the affine hull of the listed images may be smaller than the affine hull of all
/// images.
double least_margin(const Sites& sites, const Box& box) {
  double least = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.is_closed(axis)) continue;
    double nearest = box.period[axis];
    for (const auto& p : sites.points) {
      const double x = coordinates(p)[axis];
      nearest = std::min({nearest, x, box.period[axis] - x});
    }
    least = std::max(least, nearest);
  }
  return least;
}

}  // namespace

PeriodicTriangulation triangulate_periodic(const Sites& sites, const Box& box,
                                           const RunContext& context) {
  constexpr double more = 1 + 1e-9;  // adds more than rounding can remove
  const double most = 2 * more * box.size;
  LikelyMargin margin(sites, box);
  const double least = more * least_margin(sites, box);
  margin.set_inside(std::max(margin.inside(), least));
  for (;;) {
    margin.set_inside(std::min(margin.inside(), most));
    Images images = images_within(sites, box, std::cref(margin), context);
    Triangulation triangulation = triangulate(images.places, context);
    if (take_quotient(triangulation, images, box, context))
      return {std::move(triangulation), std::move(images)};
    if (margin.inside() == most)
      throw Error(ErrorKind::internal,
                  "alpha complex: cells around a periodic box do not fit together");
    margin.set_inside(2 * margin.inside());
  }
}

}  // namespace ph::alpha
