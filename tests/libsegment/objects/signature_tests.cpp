// SPDX-License-Identifier: MIT
// Signatures of shapes with known homology. Each shape is a separate segment.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ph/error.hpp"
#include "ph/segment.hpp"

namespace ph::segment {
namespace {

constexpr double kVoxel = 0.005, kTurn = 2 * std::numbers::pi;

class Shapes {
 public:
  void add(double x, double y, double z) {
    for (const double c : {x, y, z}) xyz_.push_back(static_cast<float>(c));
  }
  void ball(double radius, const Vec3& c, bool full) {
    for (double r = full ? 0 : radius; r <= radius; r += 0.002)
      for (double a = 0; a < kTurn / 2; a += 0.002 / radius)
        for (double b = 0; b < kTurn; b += 0.002 / radius)
          add(c[0] + r * std::sin(a) * std::cos(b), c[1] + r * std::sin(a) * std::sin(b),
              c[2] + r * std::cos(a));
  }
  void torus(double radius, double thickness, const Vec3& c) {
    for (double a = 0; a < kTurn; a += 0.002 / radius)
      for (double b = 0; b < kTurn; b += 0.002 / thickness)
        add(c[0] + (radius + thickness * std::cos(b)) * std::cos(a),
            c[1] + (radius + thickness * std::cos(b)) * std::sin(a),
            c[2] + thickness * std::sin(b));
  }
  Segmentation segmented() const {
    return segment(CloudView{xyz_, {}},
                   {.method = Method::paper, .voxel = kVoxel, .plane = false, .distance = 0.02});
  }

 private:
  std::vector<float> xyz_;
};

std::vector<std::size_t> counts(const Barcode& barcode) {
  return {barcode.bars(0).size(), barcode.bars(1).size(), barcode.bars(2).size()};
}

TEST(Signature, TellsPiecesLoopsAndHollows) {
  using Counts = std::vector<std::size_t>;
  const Vec3 middle{0, 0, 1};
  {
    Shapes s;
    s.ball(0.03, middle, true);
    const Segmentation found = s.segmented();
    const Barcode bars = signature(found.tree, found.cut, std::vector{1U});
    EXPECT_EQ(counts(bars), (Counts{1, 0, 0}));
  }
  {
    Shapes s;
    s.ball(0.05, middle, false);
    const Segmentation found = s.segmented();
    const Barcode bars = signature(found.tree, found.cut, std::vector{1U});
    EXPECT_EQ(counts(bars), (Counts{1, 0, 1}));
    EXPECT_NEAR(bars.bars(2)[0].death, 0.05, 2 * kVoxel);
  }
  {
    Shapes s;
    s.torus(0.06, 0.02, middle);
    const Segmentation found = s.segmented();
    const Barcode bars = signature(found.tree, found.cut, std::vector{1U});
    EXPECT_EQ(counts(bars), (Counts{1, 2, 1}));
    double shortest = kInfinity, longest = 0;
    for (const Bar& bar : bars.bars(1)) {
      shortest = std::min(shortest, bar.death);
      longest = std::max(longest, bar.death);
    }
    EXPECT_NEAR(shortest, 0.02, 2 * kVoxel);
    EXPECT_NEAR(longest, 0.04, 2 * kVoxel);  // the radius of the hole
  }
}

TEST(Signature, OfAGroupAndOfOneOfIt) {
  Shapes s;
  s.torus(0.06, 0.004, {0, 0, 1});  // its tube is too thin to be hollow
  s.ball(0.03, {0.3, 0, 1}, true);
  const Segmentation found = s.segmented();
  ASSERT_EQ(found.cut.segments.size(), 2U);
  std::size_t loops = 0;
  for (const Segment& one : found.cut.segments)
    loops += signature(found.tree, found.cut, std::vector{one.label}).bars(1).size();
  EXPECT_EQ(loops, 1U);
  const Barcode both = signature(found.tree, found.cut, std::vector{1U, 2U});
  EXPECT_EQ(counts(both), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_THROW(signature(found.tree, found.cut, std::vector{3U}), Error);
  EXPECT_THROW(signature(found.tree, found.cut, std::vector{0U}), Error);
  EXPECT_THROW(signature(found.tree, found.cut, std::vector<std::uint32_t>{}), Error);
}

}  // namespace
}  // namespace ph::segment
