// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <limits>
#include <random>
#include <regex>

#include "ph/error.hpp"
#include "ph/io/plot.hpp"
#include "tests/libph/plot/plot_support.hpp"

namespace ph {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
  return found;
}

/// Checks the rules that every picture must follow.
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

/// The texts in a picture, in the order of the file.
std::vector<std::string> texts_of(const std::string& svg) {
  std::vector<std::string> texts;
  const std::regex text("<text[^>]*>([^<]*)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it)
    texts.push_back((*it)[1]);
  return texts;
}

bool has_text(const std::string& svg, const std::string& text) {
  return std::ranges::count(texts_of(svg), text) > 0;
}

TEST(Plot, AnyLookOfAnyValues) {
  for (const auto& bars : test::odd_barcodes())
    for (const PlotKind kind : test::kPlotKinds)
      for (const bool negated : {false, true}) {
        PlotOptions options;
        options.kind = kind;
        options.negated = negated;
        options.size = {300, 200};
        options.dims = {0, 1};
        check(svg_plot(test::barcode_of(bars), options));
        options.axis = {-1, 2.5, false};
        check(svg_plot(test::barcode_of(bars), options));
        options.axis = {0.5, 1e6, true};
        check(svg_plot(test::barcode_of(bars), options));
        options.axis = {{}, {}, true};
        check(svg_plot(test::barcode_of(bars), options));
      }
}

TEST(Plot, AnAxisNamesWhatIsOnItAndCountsWhatIsNot) {
  const Barcode barcode =
      test::barcode_of({{0, 0, kInfinity}, {0, 0, 1}, {0, 7, 8}, {0, -5, -4}, {1, 3, 4}});
  PlotOptions options;
  options.axis = {0.0, 2.0, false};
  const std::string bars = svg_plot(barcode, options);
  EXPECT_TRUE(has_text(bars, "3 beyond"));
  EXPECT_TRUE(has_text(bars, "2.0"));
  EXPECT_FALSE(has_text(bars, "H₁"));
  options.dims = {1};
  options.axis = {};
  EXPECT_FALSE(has_text(svg_plot(barcode, options), "H₀"));
  EXPECT_TRUE(has_text(svg_plot(barcode, options), "H₁"));
  for (const PlotAxis& axis : {PlotAxis{2.0, 1.0, false}, PlotAxis{1.0, 1.0, false},
                               PlotAxis{0.0, 1.0, true}, PlotAxis{-1.0, {}, true}}) {
    options.axis = axis;
    EXPECT_THROW(svg_plot(barcode, options), Error);
  }
}

TEST(Plot, ALogarithmicAxisHasTicksAtTheEndsOfDouble) {
  PlotOptions options;
  options.axis.logarithmic = true;
  const std::string large =
      svg_plot(test::barcode_of({{0, 1e308, std::numeric_limits<double>::max()}}), options);
  for (const char* tick : {"1.0·10³⁰⁸", "1.6·10³⁰⁸"}) EXPECT_TRUE(has_text(large, tick)) << tick;
  const std::string small = svg_plot(test::barcode_of({{0, 5e-324, 1e-323}}), options);
  for (const char* tick : {"5·10⁻³²⁴", "9·10⁻³²⁴"}) EXPECT_TRUE(has_text(small, tick)) << tick;
}

TEST(Plot, ALogarithmicAxisHasAsMuchRoomForEachPowerOfTen) {
  PlotOptions options;
  options.axis.logarithmic = true;
  const std::string svg =
      svg_plot(test::barcode_of({{0, 0, 1}, {0, 1, 100}, {0, 10, 100}}), options);
  for (const char* tick : {"1", "10", "100"}) EXPECT_TRUE(has_text(svg, tick)) << tick;
  // The second line begins at 1. The third line begins halfway along the axis.
  std::smatch lines;
  ASSERT_TRUE(std::regex_search(
      svg, lines,
      std::regex("<path d=\"M([0-9.]+) [0-9.]+H([0-9.]+)M([0-9.]+) [0-9.]+H([0-9.]+)M([0-9.]+) ")));
  const double begin = std::stod(lines[3]), end = std::stod(lines[4]), middle = std::stod(lines[5]);
  EXPECT_EQ(std::stod(lines[1]), begin);
  EXPECT_NEAR(middle, (begin + end) / 2, 0.02);
}

TEST(Plot, NegatedValuesFallFromLeftToRight) {
  PlotOptions options;
  options.negated = true;
  const auto texts = texts_of(svg_plot(test::barcode_of({{0, -4, -1}, {0, -4, 0}}), options));
  std::vector<double> ticks;
  for (const std::string& text : texts)
    if (text.size() == 1 && std::isdigit(static_cast<unsigned char>(text[0])) && text != "2")
      ticks.push_back(std::stod(text));
  ASSERT_GE(ticks.size(), 3u);
  EXPECT_EQ(ticks.front(), 4);
  EXPECT_TRUE(std::ranges::is_sorted(ticks, std::greater<>()));
  for (const std::string& text : texts) EXPECT_FALSE(text.starts_with("−")) << text;
}

TEST(Plot, TheAxisOfNegatedValuesIsOfTheDataSOwn) {
  PlotOptions options;
  options.negated = true;
  options.axis = {10.0, 50.0, false};
  const Barcode barcode =
      test::barcode_of({{0, -50, kInfinity}, {0, -30, -20}, {0, -9, -5}, {0, -60, -55}});
  for (const PlotKind kind : test::kPlotKinds) {
    options.kind = kind;
    const std::string svg = svg_plot(barcode, options);
    EXPECT_TRUE(has_text(svg, "2 beyond"));
    EXPECT_TRUE(has_text(svg, "50") && has_text(svg, "10"));
  }
  const std::vector<Branch> tree{{-50, kInfinity, -1}, {-30, -20, 0}, {-9, -5, 0}};
  EXPECT_TRUE(has_text(svg_plot(tree, options), "1 beyond"));
  options.axis = {-1.0, 50.0, true};
  EXPECT_THROW(svg_plot(barcode, options), Error);
}

TEST(Plot, ALogarithmicAxisOfLessThanADecadeHasRoundValues) {
  PlotOptions options;
  options.axis.logarithmic = true;
  for (const bool negated : {false, true}) {
    options.negated = negated;
    const auto svg_of = [&](double birth, double death) {
      return svg_plot(test::barcode_of({negated ? Bar{0, -death, -birth} : Bar{0, birth, death}}),
                      options);
    };
    for (const char* tick : {"0.0025", "0.0030", "0.0035", "0.0040"})
      EXPECT_TRUE(has_text(svg_of(0.0021, 0.0042), tick)) << tick;
    for (const char* tick : {"0.007", "0.008", "0.009"})
      EXPECT_TRUE(has_text(svg_of(0.0061, 0.0094), tick)) << tick;
    for (const char* tick : {"3.2·10⁻¹⁰", "3.8·10⁻¹⁰"})
      EXPECT_TRUE(has_text(svg_of(3.1e-10, 3.9e-10), tick)) << tick;
    for (const char* tick : {"3.2·10¹⁰", "3.8·10¹⁰"})
      EXPECT_TRUE(has_text(svg_of(3.1e10, 3.9e10), tick)) << tick;
  }
}

TEST(Plot, ALogarithmicAxisOfNegatedValuesFalls) {
  PlotOptions options;
  options.negated = true;
  options.axis.logarithmic = true;
  const std::string svg =
      svg_plot(test::barcode_of({{0, -100, -1}, {0, -10, -1}, {0, -10, 5}}), options);
  std::vector<std::string> ticks;
  for (const std::string& text : texts_of(svg))
    if (text == "1" || text == "10" || text == "100") ticks.push_back(text);
  EXPECT_EQ(ticks.size(), 3U);
  // The first line is as long as the axis, and the other lines begin halfway along it. The value 5
  // itself has no tick.
  std::smatch lines;
  ASSERT_TRUE(std::regex_search(svg, lines,
                                std::regex("<path d=\"M([0-9.]+) [0-9.]+H([0-9.]+)M([0-9.]+) "
                                           "[0-9.]+H([0-9.]+)M([0-9.]+) [0-9.]+H([0-9.]+)")));
  std::vector<std::pair<double, double>> ends;
  for (const std::size_t i : {1U, 3U, 5U})
    ends.emplace_back(std::stod(lines[i]), std::stod(lines[i + 1]));
  std::ranges::sort(ends);
  const auto [begin, end] = ends[0];
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_NEAR(ends[i].first, (begin + end) / 2, 0.02);
    EXPECT_NEAR(ends[i].second, end, 0.02);
  }
}

TEST(Plot, ASizeIsThatOfThePicture) {
  PlotOptions options;
  const Barcode barcode = test::barcode_of({{0, 0, 1}});
  for (const PlotSize size : {PlotSize{640, 480}, PlotSize{100, 900}}) {
    options.size = size;
    const std::string svg = svg_plot(barcode, options);
    std::smatch found;
    ASSERT_TRUE(std::regex_search(
        svg, found,
        std::regex("width=\"(\\d+)\" height=\"(\\d+)\" viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
    EXPECT_EQ(std::stoi(found[1]), size.width);
    EXPECT_EQ(std::stoi(found[2]), size.height);
    EXPECT_NEAR(std::stod(found[3]) / std::stod(found[4]), 1.0 * size.width / size.height, 1e-3);
  }
  options.size = {0, 480};
  EXPECT_THROW(svg_plot(barcode, options), Error);
}

TEST(TreePlot, OneClassBeginsAtItsBirth) {
  const std::vector<Branch> tree{{-3, kInfinity, -1}};
  const std::string svg = svg_plot(tree);
  EXPECT_TRUE(has_text(svg, "−3.0"));
  EXPECT_FALSE(has_text(svg, "−4.0"));
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
      // The branch joins a branch that is older and lives longer.
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

/// The numbers of each line in path data. A line is drawn by the command 'M', followed by 'V' or
/// 'H'.
std::vector<std::array<double, 3>> lines_of(const std::string& svg, char end) {
  const std::regex line(std::string("M([0-9.]+) ([0-9.]+)") + end + "([0-9.]+)");
  std::vector<std::array<double, 3>> lines;
  for (std::sregex_iterator i(svg.begin(), svg.end(), line), last; i != last; ++i)
    lines.push_back({std::stod((*i)[1]), std::stod((*i)[2]), std::stod((*i)[3])});
  return lines;
}

TEST(TreePlot, LinesMeetAndDoNotCross) {
  // Branch 0 never dies. Branch 1 joins it, 2 and 3 join 1, and 4 is the last branch that joins 0.
  // Branch 5 joins none of them.
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
