// SPDX-License-Identifier: MIT
// write_alpha_cases FILE COUNT LARGE: writes COUNT clouds of up to 300 points and LARGE clouds of
// 10 000 points, one JSON object per line. Each object has a cloud and the bars of its alpha
// complex in squared values. compare_alpha.py compares these bars with the bars from GUDHI. If the
// points in space lie in a plane, they are written as points of this plane, because some programs
// refuse them otherwise.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numbers>

#include "ph/alpha.hpp"
#include "ph/persistence.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

enum class Kind { cube, square, sphere, near_sphere, grid, decimals, torus, clusters, plane };
constexpr int kKinds = 9;

std::array<double, 3> point_of(Kind kind, Generator& random, int side) {
  const auto any = [&] { return random.real(); };
  const double turn = 2 * std::numbers::pi * any(), other = 2 * std::numbers::pi * any();
  const double height = 2 * any() - 1, across = std::sqrt(1 - height * height);
  switch (kind) {
    case Kind::sphere:
      return {across * std::cos(turn), across * std::sin(turn), height};
    case Kind::near_sphere: {
      const double radius = 1 + 0.1 * any();
      return {radius * across * std::cos(turn), radius * across * std::sin(turn), radius * height};
    }
    case Kind::grid:
    case Kind::decimals: {
      const auto at = [&] { return random.integer(0, side - 1); };
      if (kind == Kind::grid) return {1.0 * at(), 1.0 * at(), 1.0 * at()};
      return {0.1 * at(), 0.1 * at(), 0.1 * at()};
    }
    case Kind::torus: {
      const double radius = 2 + std::cos(other);
      return {radius * std::cos(turn), radius * std::sin(turn), std::sin(other)};
    }
    case Kind::clusters: {
      const auto centre = [&] { return random.integer(0, 2) * 1.0; };
      return {centre() + 0.01 * any(), centre() + 0.01 * any(), centre() + 0.01 * any()};
    }
    default:
      return {any(), any(), any()};
  }
}

std::string list(std::span<const double> row) {
  std::string text;
  for (const double x : row) text += fmt::format("{}{}", text.empty() ? "" : ",", x);
  return "[" + text + "]";
}

void write_cloud(std::ostream& out, Kind kind, Index n, bool weighted, std::int64_t field,
                 Generator& random) {
  const Index dim = kind == Kind::square || kind == Kind::plane ? 2 : 3;
  const bool has_copies = random.integer(0, 2) == 0;
  const int side = static_cast<int>(std::cbrt(static_cast<double>(n))) + 1;
  Points points(n, dim), embedded(n, 3);
  for (Index i = 0; i < n; ++i) {
    const auto x = point_of(kind, random, side);
    const bool is_copy = has_copies && i > 0 && random.integer(0, 4) == 0;
    const Index of = is_copy ? random.integer(0, static_cast<int>(i) - 1) : i;
    for (Index k = 0; k < dim; ++k) {
      points(i, k) = is_copy ? points(of, k) : x[static_cast<std::size_t>(k)];
      embedded(i, 2 - k) = points(i, k);  // rotated without rounding
    }
  }
  AlphaOptions options{.unit = AlphaOptions::Unit::squared};
  for (Index i = 0; weighted && i < n; ++i) options.weights.push_back(0.02 * random.real());
  const Barcode barcode =
      persistence(Alpha(kind == Kind::plane ? embedded : points, options), {.field = field});
  std::string rows, bars;
  for (Index i = 0; i < n; ++i)
    rows +=
        (i > 0 ? "," : "") + list(points.coordinates().subspan(static_cast<std::size_t>(i * dim),
                                                               static_cast<std::size_t>(dim)));
  for (const Bar& bar : barcode)
    bars += fmt::format("{}[{},{},{}]", bars.empty() ? "" : ",", bar.dim, bar.birth,
                        bar.is_infinite() ? "Infinity" : fmt::format("{}", bar.death));
  out << fmt::format(R"({{"kind":"alpha","points":[{}],"weights":{},"field":{},"bars":[{}]}})",
                     rows, list(options.weights), field, bars)
      << '\n';
}

void write_all(std::ostream& out, int count, int large) {
  constexpr std::int64_t fields[] = {2, 3, 5, 11};
  for (int i = 0; i < count + large; ++i) {
    Generator random(static_cast<std::uint64_t>(i));
    constexpr Index most = 10'000;
    const Index some = random.integer(0, 4) == 0 ? random.integer(40, 300) : random.integer(4, 40);
    write_cloud(out, static_cast<Kind>(i % kKinds), i < count ? some : most, i / kKinds % 4 == 3,
                fields[i / 2 % 4], random);
  }
}

}  // namespace
}  // namespace ph::test

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: write_alpha_cases FILE COUNT LARGE\n";
    return 64;
  }
  std::ofstream out(argv[1]);
  ph::test::write_all(out, std::atoi(argv[2]), std::atoi(argv[3]));
  out.close();
  return out ? 0 : 74;
}
