// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <regex>

#include "ph/io/svg_plot.hpp"
#include "plot_support.hpp"

namespace ph {
namespace {

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
  for (const auto& bars : test::odd_barcodes())
    for (const PlotKind kind : test::kPlotKinds) {
      PlotOptions options;
      options.kind = kind;
      check(svg_plot(test::barcode_of(bars), options));
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
  for (const PlotKind kind : test::kPlotKinds) {
    PlotOptions options;
    options.kind = kind;
    check(svg_plot(test::barcode_of(bars), options));
  }
}

TEST(Plot, TextIsEscaped) {
  PlotOptions options;
  options.title = "<script>alert(\"&\")</script>\x01\xff" + std::string(500, 'x');
  options.value_label = "a < b";
  for (const PlotKind kind : test::kPlotKinds) {
    options.kind = kind;
    const std::string svg = svg_plot(test::barcode_of({{0, 0, 1}}), options);
    check(svg);
    EXPECT_EQ(svg.find("<script"), svg.npos);
    EXPECT_NE(svg.find("&lt;script&gt;"), svg.npos);
    EXPECT_NE(svg.find("a &lt; b"), svg.npos);
    EXPECT_EQ(svg.find('\x01'), svg.npos);
    EXPECT_EQ(svg.find('\xff'), svg.npos);
  }
}

TEST(Plot, InfiniteBarsEndInATriangle) {
  const std::string finite = svg_plot(test::barcode_of({{0, 0, 1}}));
  const std::string infinite = svg_plot(test::barcode_of({{0, 0, 1}, {0, 0, kInfinity}}));
  EXPECT_EQ(finite.find("never dies"), finite.npos);
  EXPECT_NE(infinite.find("never dies"), infinite.npos);
}

TEST(Plot, DiagramCountsEqualBars) {
  PlotOptions options;
  options.kind = PlotKind::diagram;
  const std::string svg = svg_plot(test::barcode_of({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}), options);
  EXPECT_NE(svg.find("×3"), svg.npos);
}

TEST(TreePlot, AnyValues) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  const std::vector<std::vector<Branch>> cases{
      {},
      {{0, kInfinity, -1}},
      {{0, kInfinity, -1}, {0, 0, 0}},
      {{-kInfinity, kInfinity, -1}, {-kInfinity, 3, 0}, {3, 3, 1}},
      {{-huge, huge, 1}, {0, kInfinity, -1}},
      {{0, tiny, 1}, {tiny, kInfinity, -1}},
      {{1, 1 + 1e-15, 1}, {0, kInfinity, -1}},
      {{0, kInfinity, -1}, {0, 2, 0}, {0, 2, 1}, {0, 2, 2}},
  };
  for (const auto& tree : cases) check(svg_plot(tree));
}

TEST(TreePlot, ManyClassesStaySmall) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (const bool ties : {false, true}) {
    std::vector<Branch> tree{{0, kInfinity, -1}};
    for (Index i = 1; i < 100'000; ++i) {
      // Joins an elder one that lives on.
      const Index elder = static_cast<Index>(random()) % i;
      const double death = std::min(1.0, tree[static_cast<std::size_t>(elder)].death);
      tree.push_back({0, ties ? 1 : death * number(random), elder});
    }
    const std::string svg = svg_plot(tree);
    check(svg);
    EXPECT_NE(svg.find("99,904 shorter ones"), svg.npos);
    EXPECT_NE(svg.find("100,000 classes of H₀, 1 never die"), svg.npos);
  }
}

/// The numbers behind a command in path data: 'M' and 'V', or 'M' and 'H'.
std::vector<std::array<double, 3>> lines_of(const std::string& svg, char end) {
  const std::regex line(std::string("M([0-9.]+) ([0-9.]+)") + end + "([0-9.]+)");
  std::vector<std::array<double, 3>> lines;
  for (std::sregex_iterator i(svg.begin(), svg.end(), line), last; i != last; ++i)
    lines.push_back({std::stod((*i)[1]), std::stod((*i)[2]), std::stod((*i)[3])});
  return lines;
}

TEST(TreePlot, LinesMeetAndDoNotCross) {
  // 0 lives on; 1 joins it, 2 and 3 join 1, 4 joins 0 the last; 5 is apart.
  const std::vector<Branch> tree{{0, kInfinity, -1}, {0, 7, 0}, {1, 3, 1},
                                 {2, 5, 1},          {3, 9, 0}, {4, kInfinity, -1}};
  const std::string svg = svg_plot(tree);
  const auto branches = lines_of(svg, 'H'), joints = lines_of(svg, 'V');
  ASSERT_EQ(branches.size(), 6u);
  ASSERT_EQ(joints.size(), 4u);
  for (const auto& [x, from, to] : joints) {
    int ends = 0, starts = 0;
    for (const auto& [begin, y, end] : branches) {
      if (y == from && std::abs(end - x) < 0.02) ++ends;
      if (y == to && begin <= x && x <= end) ++starts;
      const bool between = std::min(from, to) < y && y < std::max(from, to);
      EXPECT_FALSE(between && begin < x && x < end) << "crossed at " << x << " " << y;
    }
    EXPECT_EQ(ends, 1);
    EXPECT_EQ(starts, 1);
  }
}

TEST(TreePlot, ThoseOfNoLengthAreNotThere) {
  const std::vector<Branch> tree{{0, kInfinity, -1}, {2, 2, 0}, {1, 3, 1}};
  const std::string svg = svg_plot(tree);
  EXPECT_EQ(lines_of(svg, 'H').size(), 2u);
  EXPECT_EQ(lines_of(svg, 'V').size(), 1u) << "to the elder of the elder";
}

TEST(Plot, KindsByName) {
  EXPECT_EQ(plot_kind_named("betti"), PlotKind::betti);
  EXPECT_EQ(plot_kind_named("Betti"), std::nullopt);
}

}  // namespace
}  // namespace ph
