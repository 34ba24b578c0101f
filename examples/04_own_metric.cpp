// SPDX-License-Identifier: MIT
// A metric of your own needs two functions. Here it is the great-circle distance between places
// along the Pacific's Ring of Fire, which forms one large loop around the ocean.
#include <cmath>
#include <iostream>
#include <numbers>
#include <ph/ph.hpp>
#include <vector>

struct Place {
  const char* name;
  double latitude, longitude;  // degrees
};

class GreatCircle {
 public:
  explicit GreatCircle(const std::vector<Place>& places) : places_(places) {}
  ph::Index size() const { return static_cast<ph::Index>(places_.size()); }
  /// The distance in kilometres, by the haversine formula.
  double operator()(ph::Index i, ph::Index j) const {
    const Place &a = places_[static_cast<std::size_t>(i)],
                &b = places_[static_cast<std::size_t>(j)];
    constexpr double degree = std::numbers::pi / 180, radius = 6371;
    const double u = std::sin((b.latitude - a.latitude) * degree / 2);
    const double v = std::sin((b.longitude - a.longitude) * degree / 2);
    return 2 * radius *
           std::asin(std::sqrt(u * u + std::cos(a.latitude * degree) *
                                           std::cos(b.latitude * degree) * v * v));
  }

 private:
  const std::vector<Place>& places_;
};

int main() {
  const std::vector<Place> places{
      {"Wellington", -41.3, 174.8},  {"Suva", -18.1, 178.4},     {"Port Moresby", -9.5, 147.2},
      {"Manila", 14.6, 121.0},       {"Tokyo", 35.7, 139.7},     {"Kamchatka", 53.0, 158.7},
      {"Anchorage", 61.2, -149.9},   {"Seattle", 47.6, -122.3},  {"Mexico City", 19.4, -99.1},
      {"Quito", -0.2, -78.5},        {"Santiago", -33.4, -70.7}, {"Deception Island", -63.0, -60.6},
      {"Mount Erebus", -77.5, 167.2}};
  const ph::Barcode bars = ph::persistence(ph::Rips(GreatCircle(places)));
  for (const ph::Bar& bar : bars.bars(1))
    std::cout << "a loop of steps up to " << std::lround(bar.birth)
              << " km, filled by triangles of " << std::lround(bar.death) << " km\n";
}
