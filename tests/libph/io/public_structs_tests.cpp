// SPDX-License-Identifier: MIT
// Clouds and pictures that callers fill in are checked like files. These tests should also be run
// with sanitizers.
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "ph/io/cloud.hpp"
#include "ph/io/plot.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "tests/support/wrong_values.hpp"

namespace ph::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kMost = std::numeric_limits<Index>::max();
constexpr auto kBad = ErrorKind::bad_data, kUsage = ErrorKind::usage,
               kResource = ErrorKind::resource;

TEST(PublicStructs, MeshWithoutOffsets) {
  Mesh mesh;
  mesh.offsets.clear();
  EXPECT_EQ(mesh.faces(), 0U);
}

Cloud cloud(auto&& change) {
  Cloud result;
  result.width = 2;
  result.fields = {{"x", FieldType::float32, 1, 0},
                   {"y", FieldType::float32, 1, 4},
                   {"z", FieldType::float32, 1, 8}};
  result.stride = 12;
  result.data.resize(24);
  change(result);
  return result;
}

TEST(PublicStructs, Cloud) {
  struct Wrong {
    const char* name;
    const char* part;
    Cloud cloud;
  };
  const Wrong wrongs[] = {
      {"negative", "-2 x -1 points", cloud([](Cloud& c) { c.width = -2, c.height = -1; })},
      {"a product that overflows", "24 bytes", cloud([](Cloud& c) { c.width = c.height = kMost; })},
      {"too wide", "24 bytes", cloud([](Cloud& c) { c.width = 3; })},
      {"data cut off", "23 bytes", cloud([](Cloud& c) { c.data.resize(23); })},
      {"a field beyond", "field z of 1 numbers from byte 9",
       cloud([](Cloud& c) { c.fields[2].offset = 9; })},
      {"an offset that wraps", "field z", cloud([](Cloud& c) { c.fields[2].offset = SIZE_MAX; })},
      {"a count that overflows", "field z",
       cloud([](Cloud& c) { c.fields[2].count = SIZE_MAX / 2; })},
      {"points of no bytes", "field x", cloud([](Cloud& c) { c.stride = 0, c.data.clear(); })},
  };
  for (const Wrong& wrong : wrongs) {
    const Cloud& c = wrong.cloud;
    std::ostringstream out;
    const Case cases[] = {
        {"xyz", kBad, wrong.part, [&] { c.xyz(); }},
        {"rgb", kBad, wrong.part, [&] { c.rgb(); }},
        {"points_of", kBad, wrong.part, [&] { points_of(c); }},
        {"add_field", kBad, wrong.part, [&] { Cloud(c).add_field("a", FieldType::uint8); }},
        {"set_uint32", kBad, wrong.part,
         [&] {
           Cloud(c).set_uint32(0, {1, 2});
         }},
        {"PCD", kBad, wrong.part, [&] { write_pcd(out, c); }},
        {"PLY", kBad, wrong.part, [&] { write_ply(out, c); }},
    };
    SCOPED_TRACE(wrong.name);
    expect_errors({std::begin(cases), std::end(cases)});
    EXPECT_EQ(out.str(), "");
  }
  expect_errors({
      {"a field of too many numbers", kResource, "too large",
       [] { cloud([](Cloud&) {}).add_field("a", FieldType::float64, SIZE_MAX / 4); }},
      {"no fields", kBad, "no fields",
       [] {
         std::ostringstream out;
         write_pcd(out, cloud([](Cloud& c) { c.fields.clear(); }));
       }},
      {"labels", kBad, "found 1, expected",
       [] {
         std::ostringstream out;
         write_npy(out, std::vector<std::uint32_t>{1}, kMost, kMost);
       }},
  });
}

Raster raster_of(Index width, Index height, int channels, int bits, std::size_t samples) {
  Raster raster;
  raster.width = width;
  raster.height = height;
  raster.channels = channels;
  raster.bits = bits;
  raster.samples.resize(samples);
  return raster;
}

TEST(PublicStructs, RasterAndCamera) {
  const auto depth = [](std::vector<Index> extents, std::size_t count,
                        Intrinsics camera = {1, 1, 0, 0}, double scale = 1000) {
    const Image image{std::move(extents), std::vector<double>(count, 1)};
    return [=] { cloud_from_depth(image, {}, {camera}, scale); };
  };
  const auto coloured = [](Raster colour) {
    return [=] { cloud_from_depth({{2, 2}, {1, 1, 1, 1}}, colour, {{1, 1, 0, 0}}); };
  };
  const auto picture = [](Index width, Index height, int channels, int bits, std::size_t samples) {
    ColouredPicture of;
    of.raster = raster_of(width, height, channels, bits, samples);
    return [=] { svg_plot(of); };
  };
  expect_errors({
      {"too few", kBad, "found 3 values", depth({2, 2}, 3)},
      {"negative", kBad, "-2 x -2", depth({-2, -2}, 4)},
      // The square of the largest extent is 1 modulo 2^64.
      {"overflow", kBad, "found 1 values", depth({kMost, kMost}, 1)},
      {"volume", kUsage, "found 3 axes", depth({1, 1, 1}, 1)},
      {"focal length NaN", kUsage, "focal lengths nan", depth({1, 1}, 1, {kNan, 1, 0, 0})},
      {"focal length 0", kUsage, "focal lengths 0", depth({1, 1}, 1, {0, 1, 0, 0})},
      {"centre NaN", kUsage, "centre nan", depth({1, 1}, 1, {1, 1, kNan, 0})},
      {"scale 0", kUsage, "scale 0", depth({1, 1}, 1, {1, 1, 0, 0}, 0)},
      {"scale infinite", kUsage, "scale inf", depth({1, 1}, 1, {1, 1, 0, 0}, kInfinity)},
      {"colour: too few", kBad, "found 3 samples", coloured(raster_of(2, 2, 3, 8, 3))},
      {"colour: no channels", kBad, "0 channels", coloured(raster_of(2, 2, 0, 8, 0))},
      {"colour: other size", kBad, "expected 2 x 2", coloured(raster_of(1, 2, 1, 8, 2))},
      {"picture: too few", kBad, "found 3 samples", picture(2, 2, 1, 8, 3)},
      {"picture: overflow", kBad, "found 0 samples", picture(kMost, kMost, 4, 8, 0)},
      {"picture: five channels", kBad, "5 channels", picture(1, 1, 5, 8, 5)},
      {"picture: 12 bits", kBad, "12 bits", picture(1, 1, 1, 12, 1)},
      {"PNG: too few", kBad, "found 0 samples",
       [] {
         std::ostringstream out;
         write_png(out, raster_of(kMost, 2, 1, 8, 0));
       }},
  });
}

TEST(PublicStructs, EndsOfAnAxis) {
  const auto plot = [](std::optional<double> low, std::optional<double> high) {
    return [=] {
      Barcode bars(CellKind::vertices);
      bars.add({0, 0, 1}, {}, {});
      PlotOptions options;
      options.axis.low = low;
      options.axis.high = high;
      svg_plot(bars, options);
    };
  };
  expect_errors({
      {"from -infinity", kUsage, "axis: found -inf to 1", plot(-kInfinity, 1)},
      {"to infinity", kUsage, "to inf", plot(0, kInfinity)},
      {"to infinity, alone", kUsage, "to inf", plot({}, kInfinity)},
      {"NaN", kUsage, "nan", plot(kNan, 1)},
      {"falling", kUsage, "a lower number first", plot(1, 0)},
  });
  plot(-1e308, 1e308)();
}

TEST(PublicStructs, LoopsOfBars) {
  const auto write = [](std::vector<BarLoops> loops, CellKind kind = CellKind::vertices,
                        bool has_chain = true) {
    return [=] {
      const std::size_t numbers = kind == CellKind::row ? 1 : 2;
      Barcode bars(kind);
      bars.add({1, 0, 1}, std::vector<Index>(numbers, 0), {});
      if (has_chain)
        bars.set_representative(Representatives::cycles, std::vector<Index>(numbers, 0),
                                std::vector<std::int64_t>{1});
      OutputFile file("/dev/null");
      write_barcode(file, bars, BarcodeFormat::json, {.loops = loops});
      file.commit();
    };
  };
  const BarLoops loop{{Loop{{0, 1, 2}, 1}}, Tightness::none};
  expect_errors({
      {"too many", kUsage, "loops of 2 bars", write({loop, loop})},
      {"no chain", kUsage, "bar 0 without a chain", write({loop}, CellKind::vertices, false)},
      {"rows of a matrix", kUsage, "rows of a matrix", write({loop}, CellKind::row)},
      {"half a vertex", kUsage, "a loop of 3 numbers", write({loop}, CellKind::grid)},
      {"nothing", kUsage, "a loop of 0 numbers", write({BarLoops{{Loop{}}, Tightness::none}})},
  });
  write({loop})();
  write({})();
}

TEST(PublicStructs, BranchesOfATree) {
  const auto tree = [](std::vector<Branch> branches) {
    return [branches = std::move(branches)] { svg_plot(std::span(branches)); };
  };
  expect_errors({
      {"an elder that is not there", kBad, "branch 0: found an elder branch 5", tree({{0, 1, 5}})},
      {"its own elder", kBad, "a cycle of elder branches", tree({{0, 1, 0}})},
      {"a circle", kBad, "a cycle of elder branches",
       tree({{0, kInfinity, -1}, {0, 1, 2}, {0, 1, 3}, {0, 1, 1}})},
      {"a circle that others come to", kBad, "a cycle of elder branches",
       tree({{0, 1, 1}, {0, 2, 2}, {0, 2, 1}})},
      {"NaN", kBad, "branch 1", tree({{0, kInfinity, -1}, {kNan, 1, 0}})},
  });
  tree({{0, kInfinity, -1}, {1, 2, 0}, {1, 3, 0}, {1.5, 2, 1}})();
}

TEST(PublicStructs, RawLayout) {
  const auto raw = [](RawLayout layout) {
    return [layout = std::move(layout)] { read_raw(Input::view("abcd", "a.raw"), layout); };
  };
  expect_errors({
      {"no axes", kUsage, "no axes", raw({})},
      {"a negative size", kUsage, "found -1", raw({.extents = {-1}})},
      {"another type", kUsage, "found f3", raw({.extents = {4}, .type = "f3"})},
      {"no type", kUsage, "raw type", raw({.extents = {4}, .type = ""})},
      {"too large", kBad, "truncated", raw({.extents = {5}})},
      {"too small", kBad, "trailing", raw({.extents = {3}})},
      {"a product that overflows", kBad, "more than 2^64", raw({.extents = {kMost, kMost, kMost}})},
      {"what is skipped", kBad, "skipped", raw({.extents = {4}, .skip = 5})},
      {"all is skipped", kBad, "skipped", raw({.extents = {4}, .skip = SIZE_MAX})},
  });
}

}  // namespace
}  // namespace ph::test
