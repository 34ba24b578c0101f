// SPDX-License-Identifier: MIT
#include "ph/io/plot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

#include "ph/detail/io/png.hpp"
#include "tests/libph/plot/plot_support.hpp"
#include "tests/support/expect_error.hpp"

namespace ph {
namespace {

Raster decoded(const std::string& png) { return read_png(Input::view(png, "plot.png")); }

using Colour = std::array<int, 3>;
constexpr Colour kWhite{255, 255, 255}, kH0{0x00, 0x72, 0xb2}, kH1{0xd5, 0x5e, 0x00};

Colour colour_at(const Raster& raster, Index x, Index y) {
  return {raster.at(x, y, 0), raster.at(x, y, 1), raster.at(x, y, 2)};
}

std::size_t pixels_of(const Raster& raster, const Colour& colour) {
  std::size_t count = 0;
  for (Index y = 0; y < raster.height; ++y)
    for (Index x = 0; x < raster.width; ++x) count += colour_at(raster, x, y) == colour;
  return count;
}

/// The bounding box of all pixels of a colour: left, top, right, bottom.
std::array<Index, 4> box_of(const Raster& raster, const Colour& colour) {
  std::array<Index, 4> box{raster.width, raster.height, -1, -1};
  for (Index y = 0; y < raster.height; ++y)
    for (Index x = 0; x < raster.width; ++x)
      if (colour_at(raster, x, y) == colour)
        box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
  return box;
}

class PngPlot : public testing::Test {
 protected:
  void SetUp() override {
    if (png_plot_support().empty()) GTEST_SKIP() << "PNG plots are not built in";
  }
};

TEST_F(PngPlot, IsAColumnWideAt300DotsAnInch) {
  for (const PlotKind kind : test::kPlotKinds) {
    PlotOptions options;
    options.kind = kind;
    const std::string png =
        png_plot(test::barcode_of({{0, 0, 1}, {0, 0, kInfinity}, {1, 1, 2}}), options);
    const Raster raster = decoded(png);
    EXPECT_EQ(raster.width, 1040);
    EXPECT_EQ(raster.channels, 3);
    EXPECT_GT(raster.height, 150);
    const std::string resolution("pHYs\0\0\x2e\x23\0\0\x2e\x23\1", 13);  // 11811 dots per metre
    EXPECT_NE(png.find(resolution), png.npos);
    EXPECT_GT(pixels_of(raster, kWhite),
              static_cast<std::size_t>(raster.width * raster.height) / 3);
    EXPECT_GT(pixels_of(raster, kH0), 50u);
    EXPECT_GT(pixels_of(raster, kH1), 50u);
    EXPECT_EQ(png, png_plot(test::barcode_of({{0, 0, 1}, {0, 0, kInfinity}, {1, 1, 2}}), options));
  }
}

TEST_F(PngPlot, AnyValues) {
  for (const auto& bars : test::odd_barcodes())
    for (const PlotKind kind : test::kPlotKinds) {
      PlotOptions options;
      options.kind = kind;
      const Raster raster = decoded(png_plot(test::barcode_of(bars), options));
      EXPECT_EQ(raster.width, 1040);
      EXPECT_GT(pixels_of(raster, {0x22, 0x22, 0x22}), 1000u) << "an axis";
    }
}

/// A bar of half the length is half as many pixels long, and begins at its birth.
TEST_F(PngPlot, BarsAreAsLongAsTheyLive) {
  const Raster whole = decoded(png_plot(test::barcode_of({{1, 0, 8}})));
  const Raster half = decoded(png_plot(test::barcode_of({{0, 0, 8}, {1, 4, 8}})));
  // Removes the letter H, which has the same colour as the bars and lies to their left.
  const auto bar = [](const Raster& raster) {
    Raster right = raster;
    for (Index y = 0; y < raster.height; ++y)
      for (Index x = 0; x < 120; ++x)
        right.samples[static_cast<std::size_t>((y * raster.width + x) * 3)] = 255;
    return box_of(right, kH1);
  };
  const auto [left, top, right, bottom] = bar(whole);
  const auto [half_left, half_top, half_right, half_bottom] = bar(half);
  EXPECT_NEAR(static_cast<double>(left), 125, 1);
  EXPECT_NEAR(static_cast<double>(right), 1006, 1);
  EXPECT_NEAR(static_cast<double>(half_left), (125 + 1006) / 2.0, 2);
  EXPECT_EQ(half_right, right);
  EXPECT_GE(bottom - top, 6);
  EXPECT_LE(bottom - top, 10);
}

TEST_F(PngPlot, TextIsDrawn) {
  const auto drawn = [](const std::string& title) {
    PlotOptions options;
    options.title = title;
    return decoded(png_plot(test::barcode_of({{0, 0, 1}}), options));
  };
  const Raster none = drawn(" "), narrow = drawn("i"), wide = drawn("W W W");
  constexpr Colour ink{0x22, 0x22, 0x22};
  const std::size_t axis = pixels_of(none, ink);
  EXPECT_GT(pixels_of(narrow, ink), axis + 20);
  EXPECT_GT(pixels_of(wide, ink), pixels_of(narrow, ink) + 100);
  EXPECT_EQ(drawn("\xff\x01").samples, drawn("\xef\xbf\xbd\xef\xbf\xbd").samples) << "no UTF-8";
  // The letter O has a hole: its middle is white, with ink on both sides.
  const Raster hole = drawn("O");
  bool found = false;
  for (Index y = 20; y < 46; ++y)
    found |= colour_at(hole, 520, y) == kWhite && colour_at(hole, 510, y) == ink;
  EXPECT_TRUE(found);
  EXPECT_EQ(colour_at(hole, 520, 34), kWhite);
}

TEST_F(PngPlot, ManyBarsStaySmallAndAreADensity) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Bar> bars;
  for (int i = 0; i < 100'000; ++i) {
    const double birth = number(random);
    bars.push_back({i % 4, birth, birth + number(random) * number(random)});
  }
  for (const PlotKind kind : test::kPlotKinds) {
    PlotOptions options;
    options.kind = kind;
    const std::string png = png_plot(test::barcode_of(bars), options);
    EXPECT_LT(png.size(), 1'000'000u);
    std::set<Colour> colours;
    const Raster raster = decoded(png);
    for (Index y = 0; y < raster.height; ++y)
      for (Index x = 0; x < raster.width; ++x) colours.insert(colour_at(raster, x, y));
    EXPECT_GT(colours.size(), 30u);
  }
  PlotOptions diagram;
  diagram.kind = PlotKind::diagram;
  EXPECT_NE(svg_plot(test::barcode_of(bars), diagram).find("shaded: 99,"), std::string::npos);
  bars.resize(1000);
  EXPECT_EQ(svg_plot(test::barcode_of(bars), diagram).find("shaded"), std::string::npos);
}

TEST_F(PngPlot, Trees) {
  const std::vector<Branch> tree{{0, kInfinity, -1}, {1, 3, 0}, {2, 2.5, 1}};
  const Raster raster = decoded(png_plot(tree));
  EXPECT_EQ(raster.width, 1040);
  EXPECT_GT(pixels_of(raster, kH0), 1000u);
  EXPECT_NE(png_plot(tree), png_plot(std::span(tree).first(1)));
}

TEST_F(PngPlot, PixelsCountInMemory) {
  const Barcode bars = test::barcode_of({{0, 0, 1}});
  RunContext context;
  context.memory.set_limit(4 << 20);
  test::expect_error(ErrorKind::resource, "memory", [&] { png_plot(bars, {}, context); });
  context.memory.set_limit(64 << 20);
  EXPECT_FALSE(png_plot(bars, {}, context).empty());
  EXPECT_EQ(context.memory.used(), 0u);
  EXPECT_GT(context.memory.peak(), 4u << 20);
}

/// A picture of 40 x 20 pixels: red on the left, blue on the right.
ColouredPicture red_and_blue() {
  ColouredPicture picture;
  picture.raster = {40, 20, 3, 8, {}};
  for (int i = 0; i < 40 * 20; ++i)
    for (const int sample : i % 40 < 20 ? Colour{200, 0, 0} : Colour{0, 0, 200})
      picture.raster.samples.push_back(static_cast<std::uint16_t>(sample));
  picture.heading = "Side, pixels";
  picture.legend = {
      {0xC80000, "left", "400"}, {0x0000C8, "right", "400"}, {{}, "and <others>", "0"}};
  picture.description = "two sides";
  return picture;
}

TEST(ColouredPlot, SvgHoldsThePixelsAndTheLegendAsText) {
  const std::string svg = svg_plot(red_and_blue());
  EXPECT_NE(svg.find("href=\"data:image/png;base64,iVBORw0KGgo"), svg.npos);
  EXPECT_NE(svg.find("fill=\"#c80000\""), svg.npos);
  EXPECT_NE(svg.find(">and &lt;others&gt;</text>"), svg.npos);
  EXPECT_NE(svg.find("<desc>two sides</desc>"), svg.npos);
  ColouredPicture damaged = red_and_blue();
  damaged.raster.samples.pop_back();
  test::expect_error(ErrorKind::bad_data, "2399 samples", [&] { svg_plot(damaged); });
  damaged.raster = {};
  test::expect_error(ErrorKind::bad_data, "0 x 0", [&] { svg_plot(damaged); });
}

TEST_F(PngPlot, PixelsOfAPictureAreKept) {
  ColouredPicture picture = red_and_blue();
  const Raster raster = decoded(png_plot(picture));
  // Some pixels are in the middle of the picture, the others in the two squares of the legend.
  for (const auto& [x, colour] : {std::pair(500, Colour{200, 0, 0}),
                                  {519, Colour{200, 0, 0}},
                                  {520, Colour{0, 0, 200}},
                                  {539, Colour{0, 0, 200}}})
    for (const Index y : {0, 19}) EXPECT_EQ(colour_at(raster, x, y), colour) << x << ' ' << y;
  EXPECT_EQ(colour_at(raster, 499, 10), kWhite);
  EXPECT_EQ(colour_at(raster, 540, 10), kWhite);
  EXPECT_EQ(colour_at(raster, 510, 20), kWhite);
  const auto square = [](std::size_t side) { return side * side; };
  EXPECT_NEAR(static_cast<double>(pixels_of(raster, {200, 0, 0})),
              static_cast<double>(400 + square(25)), 30);
  picture.marks.push_back({10, 10, "8"});
  const Raster marked = decoded(png_plot(picture));
  EXPECT_LT(pixels_of(marked, {200, 0, 0}), pixels_of(raster, {200, 0, 0}) - 50);
  picture.legend.clear();
  EXPECT_EQ(decoded(png_plot(picture)).height, 20);
  // A raster wider than the column is scaled down.
  ColouredPicture wide;
  wide.raster = {2080, 2, 1, 16, std::vector<std::uint16_t>(4160, 0x8000)};
  const Raster narrow = decoded(png_plot(wide));
  EXPECT_EQ(narrow.width, 1040);
  EXPECT_EQ(colour_at(narrow, 1039, 0), (Colour{128, 128, 128}));
}

TEST(PngPlotWithout, IsRefused) {
  if (!png_plot_support().empty()) GTEST_SKIP() << "PNG plots are built in";
  test::expect_error(ErrorKind::not_built_in, "use SVG", [&] { png_plot(test::barcode_of({})); });
  test::expect_error(ErrorKind::not_built_in, "use SVG", [&] { png_plot(red_and_blue()); });
}

}  // namespace
}  // namespace ph
