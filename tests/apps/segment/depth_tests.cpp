// SPDX-License-Identifier: MIT
// Depth images in all formats, and cameras given by file or by name, as inputs of ph-segment.
#include <gtest/gtest.h>

#include <cmath>

#include "ph/detail/io/png.hpp"
#include "tests/apps/segment/program_fixture.hpp"

namespace ph::segment {
namespace {

class DepthImages : public test::Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    Raster depth{scene_.kWidth, scene_.kHeight, 1, 16, {}};
    std::string pgm = "P5 320 240 65535\n", floats, whole;
    for (std::size_t i = 0; i < scene_.truth().size(); ++i) {
      const float z = scene_.xyz()[3 * i + 2];
      const auto units = static_cast<std::uint16_t>(std::isnan(z) ? 0 : std::lround(z * 1000));
      depth.samples.push_back(units);
      pgm += static_cast<char>(units >> 8);
      pgm += static_cast<char>(units & 0xFF);
      add(floats, units == 0 ? std::nanf("") : static_cast<float>(units / 1000.0));
      add(whole, static_cast<std::int32_t>(units));
    }
    std::ofstream png(at("d.png"), std::ios::binary);
    write_png(png, depth);
    write("d.pgm", pgm);
    write("f.npy", npy("<f4", floats));
    write("i.npy", npy("<i4", whole));
    write("small.npy", npy("<f4", floats.substr(0, floats.size() / 2), "(120, 320)"));
  }
  template <class T>
  static void add(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  static std::string npy(const std::string& type, const std::string& data,
                         const std::string& shape = "(240, 320)") {
    const std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + "}\n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
           data;
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(at(name), std::ios::binary) << bytes;
  }
  /// Writes a camera_info file with the scene's camera, for an image that has `times` as many
  /// pixels along each axis.
  void write_camera(const std::string& name, int times, const std::string& d = "0, 0, 0, 0, 0",
                    const std::string& model = "plumb_bob", int more_rows = 0) const {
    const auto text = [](double x) { return std::to_string(x); };
    write(name, "image_width: " + std::to_string(320 * times) +
                    "\nimage_height: " + std::to_string(240 * times + more_rows) +
                    "\ncamera_matrix: {rows: 3, cols: 3}\nK: [" + text(260 * times) + ", 0, " +
                    text(160 * times - 0.5) + ", 0, " + text(260 * times) + ", " +
                    text(120 * times - 0.5) + ", 0, 0, 1]\ndistortion_model: " + model + "\nD: [" +
                    d + "]\n");
  }
  bool notes(const std::string& text) const { return err().find(text) != std::string::npos; }
  std::string labels(const std::string& arguments) {
    EXPECT_EQ(run(arguments + " --labels l.npy"), 0) << arguments << ": " << err();
    return contents(at("l.npy"));
  }

  const std::string intrinsics_ = " --intrinsics 260,260,159.5,119.5";
};

TEST_F(DepthImages, AreTheSameInAllFormats) {
  const std::string expected = labels("d.png" + intrinsics_);
  EXPECT_TRUE(notes("2 segments")) << err();
  for (const char* input : {"d.pgm", "i.npy", "--depth d.pgm", "--depth i.npy"})
    EXPECT_EQ(labels(input + intrinsics_), expected) << input;
  // As floats, the depths are rounded and therefore slightly different.
  const std::string of_floats = labels("f.npy" + intrinsics_);
  EXPECT_TRUE(notes("2 segments")) << err();
  EXPECT_EQ(labels("f.npy --depth-scale 1" + intrinsics_), of_floats);
  EXPECT_EQ(run("f.npy --depth-scale 1000" + intrinsics_), 0);
  EXPECT_TRUE(notes("all points are within 0.00")) << err();
  EXPECT_EQ(run("--depth scene.pcd" + intrinsics_), 65);
  EXPECT_TRUE(notes("scene.pcd: not a depth image")) << err();
  EXPECT_EQ(run("f.npy"), 65);  // without a camera, this is no cloud
  EXPECT_TRUE(notes("--camera or --intrinsics")) << err();
  EXPECT_EQ(run("d.pgm"), 64);
  EXPECT_EQ(run("--depth small.npy --color d.png" + intrinsics_), 65);
  EXPECT_TRUE(notes("d.png: colour image: found 320 x 240 pixels, expected 320 x 120")) << err();
}

TEST_F(DepthImages, CamerasByFile) {
  write_camera("c.yaml", 1);
  write_camera("twice.yaml", 2);
  write_camera("other.yaml", 1, "0, 0, 0, 0, 0", "plumb_bob", 8);
  write_camera("lens.yaml", 1, "0.1, 0, 0, 0, 0");
  write_camera("odd.yaml", 1, "0.1, 0, 0, 0, 0", "odd");
  write("c.json",
        "{\"width\": 320, \"height\": 240, \"intrinsic_matrix\": [260, 0, 0, 0, 260, 0, "
        "159.5, 119.5, 1]}");
  const std::string expected = labels("d.png" + intrinsics_);
  EXPECT_EQ(labels("d.png --camera c.yaml"), expected);
  EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << err();
  EXPECT_EQ(labels("d.png --camera c.json"), expected);
  EXPECT_EQ(labels("--depth d.png --camera twice.yaml"), expected);
  EXPECT_TRUE(
      notes("calibrated for 640 x 480 pixels; for 320 x 240 it is scaled to --intrinsics "
            "260,260,159.5,119.5"))
      << err();
  EXPECT_NE(labels("d.png --camera lens.yaml"), expected);
  EXPECT_TRUE(notes("assumed to be raw, and the distortion of the lens is corrected")) << err();
  EXPECT_FALSE(notes("rays")) << err();
  EXPECT_EQ(run("d.png --camera other.yaml"), 64);
  EXPECT_TRUE(
      notes("--camera other.yaml: found an image of 320 x 240 pixels, expected 320 "
            "x 248"))
      << err();
  EXPECT_EQ(run("d.png --camera odd.yaml"), 65);
  EXPECT_TRUE(notes("odd.yaml:5:1: lens model, found \"odd\"")) << err();
  EXPECT_EQ(run("d.png --camera missing.yaml"), 66);
  EXPECT_FALSE(notes("--intrinsics")) << err();
  EXPECT_EQ(run("d.png --camera 260,260,159.5,119.5"), 66);
  EXPECT_TRUE(notes("; --intrinsics takes numbers")) << err();
  EXPECT_EQ(run("d.png --intrinsics c.yaml"), 64);
  EXPECT_TRUE(
      notes("--intrinsics: found 'c.yaml', expected numbers separated by commas; --camera "
            "takes a file or the name of a camera"))
      << err();
  EXPECT_EQ(run("d.png --camera c.yaml" + intrinsics_), 64);
  EXPECT_EQ(run("scene.pcd --camera c.yaml"), 64);
  EXPECT_TRUE(
      notes("--camera: found scene.pcd, expected a depth image, .png, .pgm or .npy; --depth"))
      << err();
}

TEST_F(DepthImages, CamerasByName) {
  ASSERT_EQ(run("d.png --camera kinect-v1"), 0) << err();
  EXPECT_TRUE(notes("nominal values for depth registered to the colour camera")) << err();
  EXPECT_TRUE(notes("--intrinsics 262.5,262.5,159.5,119.5")) << err();
  // Steps of whole millimetres divide one of the two boxes at an edge.
  EXPECT_TRUE(notes("3 segments")) << err();
  EXPECT_EQ(run("d.png --camera kinect-v2"), 64);
}

TEST_F(DepthImages, AFolderHasThemWithoutArrays) {
  std::filesystem::create_directory(at("frames"));
  for (const char* name : {"d.png", "d.pgm", "i.npy"})
    std::filesystem::copy(at(name), at(std::string("frames/") + name));
  write_camera("c.yaml", 1);
  ASSERT_EQ(run("frames --camera c.yaml --json j.jsonl --labels out/"), 0) << err();
  EXPECT_TRUE(notes("2 frames in")) << err();
}

}  // namespace
}  // namespace ph::segment
