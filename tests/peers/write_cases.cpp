// SPDX-License-Identifier: MIT
// Writes random small inputs, each with the barcode that libph computes, and pairs of diagrams with
// their distances. Each line is a JSON object. compare.py compares these results with the results
// of other programs.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "ph/distances.hpp"
#include "ph/persistence.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"

namespace ph::test {
namespace {

constexpr std::int64_t kFields[] = {2, 3, 5, 11};

std::string number(double v) {
  if (v == kInfinity) return "Infinity";
  if (v == -kInfinity) return "-Infinity";
  return fmt::format("{}", v);
}

template <class Values>
std::string list(const Values& values) {
  std::string text = "[";
  for (const auto& v : values) {
    if (text.size() > 1) text += ',';
    text += number(static_cast<double>(v));
  }
  return text + "]";
}

std::string bars(const Barcode& barcode) {
  std::string text = "[";
  for (const Bar& bar : barcode) {
    if (text.size() > 1) text += ',';
    text += fmt::format("[{},{},{}]", bar.dim, number(bar.birth), number(bar.death));
  }
  return text + "]";
}

/// A distance that other programs can read, store in single precision and print without a loss of
/// digits.
double distance(Generator& random, bool ties) {
  return ties ? random.integer(0, 4) : random.integer(1, 99999);
}

template <class M>
void write_rips(std::ostream& out, const M& metric, int max_dim, std::optional<double> threshold,
                std::int64_t field) {
  std::vector<double> lower;
  for (Index i = 0; i < metric.size(); ++i)
    for (Index j = 0; j < i; ++j) lower.push_back(metric(i, j));
  const Rips rips(metric, {.threshold = threshold});
  out << fmt::format(
      R"({{"kind":"rips","points":{},"lower":{},"max_dim":{},"threshold":{},"field":{},"bars":{},"bars_over_2":{}}})",
      metric.size(), list(lower), max_dim, threshold ? number(*threshold) : "null", field,
      bars(persistence(rips, {.max_dim = max_dim, .field = field})),
      bars(persistence(rips, {.max_dim = max_dim})));
  out << '\n';
}

void write_random_rips(std::ostream& out, Generator& random, std::int64_t field) {
  const bool ties = random.coin();
  const Index n = random.integer(2, 14);
  std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
  for (double& d : lower) d = distance(random, ties);
  std::optional<double> threshold;
  if (random.coin()) threshold = distance(random, ties);
  write_rips(out, DistanceMatrix(n, lower), random.integer(0, 3), threshold, field);
}

void write_cubical(std::ostream& out, Generator& random, std::int64_t field) {
  Image image;
  CubicalOptions options{.construction = CubicalOptions::Construction::cells};
  const int dim = random.integer(1, 3);
  std::size_t voxels = 1;
  for (int k = 0; k < dim; ++k) {
    image.extents.push_back(random.integer(1, dim == 3 ? 4 : 6));
    voxels *= static_cast<std::size_t>(image.extents.back());
    options.periodic.push_back(random.integer(0, 2) == 0);
  }
  const bool ties = random.coin();
  std::vector<double> values(voxels);
  for (double& v : values) {
    v = random.value(ties);
    if (random.integer(0, 29) == 0) v = kInfinity;
  }
  image.values = values;
  out << fmt::format(
      R"({{"kind":"cubical","extents":{},"values":{},"periodic":{},"field":{},"bars":{}}})",
      list(image.extents), list(values), list(options.periodic), field,
      bars(persistence(Cubical(image, options), {.field = field})));
  out << '\n';
}

void write_simplices(std::ostream& out, const SimplexList& simplices, std::int64_t field) {
  std::string all;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if (i > 0) all += ',';
    all += fmt::format("[{},{}]", list(simplices.simplex(i)), number(simplices.values[i]));
  }
  out << fmt::format(
      R"({{"kind":"simplices","simplices":[{}],"field":{},"bars":{}}})", all, field,
      bars(persistence(ExplicitComplex::from_simplices(simplices), {.field = field})));
  out << '\n';
}

/// A known space with random values at its vertices.
SimplexList random_heights(Generator& random, const Simplices& space) {
  std::set<std::vector<Index>> faces;
  std::vector<double> height(static_cast<std::size_t>(vertex_count(space)));
  for (double& h : height) h = random.integer(0, 9);
  for (const auto& simplex : space) {
    for (unsigned mask = 1; mask < (1U << simplex.size()); ++mask) {
      std::vector<Index> face;
      for (std::size_t k = 0; k < simplex.size(); ++k)
        if (mask >> k & 1) face.push_back(simplex[k]);
      std::sort(face.begin(), face.end());
      faces.insert(face);
    }
  }
  SimplexList filtered;
  for (const auto& face : faces) {
    double value = 0;
    for (const Index v : face) value = std::max(value, height[static_cast<std::size_t>(v)]);
    filtered.add(face, value);
  }
  return filtered;
}

void write_distance(std::ostream& out, Generator& random) {
  const bool ties = random.coin();
  const auto diagram = [&](std::vector<Bar> bars, int count) {
    for (int i = 0; i < count; ++i) {
      const auto [low, high] = std::minmax({distance(random, ties), distance(random, ties)});
      bars.push_back({0, low, random.integer(0, 19) == 0 ? kInfinity : high});
    }
    return bars;
  };
  const std::vector<Bar> first = diagram({}, random.integer(0, 40));
  // In about half of the cases, the second diagram contains all bars of the first.
  const std::vector<Bar> second =
      diagram(random.coin() ? first : std::vector<Bar>(), random.integer(0, 12));
  const auto pairs = [](const std::vector<Bar>& bars) {
    std::string text;
    for (const Bar& bar : bars)
      text +=
          fmt::format("{}[{},{}]", text.empty() ? "" : ",", number(bar.birth), number(bar.death));
    return text;
  };
  out << fmt::format(R"({{"kind":"distance","first":[{}],"second":[{}],"bottleneck":{}}})",
                     pairs(first), pairs(second), number(bottleneck_distance(first, second)));
  out << '\n';
}

void write_all(std::ostream& out, int count) {
  const Simplices spaces[] = {klein_bottle(), projective_plane(), torus_of_seven_vertices(),
                              suspension(projective_plane()), cross_polytope(3)};
  for (int seed = 0; seed < count; ++seed) {
    Generator random(static_cast<std::uint64_t>(seed));
    const std::int64_t field = kFields[seed % 4];
    write_random_rips(out, random, field);
    if (seed % 2 == 0) write_cubical(out, random, kFields[seed / 2 % 4]);
    if (seed % 4 == 0) {
      write_simplices(out, random.simplices(8, 3, 10, random.coin()), kFields[seed / 4 % 4]);
    }
    if (seed % 4 == 1) write_distance(out, random);
    if (seed % 40 == 0) {
      for (const Simplices& space : spaces)
        write_simplices(out, random_heights(random, space), kFields[seed / 40 % 4]);
    }
  }
  for (const std::int64_t field : kFields) {
    write_rips(out, FlatSurface{5, 5, true}, 2, 1, field);
    write_rips(out, FlatSurface{5, 4}, 2, std::nullopt, field);
  }
}

}  // namespace
}  // namespace ph::test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: write_cases FILE COUNT\n";
    return 64;
  }
  std::ofstream out(argv[1]);
  ph::test::write_all(out, std::atoi(argv[2]));
  out.close();
  return out ? 0 : 74;
}
