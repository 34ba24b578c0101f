// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "ph/io/svg_plot.hpp"

namespace ph {
namespace {

constexpr std::array kKinds{PlotKind::barcode, PlotKind::diagram, PlotKind::betti};

Barcode barcode_of(const std::vector<Bar>& bars) {
  Barcode barcode;
  const std::array<Index, 1> cell{0};
  for (const Bar& bar : bars)
    barcode.add(bar, cell, bar.is_infinite() ? std::span<const Index>() : std::span(cell));
  barcode.sort();
  return barcode;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
  return found;
}

/// What every picture obeys.
void check(const std::string& svg) {
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_LT(svg.size(), 1'000'000u);
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(svg.find("inf"), svg.npos);
  EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
}

TEST(Plot, AnyValues) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  const std::vector<std::vector<Bar>> cases{
      {},
      {{0, 0, kInfinity}},
      {{0, 5, kInfinity}},
      {{0, -kInfinity, kInfinity}, {0, -kInfinity, 3}, {1, -2, kInfinity}},
      {{0, -huge, huge}, {0, 0, kInfinity}},
      {{0, 0, tiny}, {1, tiny, kInfinity}},
      {{0, 1, 1 + 1e-15}},
      {{0, 1e6, 1e6 + 1e-6}},
      {{60, -3, -2}},
      {{0, 0, 0}},
  };
  for (const auto& bars : cases)
    for (const PlotKind kind : kKinds) {
      PlotOptions options;
      options.kind = kind;
      check(svg_plot(barcode_of(bars), options));
    }
}

TEST(Plot, ManyBarsStaySmall) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Bar> bars;
  for (int i = 0; i < 100'000; ++i) {
    const double birth = number(random);
    bars.push_back({i % 4, birth, i % 10 == 0 ? kInfinity : birth + number(random)});
  }
  for (const PlotKind kind : kKinds) {
    PlotOptions options;
    options.kind = kind;
    check(svg_plot(barcode_of(bars), options));
  }
}

TEST(Plot, TextIsEscaped) {
  PlotOptions options;
  options.title = "<script>alert(\"&\")</script>\x01\xff" + std::string(500, 'x');
  options.value_label = "a < b";
  for (const PlotKind kind : kKinds) {
    options.kind = kind;
    const std::string svg = svg_plot(barcode_of({{0, 0, 1}}), options);
    check(svg);
    EXPECT_EQ(svg.find("<script"), svg.npos);
    EXPECT_NE(svg.find("&lt;script&gt;"), svg.npos);
    EXPECT_NE(svg.find("a &lt; b"), svg.npos);
    EXPECT_EQ(svg.find('\x01'), svg.npos);
    EXPECT_EQ(svg.find('\xff'), svg.npos);
  }
}

TEST(Plot, InfiniteBarsEndInATriangle) {
  const std::string finite = svg_plot(barcode_of({{0, 0, 1}}));
  const std::string infinite = svg_plot(barcode_of({{0, 0, 1}, {0, 0, kInfinity}}));
  EXPECT_EQ(finite.find("never dies"), finite.npos);
  EXPECT_NE(infinite.find("never dies"), infinite.npos);
}

TEST(Plot, DiagramCountsEqualBars) {
  PlotOptions options;
  options.kind = PlotKind::diagram;
  const std::string svg = svg_plot(barcode_of({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}), options);
  EXPECT_NE(svg.find("×3"), svg.npos);
}

TEST(Plot, KindsByName) {
  EXPECT_EQ(plot_kind_named("betti"), PlotKind::betti);
  EXPECT_EQ(plot_kind_named("Betti"), std::nullopt);
}

}  // namespace
}  // namespace ph
