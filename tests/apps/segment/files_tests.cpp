// SPDX-License-Identifier: MIT
// The files that ph-segment reads and writes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <utility>

#include "ph/detail/io/png.hpp"
#include "ph/io/plot.hpp"
#include "tests/apps/segment/program_fixture.hpp"

namespace ph::segment {
namespace {

namespace fs = std::filesystem;
using test::Program;

TEST_F(Program, PrintsATableByDefault) {
  EXPECT_EQ(run("scene.pcd"), 0) << err();
  const std::string table = out();
  EXPECT_EQ(std::ranges::count(table, '\n'), 3) << table;
  EXPECT_NE(err().find("2 segments, checked"), std::string::npos) << err();
  EXPECT_EQ(run("scene.pcd --quiet"), 0);
  EXPECT_EQ(err(), "");
}

TEST_F(Program, NamesAWayOutForOtherFiles) {
  const std::pair<const char*, const char*> cases[] = {
      {"solid a\nfacet normal 0 0 1\nouter loop\n", "found an STL mesh, .*; convert it to PLY"},
      {"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a mesh, found OFF, .*; convert it to PLY"},
      {"\x01\x02\x03\x04", "a control character, .*; numpy.save writes numbers without a header"},
      {"\xCD\xCC\x4C\x3E\x01\x7F", "numpy.save writes numbers without a header as NPY"}};
  for (const auto& [content, words] : cases) {
    std::ofstream(at("other.raw"), std::ios::binary) << content;
    EXPECT_EQ(run("other.raw"), 65) << words;
    EXPECT_TRUE(std::regex_search(err(), std::regex(words))) << err();
  }
}

TEST_F(Program, WritesEverything) {
  ASSERT_EQ(run("scene.pcd -o out.pcd --labels l.npy --json s.json --barcode b.csv --plot p.svg "
                "--coloured c.ply --picture i.png"),
            0)
      << err();
  EXPECT_EQ(out(), "");
  const Cloud cloud = read_cloud(at("out.pcd"));
  EXPECT_EQ(cloud.width, scene_.kWidth);
  EXPECT_EQ(cloud.height, scene_.kHeight);
  ASSERT_TRUE(cloud.find("label"));
  EXPECT_EQ(cloud.fields.size(), 4U);
  EXPECT_EQ(contents(at("l.npy")).substr(1, 5), "NUMPY");
  const std::string json = contents(at("s.json"));
  for (const char* key :
       {"\"format\": \"ph-segment\"", "\"stages\"", "\"edges\"", "\"segments\"", "\"table\"",
        "\"centroid\"", "\"persistence\": null", "\"equal\": true"}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
  EXPECT_EQ(contents(at("b.csv")).substr(0, 16), "dim,birth,death\n");
  EXPECT_NE(contents(at("p.svg")).find("<svg"), std::string::npos);
  EXPECT_EQ(read_cloud(at("c.ply")).size(), cloud.size());
  const Raster picture = read_png(at("i.png"));
  EXPECT_EQ(picture.width, scene_.kWidth);
  EXPECT_EQ(picture.channels, 3);
}

TEST_F(Program, DrawsEveryKindOfPlot) {
  if (png_plot_support().empty()) GTEST_SKIP() << "PNG plots are not built in";
  ASSERT_EQ(run("scene.pcd --plot b.svg --plot t.svg --plot c.png --plot d.svg --plot-kind barcode "
                "--plot-kind tree --plot-kind cloud --plot-kind diagram --tree s.tree"),
            0)
      << err();
  EXPECT_NE(contents(at("b.svg")).find("<title>Barcode"), std::string::npos);
  EXPECT_NE(contents(at("t.svg")).find("<title>Merge tree"), std::string::npos);
  EXPECT_NE(contents(at("d.svg")).find("<title>Persistence diagram"), std::string::npos);
  EXPECT_EQ(read_png(at("c.png")).channels, 3);
  ASSERT_EQ(run("s.tree --plot s.png --plot-kind cloud"), 0) << err();
  ASSERT_EQ(run("s.tree --plot v.png --plot-kind cloud --plot-view=-30,20"), 0) << err();
  EXPECT_NE(contents(at("s.png")), contents(at("v.png")));
  fs::copy(at("scene.pcd"), at("again.pcd"));
  ASSERT_EQ(run("scene.pcd again.pcd --plot plots/ --plot 'plots/*.png' --plot-kind tree "
                "--plot-kind cloud"),
            0)
      << err();
  EXPECT_EQ(contents(at("plots/again.svg")), contents(at("t.svg")));
  EXPECT_EQ(contents(at("plots/again.png")), contents(at("c.png")));
}

TEST_F(Program, DrawsEveryKindOfPlotAsPng) {
  if (png_plot_support().empty()) {
    EXPECT_EQ(run("missing.pcd --plot p.png"), 69);
    EXPECT_NE(err().find("PNG plots are not built in; use .svg"), std::string::npos) << err();
    GTEST_SKIP() << "PNG plots are not built in, and refused";
  }
  std::vector<std::string> files;
  for (const char* kind : {"barcode", "diagram", "betti", "tree", "cloud"}) {
    ASSERT_EQ(run(fmt::format("scene.pcd --plot p.png --plot q.PNG --plot-kind {}", kind)), 0)
        << err();
    EXPECT_EQ(contents(at("p.png")), contents(at("q.PNG"))) << kind;
    const Raster raster = read_png(at("p.png"));
    EXPECT_EQ(raster.width, 1040) << kind;
    EXPECT_EQ(raster.channels, 3) << kind;
    const auto [dark, light] = std::ranges::minmax(raster.samples);
    EXPECT_EQ(light, 255) << kind;
    EXPECT_LE(dark, 0x22) << kind;
    EXPECT_EQ(std::ranges::count(files, contents(at("p.png"))), 0) << kind;
    files.push_back(contents(at("p.png")));
  }
  EXPECT_EQ(run("scene.pcd --plot missing/p.png"), 73);
}

TEST_F(Program, ACloudHasALegend) {
  ASSERT_EQ(run("scene.pcd --plot c.svg --plot-kind cloud --labels l.csv"), 0) << err();
  std::string svg = contents(at("c.svg"));
  EXPECT_NE(svg.find("href=\"data:image/png;base64,"), std::string::npos);
  EXPECT_LT(svg.size(), 1'000'000U);
  std::istringstream labels(contents(at("l.csv")));
  std::map<int, int> points;
  for (int label = 0; labels >> label;) ++points[label];
  ASSERT_EQ(points.size(), 3U);
  // Each number is written twice: in the picture and below it.
  for (const char* number : {">1</text>", ">2</text>"}) {
    const std::size_t first = svg.find(number);
    ASSERT_NE(first, std::string::npos) << number;
    EXPECT_NE(svg.find(number, first + 1), std::string::npos) << number;
  }
  EXPECT_NE(svg.find(">none</text>"), std::string::npos);
  std::erase(svg, ',');
  for (const int label : {1, 2})
    EXPECT_NE(svg.find(fmt::format(">{}</text>", points[label])), std::string::npos);
}

TEST_F(Program, LabelsAreTheSameInEveryFormat) {
  ASSERT_EQ(run("scene.pcd --labels l.csv"), 0) << err();
  ASSERT_EQ(run("scene.pcd --labels l.png"), 0) << err();
  const Segmentation s = segment(CloudView{scene_.xyz(), {}});
  std::istringstream csv(contents(at("l.csv")));
  const Raster png = read_png(at("l.png"));
  ASSERT_EQ(png.samples.size(), s.cut.labels.size());
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    std::uint32_t label = 99;
    ASSERT_TRUE(csv >> label);
    ASSERT_EQ(label, s.cut.labels[i]);
    ASSERT_EQ(png.samples[i], s.cut.labels[i]);
  }
}

TEST_F(Program, StandardInputAndOutput) {
  EXPECT_EQ(run("- -o - <scene.pcd"), 0) << err();
  std::ofstream(at("copy.pcd"), std::ios::binary) << out();
  EXPECT_TRUE(read_cloud(at("copy.pcd")).find("label"));
  EXPECT_EQ(run("scene.pcd --json - --quiet"), 0);
  EXPECT_EQ(out().front(), '{');
}

TEST_F(Program, ItsOutputIsAnInput) {
  const std::string before = contents(at("scene.pcd"));
  EXPECT_EQ(run("scene.pcd -o scene.pcd"), 64);
  EXPECT_EQ(contents(at("scene.pcd")), before);
  ASSERT_EQ(run("scene.pcd -o scene.pcd --force"), 0) << err();
  ASSERT_EQ(run("scene.pcd -o scene.ply"), 0) << err();
  const Cloud cloud = read_cloud(at("scene.ply"));
  EXPECT_TRUE(cloud.find("label_in"));
  EXPECT_TRUE(cloud.find("label"));
}

TEST_F(Program, DepthImage) {
  Raster depth{scene_.kWidth, scene_.kHeight, 1, 16, {}};
  for (std::size_t i = 0; i < scene_.truth().size(); ++i) {
    const float z = scene_.xyz()[3 * i + 2];
    depth.samples.push_back(std::isnan(z) ? std::uint16_t{0}
                                          : static_cast<std::uint16_t>(std::lround(z * 10000)));
  }
  Raster colour{scene_.kWidth, scene_.kHeight, 3, 8, {}};
  colour.samples.assign(depth.samples.size() * 3, 100);
  std::ofstream depth_file(at("d.png"), std::ios::binary), colour_file(at("c.png"));
  write_png(depth_file, depth);
  write_png(colour_file, colour);
  depth_file.close(), colour_file.close();
  ASSERT_EQ(run("--depth d.png --color c.png --intrinsics 260,260,159.5,119.5 "
                "--depth-scale 10000 -o out.pcd --picture i.png"),
            0)
      << err();
  EXPECT_NE(err().find("2 segments"), std::string::npos) << err();
  const Cloud cloud = read_cloud(at("out.pcd"));
  EXPECT_EQ(cloud.height, scene_.kHeight);
  EXPECT_TRUE(cloud.rgb());
}

TEST_F(Program, UnorganisedClouds) {
  std::ofstream text(at("points.xyz"));
  for (std::size_t i = 0; i < scene_.truth().size(); ++i) {
    if (scene_.truth()[i] < 0) continue;
    const float* p = &scene_.xyz()[3 * i];
    text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  text.close();
  EXPECT_EQ(run("points.xyz -o out.ply --coloured c.pcd"), 0) << err();
  EXPECT_NE(err().find("2 segments"), std::string::npos) << err();
  EXPECT_EQ(run("points.xyz --picture i.png"), 64);
  EXPECT_EQ(run("points.xyz --labels l.png"), 64);
  EXPECT_FALSE(fs::exists(at("i.png")));
}

TEST_F(Program, CloudsWithNothingInThem) {
  const std::vector<float> holes(3 * 12, test::kHole);
  std::ofstream file(at("holes.pcd"), std::ios::binary);
  write_pcd(file, test::cloud_of(holes, 4, 3));
  file.close();
  EXPECT_EQ(run("holes.pcd -o out.pcd --json s.json --plot p.svg --coloured c.pcd --picture i.png"),
            0)
      << err();
  EXPECT_NE(err().find("no point within"), std::string::npos) << err();
  EXPECT_EQ(read_cloud(at("out.pcd")).height, 3);
}

TEST_F(Program, NoPointsAtAll) {
  std::ofstream(at("none.xyz")) << "# nothing\n";
  EXPECT_EQ(run("none.xyz"), 65);
  EXPECT_NE(err().find("--allow-empty"), std::string::npos) << err();
  EXPECT_EQ(run("none.xyz --allow-empty -o out.ply --labels l.csv --json s.json"), 0) << err();
  EXPECT_EQ(contents(at("l.csv")), "");
}

}  // namespace
}  // namespace ph::segment
