// SPDX-License-Identifier: MIT
// Images with known homology: shells, rings, boxes with periodic axes.
#include "tests/support/conformance.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/known_spaces.hpp"

namespace ph::test {
namespace {

using Betti = std::vector<int>;
using Construction = CubicalOptions::Construction;
constexpr double kInf = kInfinity;
constexpr Construction kBoth[] = {Construction::vertices, Construction::cells};

/// An image with `dim` axes of `n` voxels. The function `value(coordinates)` gives the value of
/// each voxel.
template <class Value>
Image make_image(int dim, Index n, Value&& value) {
  std::vector<double> values;
  std::vector<Index> at(static_cast<std::size_t>(dim), 0);
  for (;;) {
    values.push_back(value(at));
    std::size_t k = at.size();
    while (k > 0 && ++at[k - 1] == n) at[--k] = 0;
    if (k == 0) return {std::vector<Index>(static_cast<std::size_t>(dim), n), values};
  }
}

bool is_on_border(const std::vector<Index>& at, Index n) {
  return std::ranges::any_of(at, [n](Index x) { return x == 0 || x == n - 1; });
}

// The surface of a cube of voxels has the value 0, and the inside has the value 1. Therefore the
// class of a sphere is alive from 0 to 1.
TEST(KnownImages, ShellsAreSpheres) {
  for (int dim = 2; dim <= 4; ++dim) {
    for (const Construction construction : kBoth) {
      const Image image =
          make_image(dim, 3, [](const auto& at) { return is_on_border(at, 3) ? 0.0 : 1.0; });
      const Cubical shell(image, {.construction = construction});
      if (dim < 4) check(shell, dim);
      EXPECT_EQ(bars_of(persistence(shell, {.field = 3})),
                (std::vector<Bar>{{0, 0, kInf}, {dim - 1, 0, 1}}));
    }
  }
}

// Voxels that never enter leave a hole.
TEST(KnownImages, InfiniteVoxelsAreHoles) {
  for (int dim = 2; dim <= 3; ++dim) {
    for (const Construction construction : kBoth) {
      const Image image =
          make_image(dim, 3, [](const auto& at) { return is_on_border(at, 3) ? -1.0 : kInf; });
      const Cubical shell(image, {.construction = construction});
      check(shell, dim);
      EXPECT_EQ(bars_of(persistence(shell)),
                (std::vector<Bar>{{0, -1, kInf}, {dim - 1, -1, kInf}}));
    }
  }
}

TEST(KnownImages, NothingEntersAnImageOfInfinity) {
  for (const Construction construction : kBoth) {
    const Cubical empty(Image{{2, 2}, {kInf, kInf, kInf, kInf}}, {.construction = construction});
    check(empty, 2);
    EXPECT_TRUE(persistence(empty).empty());
  }
}

TEST(KnownImages, BirthsAtMinusInfinity) {
  for (const Construction construction : kBoth) {
    const Cubical line(Image{{5}, {-kInf, 2, -kInf, 3, 1}}, {.construction = construction});
    check(line, 1);
    EXPECT_EQ(bars_of(persistence(line)),
              (std::vector<Bar>{{0, -kInf, 2}, {0, -kInf, kInf}, {0, 1, 3}}));
  }
}

// A ring of voxels whose cross-section has 2 x 2 voxels. It is a solid torus and has the homology
// of a circle.
TEST(KnownImages, SolidTorus) {
  std::vector<double> values;
  for (Index x = 0; x < 5; ++x)
    for (Index y = 0; y < 5; ++y)
      for (Index z = 0; z < 2; ++z)
        values.push_back(x == 2 && y == 2 ? 4.0 : (x + y + z) % 2 == 0 ? 0.0 : 0.5);
  const Image ring{{5, 5, 2}, values};
  for (const Construction construction : kBoth) {
    const Cubical torus(ring, {.construction = construction});
    check(torus, 3, {3});
    const Barcode barcode = persistence(torus);
    EXPECT_EQ(betti_at(barcode, 0.5, 3), (Betti{1, 1, 0, 0}));
    EXPECT_EQ(betti_at(barcode, 4, 3), (Betti{1, 0, 0, 0}));
    EXPECT_EQ(barcode[barcode.longest(1)],
              (Bar{1, construction == Construction::cells ? 0 : 0.5, 4}));
  }
}

// Voxels that touch at a corner are neighbours in the T-construction but not in the V-construction.
TEST(KnownImages, DiagonalNeighboursTellTheConstructionsApart) {
  const Image diagonal{{2, 2}, {0, 1, 1, 0}};
  const Cubical as_vertices(diagonal), as_cells(diagonal, {.construction = Construction::cells});
  check(as_vertices, 2);
  check(as_cells, 2);
  EXPECT_EQ(bars_of(persistence(as_vertices)), (std::vector<Bar>{{0, 0, 1}, {0, 0, kInf}}));
  EXPECT_EQ(bars_of(persistence(as_cells)), (std::vector<Bar>{{0, 0, kInf}}));

  const Image diamond{{3, 3}, {1, 0, 1, 0, 1, 0, 1, 0, 1}};
  EXPECT_EQ(bars_of(persistence(Cubical(diamond))),
            (std::vector<Bar>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, kInf}}));
  EXPECT_EQ(bars_of(persistence(Cubical(diamond, {.construction = Construction::cells}))),
            (std::vector<Bar>{{0, 0, kInf}, {1, 0, 1}}));
}

int binomial(int n, int k) { return k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k; }

// A box whose axes are all periodic is a torus, whatever its values are, and even if axes have only
// one voxel.
TEST(KnownImages, PeriodicBoxesAreTori) {
  Generator random(1);
  const auto expect_torus = [&](const std::vector<Index>& extents) {
    const int dim = static_cast<int>(extents.size());
    Betti torus;
    for (int k = 0; k <= dim; ++k) torus.push_back(binomial(dim, k));
    Index voxels = 1;
    for (const Index n : extents) voxels *= n;
    const Image constant{extents, std::vector<double>(static_cast<std::size_t>(voxels), 7.0)};
    std::vector<double> values(static_cast<std::size_t>(voxels));
    for (double& v : values) v = random.value(true);
    const Image varied{extents, values};
    for (const Construction construction : kBoth) {
      const CubicalOptions options{.construction = construction,
                                   .periodic = std::vector<bool>(extents.size(), true)};
      for (const Image& image : {constant, varied}) {
        const Cubical box(image, options);
        check(box, dim, {3});
        EXPECT_EQ(betti_at_the_end(persistence(box), dim), torus);
        EXPECT_EQ(betti_at_the_end(persistence(box, {.field = 5}), dim), torus);
      }
      EXPECT_EQ(persistence(Cubical(constant, options)).size(), std::size_t{1} << dim);
    }
  };
  for (Index a = 1; a <= 3; ++a) {
    expect_torus({a});
    for (Index b = 1; b <= 3; ++b) {
      expect_torus({a, b});
      for (Index c = 1; c <= 3; ++c) expect_torus({a, b, c});
    }
  }
}

// One periodic axis makes the box a cylinder, which has the homology of a circle.
TEST(KnownImages, OnePeriodicAxisIsACylinder) {
  for (const Construction construction : kBoth) {
    for (Index around = 1; around <= 4; ++around) {
      const Image image{{3, around},
                        std::vector<double>(static_cast<std::size_t>(3 * around), 0.0)};
      const Cubical cylinder(image, {.construction = construction, .periodic = {false, true}});
      check(cylinder, 2);
      EXPECT_EQ(bars_of(persistence(cylinder)), (std::vector<Bar>{{0, 0, kInf}, {1, 0, kInf}}));
    }
  }
}

TEST(KnownImages, SuperlevelIsTheSublevelOfTheNegative) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Generator random(seed);
    Image image = random.image({4, 3}, random.coin());
    CubicalOptions options = random.cubical_options(2);
    if (random.coin()) options.threshold = 0;
    options.superlevel = true;
    const auto above = pairs_of(Cubical(image, options), 2, 3, Engine::automatic);
    image.values.change([](auto& values) {
      for (auto& v : values) v = -v;
    });
    options.superlevel = false;
    EXPECT_EQ(above, pairs_of(Cubical(image, options), 2, 3, Engine::automatic)) << seed;
  }
}

TEST(KnownImages, ThresholdCutsInclusively) {
  const Image line{{4}, {0, 3, 1, 2}};
  for (const Construction construction : kBoth) {
    CubicalOptions options{.construction = construction, .threshold = 2};
    EXPECT_EQ(bars_of(persistence(Cubical(line, options))),
              (std::vector<Bar>{{0, 0, kInf}, {0, 1, kInf}}));
    options.threshold = 3;
    EXPECT_EQ(bars_of(persistence(Cubical(line, options))),
              (std::vector<Bar>{{0, 0, kInf}, {0, 1, 3}}));
    options.threshold = -1;
    EXPECT_TRUE(persistence(Cubical(line, options)).empty());
  }
}

TEST(KnownImages, DegenerateShapes) {
  for (const Construction construction : kBoth) {
    const CubicalOptions options{.construction = construction};
    const Cubical none(Image{}, options), point(Image{{}, {5}}, options);
    check(none, 0);
    check(point, 0);
    EXPECT_TRUE(persistence(none).empty());
    EXPECT_EQ(bars_of(persistence(point)), (std::vector<Bar>{{0, 5, kInf}}));
    const Cubical eight(Image{std::vector<Index>(8, 1), {-2}}, options);
    EXPECT_EQ(bars_of(persistence(eight)), (std::vector<Bar>{{0, -2, kInf}}));
  }
}

}  // namespace
}  // namespace ph::test
