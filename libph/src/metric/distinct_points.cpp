// SPDX-License-Identifier: MIT
#include "libph/src/metric/distinct_points.hpp"

#include <algorithm>
#include <bit>
#include <span>

namespace ph {

std::pmr::vector<std::uint32_t> first_equal_points(PointsView points, const RunContext& context) {
  const auto row = [&](std::uint32_t i) {
    return std::span(points.row(Index{i}), static_cast<std::size_t>(points.cols()));
  };
  struct Hashed {
    std::uint64_t hash;
    std::uint32_t number;
    bool operator<(const Hashed& o) const {
      return hash != o.hash ? hash < o.hash : number < o.number;
    }
  };
  std::pmr::vector<Hashed> order(static_cast<std::size_t>(points.rows()), &context.memory);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    std::uint64_t hash = 0;
    for (const double x : row(i)) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32;
    }
    order[i] = {hash, i};
  }
  context.poll();
  std::sort(order.begin(), order.end());
  context.poll();

  std::pmr::vector<std::uint32_t> first(order.size(), &context.memory);
  const auto same_hash = [](const Hashed& a, const Hashed& b) { return a.hash == b.hash; };
  for (auto run = order.begin(); run != order.end();) {
    const auto end =
        std::find_if_not(run, order.end(), [&](const Hashed& h) { return same_hash(*run, h); });
    // Different points rarely have equal hashes, unless somebody constructs such points. Single
    // points are skipped, because even a sort of one point allocates memory.
    if (end - run > 1)
      std::stable_sort(run, end, [&](const Hashed& a, const Hashed& b) {
        return std::ranges::lexicographical_compare(row(a.number), row(b.number));
      });
    for (auto it = run; it != end; ++it) {
      const bool is_copy = it != run && std::ranges::equal(row(it->number), row((it - 1)->number));
      first[it->number] = is_copy ? first[(it - 1)->number] : it->number;
    }
    run = end;
  }
  return first;
}

std::pmr::vector<std::uint32_t> distinct_points(std::span<const std::uint32_t> first_equal,
                                                const RunContext& context) {
  std::pmr::vector<std::uint32_t> distinct(&context.memory);
  for (std::uint32_t i = 0; i < first_equal.size(); ++i)
    if (first_equal[i] == i) distinct.push_back(i);
  return distinct;
}

}  // namespace ph
