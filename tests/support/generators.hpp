// SPDX-License-Identifier: MIT
#pragma once
// Small, difficult inputs that are made from a sequence of choices: ties, duplicates, zeros,
// missing edges.
#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/explicit.hpp"
#include "ph/rips.hpp"

namespace ph::test {

/// Makes choices from a sequence of pseudo-random numbers.
class RandomChoices {
 public:
  explicit RandomChoices(std::uint64_t seed) : engine_(seed) {}
  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(engine_); }
  double real() { return std::uniform_real_distribution(0.0, 1.0)(engine_); }

 private:
  std::mt19937_64 engine_;
};

/// Makes inputs from choices. @tparam Choices has `integer(low, high)`, both inclusive, and
/// `real()` in [0, 1].
template <class Choices>
class InputGenerator {
 public:
  explicit InputGenerator(Choices choices) : choices_(std::move(choices)) {}

  int integer(int low, int high) { return choices_.integer(low, high); }
  bool coin() { return integer(0, 1) == 1; }
  double real() { return choices_.real(); }
  /// A random value. If `ties` is true, the value is one of a few.
  double value(bool ties) { return ties ? integer(0, 3) : real(); }

  Points points(Index n, Index d, bool ties) {
    Points p(n, d);
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < d; ++k) p(i, k) = value(ties);
    return p;
  }
  /// A symmetric matrix that need not satisfy the triangle inequality.
  DistanceMatrix distances(Index n, bool ties) {
    std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
    for (double& d : lower) d = value(ties);
    return DistanceMatrix(n, lower);
  }
  SparseDistances sparse(Index n, bool ties, double density) {
    std::vector<WeightedEdge> edges;
    for (Index u = 0; u < n; ++u)
      for (Index v = u + 1; v < n; ++v)
        if (real() < density) edges.push_back({v, u, value(ties)});
    return SparseDistances(n, edges);
  }
  Image image(std::vector<Index> extents, bool ties) {
    Index voxels = 1;
    for (const Index n : extents) voxels *= n;
    std::vector<double> values(static_cast<std::size_t>(voxels));
    for (double& v : values) {
      v = value(ties) - 1;
      if (integer(0, 39) == 0) v = kInfinity;
      if (integer(0, 39) == 0) v = -kInfinity;
    }
    return {std::move(extents), std::move(values)};
  }
  CubicalOptions cubical_options(int dim) {
    CubicalOptions options;
    if (coin()) options.construction = CubicalOptions::Construction::cells;
    options.superlevel = coin();
    for (int k = 0; k < dim; ++k) options.periodic.push_back(integer(0, 2) == 0);
    return options;
  }
  /// The faces of some random simplices. Each simplex enters with its youngest facet or later.
  SimplexList simplices(Index vertices, int top_dim, int count, bool ties) {
    std::set<std::vector<Index>> all;
    for (int i = 0; i < count; ++i) {
      std::set<Index> chosen;
      const int size = integer(1, std::min(top_dim + 1, static_cast<int>(vertices)));
      while (static_cast<int>(chosen.size()) < size)
        chosen.insert(integer(0, static_cast<int>(vertices) - 1));
      const std::vector<Index> simplex(chosen.begin(), chosen.end());
      for (std::size_t mask = 1; mask < (std::size_t{1} << simplex.size()); ++mask) {
        std::vector<Index> face;
        for (std::size_t k = 0; k < simplex.size(); ++k)
          if (mask >> k & 1) face.push_back(simplex[k]);
        all.insert(face);
      }
    }
    std::vector<std::vector<Index>> ordered(all.begin(), all.end());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::map<std::vector<Index>, double> value_of;
    SimplexList list;
    for (const auto& simplex : ordered) {
      double v = value(ties);
      for (std::size_t k = 0; simplex.size() > 1 && k < simplex.size(); ++k) {
        auto facet = simplex;
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
        v = std::max(v, value_of.at(facet));
      }
      value_of[simplex] = v;
      list.add(simplex, v);
    }
    return list;
  }

 private:
  Choices choices_;
};

class Generator : public InputGenerator<RandomChoices> {
 public:
  explicit Generator(std::uint64_t seed) : InputGenerator(RandomChoices(seed)) {}
};

}  // namespace ph::test
