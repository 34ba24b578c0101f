// SPDX-License-Identifier: MIT
#include "libsegment/src/plane/sample.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace ph::segment {
namespace {

constexpr std::size_t kSample = 4096;

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

}  // namespace

std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

Sample draw_sample(const CloudView& cloud, const std::vector<Index>& points,
                   const PlaneMargin& margin) {
  struct Drawn {
    std::uint64_t hash;
    float x, y, z;
    auto key() const { return std::tie(hash, x, y, z); }
  };
  std::vector<Drawn> drawn;
  // More points are drawn than are kept, because their number is random. If they are still too few,
  // many more are drawn.
  constexpr double surplus = 1.25, many_more = 8;
  const double wanted = surplus * kSample;
  for (double share = wanted / static_cast<double>(points.size());; share *= many_more) {
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
    const float p[] = {d.x, d.y, d.z};
    sample.add({d.x, d.y, d.z}, margin(cloud, p));
  }
  return sample;
}

Sample points_off(const Plane& plane, double margins, const Sample& sample) {
  Sample off;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double height = plane.signed_distance(sample.x[i], sample.y[i], sample.z[i]);
    if (std::abs(height) > margins * sample.limits[i]) off.add(sample[i], sample.limits[i]);
  }
  return off;
}

}  // namespace ph::segment
