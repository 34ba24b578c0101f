// SPDX-License-Identifier: MIT
#include "ph/io/save.hpp"

#include <cmath>

#include "ph/image.hpp"
#include "ph/parts/cloud_part.hpp"
#include "ph/parts/image_part.hpp"
#include "ph/persistence.hpp"
#include "tests/libph/io/barcodes/barcode_support.hpp"

namespace ph::test {
namespace {

const std::vector<double> kSquare{0, 0, 1, 0, 1, 1, 0, 1};

/// Points on a line, at distances 1.
struct Steps {
  Index count;
  Index size() const { return count; }
  double operator()(Index i, Index j) const { return std::abs(static_cast<double>(i - j)); }
};

/// The origin of bars as a file that `save` wrote states it.
BarcodeInfo saved(const Barcode& bars) {
  const TempDir dir;
  const std::string path = dir.file("bars.json").string();
  save(path, bars);
  const Barcode read = read_barcode(path);
  EXPECT_EQ(first_difference(read, bars), "");
  EXPECT_EQ(text_of(read, BarcodeFormat::json), text_of(bars, BarcodeFormat::json));
  return read.info();
}

BarcodeInfo saved(const AnyComplex& complex, const Options& options = {}) {
  const RunPlan how = plan(complex, options);
  const BarcodeInfo info = saved(run(complex, how));
  EXPECT_TRUE(info.program.starts_with("libph 0."));
  EXPECT_EQ(info.engine, how.options.engine.name());
  // Both ways to compute bars state the same origin.
  EXPECT_EQ(text_of(persistence(complex, options), BarcodeFormat::json),
            text_of(run(complex, how), BarcodeFormat::json));
  return info;
}

TEST(SaveBarcode, JsonStatesTheFactsOfTheComplex) {
  const PointsView square(kSquare.data(), 4, 2);
  const BarcodeInfo rips =
      saved(Rips(square, {.threshold = 1.25, .distance = PointDistance::manhattan}),
            {.max_dim = 2, .field = 3, .min_persistence = 0.125});
  EXPECT_EQ(rips.complex, "rips");
  EXPECT_EQ(rips.metric, "manhattan");
  EXPECT_EQ(rips.points, 4);
  EXPECT_EQ(rips.coordinates, 2);
  EXPECT_EQ(rips.vertices, 4);
  EXPECT_EQ(rips.edges, 4U);
  EXPECT_EQ(rips.threshold, 1.25);
  EXPECT_EQ(rips.field, 3);
  EXPECT_EQ(rips.max_dim, 2);
  EXPECT_EQ(rips.min_persistence, 0.125);
  const BarcodeInfo sample = saved(Rips(square, {.subsample = GreedyLimits{.points = 2}}));
  ASSERT_TRUE(sample.subsample.has_value());
  EXPECT_EQ(sample.subsample->points, 2);
  EXPECT_EQ(sample.subsample->of, 4);
  EXPECT_EQ(saved(Rips(square, {.approximation = 0.5})).approximation, 0.5);

  const Image image{{2, 4}, Voxels(kSquare)};
  const BarcodeInfo cubical =
      saved(Cubical(image, {.construction = CubicalOptions::Construction::cells,
                            .superlevel = true,
                            .periodic = {false, true},
                            .threshold = -0.5}),
            {.min_dim = 1});
  EXPECT_EQ(cubical.complex, "cubical");
  EXPECT_EQ(cubical.construction, "cells");
  EXPECT_EQ(cubical.shape, (std::vector<Index>{2, 4}));
  EXPECT_EQ(cubical.periodic, std::vector<int>{1});
  EXPECT_TRUE(cubical.superlevel);
  EXPECT_EQ(cubical.threshold, -0.5);
  EXPECT_EQ(cubical.min_dim, 1);
  EXPECT_EQ(saved(Cubical(image)).threshold, std::nullopt);
}

TEST(SaveBarcode, JsonStatesTheSourceOfDistances) {
  const PointsView square(kSquare.data(), 4, 2);
  const DistanceMatrix line(3, {1, 3, 2});
  const BarcodeInfo matrix = saved(Rips(line));
  EXPECT_EQ(matrix.metric, "precomputed");
  EXPECT_EQ(matrix.points, 3);
  EXPECT_EQ(matrix.coordinates, std::nullopt);
  EXPECT_EQ(saved(Rips(Steps{5})).metric, "function");
  EXPECT_EQ(saved(Rips(square, {.births = {0, 0, 1, 0}})).vertex_weights, "given, exponent inf");
  EXPECT_EQ(saved(Rips(square, {.dtm_neighbours = 2})).vertex_weights, "dtm 2, exponent 1");
  EXPECT_EQ(saved(Rips(square, {.core_neighbours = 2})).vertex_weights, "core 2, exponent inf");
  const BarcodeInfo collapsed = saved(Rips(square), {.collapse = Collapse::on});
  EXPECT_TRUE(collapsed.collapsed);
  // The points are freed once the edges are made, but the facts about them stay known.
  const BarcodeInfo freed = saved(persistence(Rips(square), {.max_dim = 2}));
  EXPECT_EQ(freed.metric, "euclidean");
  EXPECT_EQ(freed.coordinates, 2);
}

TEST(SaveBarcode, JsonStatesTheFactsOfLists) {
  SimplexList edges;
  for (const auto& [vertices, value] : std::vector<std::pair<std::vector<Index>, double>>{
           {{0}, 0}, {{1}, 0}, {{2}, 0}, {{0, 1}, 1}, {{1, 2}, 3}})
    edges.add(vertices, value);
  ExplicitComplex complex = ExplicitComplex::from_simplices(edges);
  EXPECT_EQ(saved(complex).complex, "explicit");
  EXPECT_EQ(saved(complex).threshold, std::nullopt);
  complex.set_threshold(2);
  const BarcodeInfo cut = saved(complex, {.min_persistence = 0.5});
  EXPECT_EQ(cut.threshold, 2);
  EXPECT_EQ(cut.min_persistence, 0.5);
}

TEST(SaveBarcode, JsonStatesTheFactsOfParts) {
  const Image image{{2, 4}, Voxels(kSquare)};
  ImagePart upper(image, 0, 2, {.max_dim = 1}), lower(image, 1, 2, {.max_dim = 1});
  upper.join(std::move(lower));
  const BarcodeInfo of_image = saved(upper.barcode());
  EXPECT_EQ(of_image.complex, "cubical");
  EXPECT_EQ(of_image.shape, (std::vector<Index>{2, 4}));
  EXPECT_EQ(of_image.max_dim, 1);
  const PointsView square(kSquare.data(), 4, 2);
  CloudPart first(square, 0, 2), second(square, 1, 2);
  first.join(std::move(second));
  const BarcodeInfo of_cloud = saved(first.barcode());
  EXPECT_EQ(of_cloud.metric, "euclidean");
  EXPECT_EQ(of_cloud.coordinates, 2);
}

TEST(SaveBarcode, BarsMadeByHandHaveNoOrigin) {
  EXPECT_EQ(example().info().program, "");
  Barcode bars = persistence(Rips(PointsView(kSquare.data(), 4, 2)));
  const Barcode copy = bars;
  bars.set_info({});
  EXPECT_EQ(bars.info().complex, "");
  EXPECT_EQ(copy.info().complex, "rips");
}

TEST(SaveBarcode, TheExtensionSelectsTheFormat) {
  const TempDir dir;
  for (const BarcodeFormatInfo& format : barcode_formats()) {
    if (format.format == BarcodeFormat::none) continue;
    const std::string path = dir.file("bars." + std::string(format.name)).string();
    save(path, example());
    EXPECT_EQ(Input::open(path).text(), text_of(example(), format.format)) << path;
  }
  for (const char* name : {"bars", "bars.txt", "bars.none"}) {
    try {
      save(dir.file(name).string(), example());
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_TRUE(contains(error.what(), "expected .csv, .json")) << error.what();
    }
  }
}

}  // namespace
}  // namespace ph::test
