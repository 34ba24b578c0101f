// SPDX-License-Identifier: MIT
#include "libph/src/alpha/periodic/images.hpp"

#include <algorithm>
#include <cmath>

#include "ph/error.hpp"

namespace ph::alpha {
namespace {

struct Range {
  std::int64_t from = 0, to = 0;
};

/// The range of the numbers k for which x + k · period lies in the box or within `margin` of it.
Range periods_within(double x, double period, double margin) {
  if (period == 0) return {};
  const double before = std::floor((margin + x) / period);
  const double behind = std::floor((margin + period - x) / period);
  constexpr auto most = static_cast<double>(kMostPeriods);
  if (!(before < most && behind < most))
    throw Error(ErrorKind::resource,
                "alpha complex: found points so far apart along axes without a period that more "
                "than 2^18 periodic copies of each point are needed along another axis");
  return {-static_cast<std::int64_t>(before), static_cast<std::int64_t>(behind)};
}

}  // namespace

Images images_within(const Sites& sites, const Box& box, const Margin& margin_of,
                     const RunContext& context) {
  Images images(&context.memory);
  Sites& places = images.places;
  places.coordinates = sites.coordinates;
  places.exponent = sites.exponent;
  images.begin.reserve(sites.size() + 1);
  Ticker ticker(context, "images", sites.size());
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    ticker.tick();
    images.begin.push_back(static_cast<std::uint32_t>(places.size()));
    const Vector<double>& p = sites.points[site];
    const double margin = margin_of(p);
    const Range x = periods_within(p.x, box.period[0], margin);
    const Range y = periods_within(p.y, box.period[1], margin);
    const Range z = periods_within(p.z, box.period[2], margin);
    for (std::int64_t i = x.from; i <= x.to; ++i)
      for (std::int64_t j = y.from; j <= y.to; ++j)
        for (std::int64_t k = z.from; k <= z.to; ++k) {
          places.points.push_back({p.x + static_cast<double>(i) * box.period[0],
                                   p.y + static_cast<double>(j) * box.period[1],
                                   p.z + static_cast<double>(k) * box.period[2]});
          if (sites.is_weighted()) places.weights.push_back(sites.weights[site]);
          images.site.push_back(site);
          images.translation.push_back(translation_by({i, j, k}));
          if (places.size() >= kNone / 4)
            throw Error(ErrorKind::resource,
                        "alpha complex: found too many periodic copies of points");
          ticker.work();
        }
  }
  images.begin.push_back(static_cast<std::uint32_t>(places.size()));

  order_path(places, context);
  return images;
}

}  // namespace ph::alpha
