// SPDX-License-Identifier: MIT
// The notes of ph-segment, which warn of lengths or cameras that the user cannot have meant, and of
// options without an effect.
#include <gtest/gtest.h>

#include <cmath>

#include "ph/detail/io/png.hpp"
#include "tests/apps/segment/program_fixture.hpp"

namespace ph::segment {
namespace {

class Notes : public test::Program {
 protected:
  void write_scaled(const std::string& name, double factor) {
    std::vector<float> xyz = scene_.xyz();
    for (float& x : xyz) x = static_cast<float>(x * factor);
    write_cloud(at(name), test::cloud_of(xyz, scene_.kWidth, scene_.kHeight));
  }
  /// Writes the depth image in this unit. By default, it is in millimetres.
  void write_depth(double units_per_metre = 1000) {
    Raster depth{scene_.kWidth, scene_.kHeight, 1, 16, {}};
    for (std::size_t i = 0; i < scene_.truth().size(); ++i) {
      const float z = scene_.xyz()[3 * i + 2];
      depth.samples.push_back(
          static_cast<std::uint16_t>(std::isnan(z) ? 0 : std::lround(z * units_per_metre)));
    }
    std::ofstream file(at("d.png"), std::ios::binary);
    write_png(file, depth);
  }
  bool notes(const std::string& text) const { return err().find(text) != std::string::npos; }
};

TEST_F(Notes, MillimetresAndMetres) {
  write_scaled("mm.pcd", 1000);
  EXPECT_EQ(run("mm.pcd"), 0);
  EXPECT_TRUE(notes("no point within 2 m of the viewpoint, the nearest is at 7")) << err();
  EXPECT_TRUE(notes("are these millimetres? if they are, --depth-scale 1000")) << err();
  EXPECT_EQ(std::ranges::count(err(), '\n'), 2) << "one note and the summary: " << err();
  EXPECT_EQ(run("scene.pcd --json m.json"), 0);
  EXPECT_EQ(run("mm.pcd --depth-scale 1000 --json mm.json"), 0);
  EXPECT_TRUE(notes("2 segments")) << err();
  EXPECT_FALSE(notes("are these")) << err();
  write_scaled("cm.pcd", 100);
  EXPECT_EQ(run("cm.pcd"), 0);
  EXPECT_TRUE(notes("are these centimetres? if they are, --depth-scale 100\n")) << err();
  // A hole at the origin is in range.
  std::vector<float> xyz = scene_.xyz();
  for (float& x : xyz) x = std::isnan(x) ? 0 : 1000 * x;
  write_cloud(at("zeros.pcd"), test::cloud_of(xyz, scene_.kWidth, scene_.kHeight));
  EXPECT_EQ(run("zeros.pcd"), 0);
  EXPECT_TRUE(notes("half of the points are more than")) << err();
  write_scaled("km.pcd", 0.001);
  EXPECT_EQ(run("km.pcd"), 0);
  EXPECT_TRUE(notes("all points are within 0.00")) << err();
  EXPECT_EQ(run("scene.pcd --max-range 0.1"), 0);
  EXPECT_TRUE(notes("see --max-range")) << err();
}

TEST_F(Notes, MostOfTheSceneIsOutOfRange) {
  std::vector<float> xyz = scene_.xyz();
  const std::size_t first = 120 * 3 * scene_.kWidth, last = first + 15 * 3 * scene_.kWidth;
  for (std::size_t i = 0; i < xyz.size(); ++i)
    if (i < first || i >= last) xyz[i] *= 4;
  write_cloud(at("far.pcd"), test::cloud_of(xyz, scene_.kWidth, scene_.kHeight));
  EXPECT_EQ(run("far.pcd"), 0);
  EXPECT_TRUE(notes("points are within 2 m of the viewpoint; see --max-range")) << err();
  EXPECT_EQ(run("far.pcd --max-range inf"), 0);
  EXPECT_FALSE(notes("see --max-range")) << err();
}

TEST_F(Notes, DepthImages) {
  write_depth();
  const std::string camera = "--intrinsics 260,260,159.5,119.5";
  ASSERT_EQ(run("--depth d.png " + camera), 0) << err();
  EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << err();
  ASSERT_EQ(run("d.png " + camera), 0) << err();  // recognised without --depth
  EXPECT_TRUE(notes("2 segments")) << err();
  ASSERT_EQ(run("d.png --depth-scale 200 " + camera), 0);
  EXPECT_TRUE(notes("see --max-range; if that distance is wrong, see --depth-scale")) << err();
  EXPECT_EQ(run("d.png --depth-scale 0.00025 " + camera), 64);
  EXPECT_TRUE(notes("if a unit is 0.00025 m, the scale is 4000")) << err();
  for (const char* part : {"kinect-v", "d435", "xtoin"}) {
    EXPECT_EQ(run(std::string("d.png --camera ") + part), 66);
    EXPECT_TRUE(notes("did you mean '")) << err();
    EXPECT_TRUE(notes("realsense-d415, realsense-d435")) << err();
  }
  EXPECT_EQ(run("d.png --camera no.yaml"), 66);
  EXPECT_FALSE(notes("did you mean")) << err();
  ASSERT_EQ(run("d.png --depth-scale 1 " + camera), 0);
  EXPECT_TRUE(notes("see --depth-scale: are these millimetres?")) << err();
  ASSERT_EQ(run("d.png --depth-scale 1000000 " + camera), 0);
  EXPECT_TRUE(notes("see --depth-scale")) << err();
  for (const char* absurd : {"0.26,0.26,159.5,119.5", "260000,260000,159.5,119.5"}) {
    ASSERT_EQ(run(std::string("d.png --intrinsics ") + absurd), 0) << err();
    EXPECT_TRUE(notes("--intrinsics: a field of view of")) << err();
  }
  ASSERT_EQ(run("d.png --intrinsics 260,260,1595,119.5"), 0) << err();
  EXPECT_TRUE(notes("the principal point 1595, 119.5 is outside")) << err();
  EXPECT_EQ(run("d.png"), 64);
  EXPECT_EQ(run("scene.pcd " + camera), 64);
  write_depth(100);  // as in a picture of the depth
  ASSERT_EQ(run("d.png " + camera), 0);
  EXPECT_TRUE(notes("no depth is above 255")) << err();
  ASSERT_EQ(run("d.png --depth-scale 100 " + camera), 0);
  EXPECT_FALSE(notes("no depth is above 255")) << err();
}

/// Uses the coordinates of a robot: z points up, and the table is at 0.75 m.
TEST_F(Notes, AnotherFrame) {
  const double c = std::sqrt(0.5);
  const std::vector<float>& xyz = scene_.xyz();
  std::vector<float> moved, dense;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double x = xyz[i], y = xyz[i + 1], z = xyz[i + 2];
    for (const double p : {c * (z - y) - c + 0.8, -x, -c * (z + y) + c + 0.75})
      moved.push_back(static_cast<float>(p));
    if (!std::isnan(x)) dense.insert(dense.end(), moved.end() - 3, moved.end());
  }
  const std::string sensor = "0.093,0.000,1.457";
  write_cloud(at("base.pcd"), test::cloud_of(moved, scene_.kWidth, scene_.kHeight));
  ASSERT_EQ(run("base.pcd --json base.json"), 0) << err();
  EXPECT_TRUE(
      notes("the rays of the pixels do not meet at the viewpoint of the input but at " + sensor))
      << err();
  EXPECT_TRUE(notes("2 segments")) << err();
  EXPECT_NE(contents(at("base.json")).find("\"viewpoint\": [0.0928"), std::string::npos)
      << contents(at("base.json"));
  ASSERT_EQ(run("base.pcd --viewpoint " + sensor), 0) << err();
  EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << err();
  ASSERT_EQ(run("base.pcd --viewpoint 0,0,0"), 0) << err();
  EXPECT_TRUE(
      notes("--viewpoint: found 0.000,0.000,0.000, but the rays of the pixels meet at " + sensor))
      << err();

  const auto points = static_cast<Index>(dense.size() / 3);
  write_cloud(at("dense.pcd"), test::cloud_of(dense, points, 1));
  ASSERT_EQ(run("dense.pcd"), 0) << err();
  EXPECT_TRUE(
      notes("as seen from 0.000,0.000,0.000: are the points and the viewpoint in different frames? "
            "see --viewpoint"))
      << err();
  ASSERT_EQ(run("dense.pcd --viewpoint " + sensor), 0) << err();
  EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << err();
  EXPECT_TRUE(notes("2 segments")) << err();
}

/// The pipeline uses only one thread, but signatures use several threads.
TEST_F(Notes, ThreadsAreForSignatures) {
  ASSERT_EQ(run("scene.pcd --threads 2 --json a.json"), 0) << err();
  EXPECT_TRUE(notes("--threads does nothing: ")) << err();
  ASSERT_EQ(run("scene.pcd scene.pcd --threads 2 --json a.json"), 0) << err();
  EXPECT_EQ(err().find("--threads does nothing: "), err().rfind("--threads")) << err();
  ASSERT_EQ(run("scene.pcd --threads 2 --json a.json --signatures"), 0) << err();
  EXPECT_FALSE(notes("--threads")) << err();
}

TEST_F(Notes, ColoursThatNoOutputShows) {
  write_depth();
  const Raster grey{scene_.kWidth, scene_.kHeight, 1, 8,
                    std::vector<std::uint16_t>(scene_.truth().size(), 90)};
  std::ofstream file(at("c.png"), std::ios::binary);
  write_png(file, grey);
  file.close();
  const std::string depth = "--depth d.png --color c.png --intrinsics 260,260,159.5,119.5 ";
  for (const char* outputs : {"", "--explain 1,2", "--labels l.npy --tree t.tree --json j.json",
                              "--plot p.svg --barcode b.csv"}) {
    ASSERT_EQ(run(depth + outputs), 0) << err();
    EXPECT_TRUE(notes("--color does nothing: no output shows colours")) << outputs << err();
  }
  for (const char* outputs : {"-o o.pcd", "--picture p.png", "--coloured c.pcd"}) {
    ASSERT_EQ(run(depth + outputs), 0) << err();
    EXPECT_FALSE(notes("--color")) << outputs << err();
  }
}

TEST_F(Notes, StableLabelsThatNoOutputShows) {
  std::filesystem::copy_file(at("scene.pcd"), at("next.pcd"));
  ASSERT_EQ(run("scene.pcd next.pcd --stable-labels --barcode b/ --tree b/"), 0) << err();
  EXPECT_TRUE(notes("--stable-labels does nothing: no output shows labels")) << err();
  ASSERT_EQ(run("scene.pcd next.pcd --stable-labels --barcode b/ --labels l/"), 0) << err();
  EXPECT_FALSE(notes("--stable-labels")) << err();
}

TEST_F(Notes, TheSmallerMarginOfThePlaneGoesFirst) {
  ASSERT_EQ(run("scene.pcd --plane-distance 0.001 --plane-noise 0.004"), 0) << err();
  EXPECT_TRUE(notes("--plane-noise does nothing: --plane-distance 0.001 is smaller")) << err();
  for (const char* options : {"--plane-distance 0.001", "--plane-noise 0.004",
                              "--plane-distance 0.005 --plane-noise 0.004"}) {
    ASSERT_EQ(run(std::string("scene.pcd ") + options), 0) << err();
    EXPECT_FALSE(notes("does nothing")) << options << err();
  }
}

/// The message names only options of the chosen method. The option --distance belongs to method
/// paper, and is refused by the other methods.
TEST_F(Notes, OutOfMemoryNamesOptionsOfTheMethod) {
  for (const char* method : {"surface", "supervoxels", "paper"}) {
    const std::string options = std::string("scene.pcd --plane off --voxel 0.0005 --method ") +
                                method + " --memory-limit 12MB --distance 2";
    const bool is_paper = method == std::string("paper");
    ASSERT_EQ(run(is_paper ? options : options.substr(0, options.rfind(" --distance"))), 75)
        << err();
    EXPECT_EQ(notes("--distance"), is_paper) << err();
    EXPECT_TRUE(notes("--max-range, enlarge --voxel, or raise --memory-limit")) << err();
  }
}

TEST_F(Notes, ThreadsChangeNoByte) {
  ASSERT_EQ(run("scene.pcd --threads 1 --labels a.npy --tree a.tree"), 0) << err();
  ASSERT_EQ(run("scene.pcd --threads 4 --labels b.npy --tree b.tree"), 0) << err();
  EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
  EXPECT_EQ(contents(at("a.tree")), contents(at("b.tree")));
}

}  // namespace
}  // namespace ph::segment
