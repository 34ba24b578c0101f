// SPDX-License-Identifier: MIT
#include "ph/io/save.hpp"

#include "ph/image.hpp"
#include "tests/libph/io/barcodes/barcode_support.hpp"

namespace ph::test {
namespace {

const std::vector<double> kSquare{0, 0, 1, 0, 1, 1, 0, 1};

/// The facts of a file that `save` wrote.
BarcodeInfo saved(const AnyComplex& complex, const Options& options = {}) {
  const TempDir dir;
  const std::string path = dir.file("bars.json").string();
  const RunPlan how = plan(complex, options);
  const Barcode bars = run(complex, how);
  save(path, bars, info_of(complex, how));
  const StoredBarcode read = read_stored_barcode(Input::open(path));
  EXPECT_EQ(first_difference(read.bars, bars), "");
  EXPECT_TRUE(read.info.program.starts_with("libph "));
  EXPECT_EQ(read.info.engine, how.options.engine.name());
  return read.info;
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
