// SPDX-License-Identifier: MIT
#include "ph/detail/io/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

/// A calibration file as written by ROS's camera_calibration.
std::string ros_file(const std::string& model, const std::string& coefficients) {
  return "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo\n"
         "camera_matrix:\n  rows: 3\n  cols: 3\n"
         "  data: [520.5, 0., 318.25, 0, 5.215e2, 241.5,\n         0, 0, 1]  # row by row\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [" + coefficients +
         "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
}

/// A calibration message as printed by `ros2 topic echo`.
const std::string kTopic =
    "header:\n  stamp:\n    sec: 1\n    nanosec: 5\n  frame_id: camera\nheight: 480\nwidth: 640\n"
    "distortion_model: plumb_bob\nd:\n- 0.0\n- 0.0\n- 0.0\n- 0.0\n- 0.0\nk:\n- 520.5\n- 0.0\n"
    "- 318.25\n- 0.0\n- 521.5\n- 241.5\n- 0.0\n- 0.0\n- 1.0\nr: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
    "binning_x: 0\nbinning_y: 0\nroi:\n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n"
    "  do_rectify: false\n---\n";

Camera camera_of(const std::string& text) { return read_camera(Input::view(text, "c.yaml")); }

void expect_usual(const Camera& c) {
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.intrinsics.fx, 520.5);
  EXPECT_EQ(c.intrinsics.fy, 521.5);
  EXPECT_EQ(c.intrinsics.cx, 318.25);
  EXPECT_EQ(c.intrinsics.cy, 241.5);
}

std::string replaced(std::string text, const std::string& old, const std::string& other) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, text.npos) << old;
  return text.replace(at, old.size(), other);
}

TEST(Camera, IsReadAsProgramsWriteIt) {
  const Camera file = camera_of(ros_file("plumb_bob", "0.1, -0.2, 0.001, 0.002, 0.05"));
  expect_usual(file);
  EXPECT_EQ(file.lens.model, Lens::Model::polynomial);
  EXPECT_EQ(file.lens.coefficients,
            (std::array<double, 8>{0.1, -0.2, 0.001, 0.002, 0.05, 0, 0, 0}));
  expect_usual(camera_of(ros_file("plumb_bob", "0, 0, 0, 0, 0")));
  EXPECT_EQ(camera_of(ros_file("whatever", "0, 0")).lens.model, Lens::Model::none);
  EXPECT_EQ(camera_of(ros_file("equidistant", "0.1,0,0,0")).lens.model, Lens::Model::equidistant);
  for (const std::string& text : {kTopic, kTopic + kTopic, replaced(kTopic, "k:\n", "K:\n"),
                                  replaced(kTopic, "header:", "---\nheader:")})
    expect_usual(camera_of(text));
  // Values that span several lines, mappings in braces, and colons within words are ignored.
  expect_usual(camera_of(replaced(
      kTopic, "height: 480",
      "by:  # whom\n  a:b: c\nnote: |\n  k: 1\n\n  width: 2\nmore: >-\n  d: 3\nroom: {k: 1}\n"
      "height: 480")));
  // The formats of ROS 1 and of OpenCV's FileStorage.
  expect_usual(
      camera_of("height: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\nD: [0.0, 0.0]\n"
                "K: [520.5, 0.0, 318.25, 0.0, 521.5, 241.5, 0.0, 0.0, 1.0]\n"));
  const Camera opencv = camera_of(
      "%YAML:1.0\r\n---\r\nimage_width: 640\r\nimage_height: 480\r\n"
      "camera_matrix: !!opencv-matrix\r\n   rows: 3\r\n   cols: 3\r\n   dt: d\r\n"
      "   data: [ 520.5, 0., 318.25, 0., 521.5, 241.5, 0., 0., 1. ]\r\n"
      "distortion_coefficients: !!opencv-matrix\r\n   rows: 5\r\n   cols: 1\r\n   dt: d\r\n"
      "   data: [ 0.1, 0., 0., 0., 0. ]\r\n");
  expect_usual(opencv);
  EXPECT_EQ(opencv.lens.model, Lens::Model::polynomial);
  // OpenCV also writes coefficients for thin prisms and tilted sensors.
  const auto rational = [](const std::string& more) {
    return replaced(ros_file("x", "0.3, -0.2, 0.001, 0, 0.1, 0.2, -0.1, 0.05" + more),
                    "distortion_model: x", "more: x");
  };
  for (const char* more : {", 0, 0, 0, 0", ", 0, 0, 0, 0, 0, 0"})
    EXPECT_EQ(camera_of(rational(more)).lens.coefficients,
              camera_of(rational("")).lens.coefficients);
  for (const char* more : {", 0, 0, 0, 1e-4", ", 0, 0, 0, 0, 0.1, 0"})
    EXPECT_TRUE(contains(bad_data([&] { camera_of(rational(more)); }),
                         "coefficients of rational_polynomial"));
  // OpenCV's calibration program marks a fisheye lens by a flag.
  const std::string four = ros_file("x", "0.05, -0.01, 0.002, -0.0005");
  const std::string unnamed = replaced(four, "distortion_model: x", "fisheye_model: 1");
  EXPECT_EQ(camera_of(unnamed).lens.model, Lens::Model::equidistant);
  EXPECT_EQ(camera_of(replaced(unnamed, "fisheye_model: 1", "fisheye_model: 0")).lens.model,
            Lens::Model::polynomial);
  EXPECT_EQ(camera_of(replaced(unnamed, "distortion_coefficients:", "D:")).lens.model,
            Lens::Model::equidistant);
  const std::string open3d =
      "{\"width\": 640, \"height\": 480, \"intrinsic_matrix\": [520.5, 0, 0, 0, 521.5, 0, 318.25, "
      "241.5, 1]}";
  expect_usual(camera_of(open3d));
  const std::string zeros = "width: 2\nheight: 2\nk: [1, 0, 1, 0, 1, 1, 0, 0, 1]\ndistortion: ";
  for (const char* distortion : {"0", "[0, +0.0, -0, 0e1]"})
    EXPECT_EQ(camera_of(zeros + distortion + "\n").lens.coefficients, (std::array<double, 8>{}));
  EXPECT_EQ(camera_of(open3d).depth_scale, 0);
  EXPECT_EQ(camera_of(replaced(open3d, "{", "{\"depth_scale\": 4000.0, ")).depth_scale, 4000);
  EXPECT_EQ(camera_of(replaced(open3d, "{", "{\"depth_scale\": 0.001, ")).depth_scale, 1000);
  EXPECT_EQ(camera_of(replaced(open3d, "{", "{\"depth_scale\": null, ")).depth_scale, 0);
  expect_usual(
      camera_of("{\"class_name\": \"PinholeCameraParameters\", \"extrinsic\": [1, 2],\n"
                " \"intrinsic\": " +
                open3d + "}"));
}

TEST(Camera, BinningAndRegionAreApplied) {
  std::string text = replaced(kTopic, "binning_x: 0", "binning_x: 2");
  text = replaced(text, "binning_y: 0", "binning_y: 2");
  text = replaced(text, "x_offset: 0", "x_offset: 40");
  text = replaced(text, "  height: 0", "  height: 400");
  text = replaced(text, "  width: 0", "  width: 600");
  const Camera c = camera_of(text);
  EXPECT_EQ(c.width, 300);
  EXPECT_EQ(c.height, 200);
  EXPECT_EQ(c.intrinsics.fx, 260.25);
  EXPECT_EQ(c.intrinsics.cx, (318.25 - 40) / 2);
  EXPECT_EQ(c.intrinsics.cy, 241.5 / 2);
}

TEST(Camera, FaultsNameTheirPlace) {
  const std::string good = ros_file("plumb_bob", "0.1, 0, 0, 0, 0");
  const struct {
    std::string text, message;
  } faults[] = {
      {replaced(good, "5.215e2", "5,21.5"), "c.yaml:7:3: camera matrix, found 10 numbers"},
      {replaced(good, "5.215e2", "abc"), "c.yaml:7:32: not a number, found \"abc\""},
      {replaced(good, "520.5", "0"), "c.yaml:7:3: focal lengths, found 0 and 521.5"},
      {replaced(good, "520.5, 0.", "520.5, 2"), "c.yaml:7:3: camera matrix, found 520.5, 2"},
      {replaced(good, "image_width: 640", "image_width: 6.5"), "c.yaml:1:14: not a number of pix"},
      {replaced(good, "image_width", "image_hight"), "c.yaml: no image_width"},
      {replaced(good, "image_width: 640", "image_width 640"), "c.yaml:1:1: not a key with a value"},
      {replaced(good, "image_height: 480", "image_width: 640"), "c.yaml:2:1: a repeated key"},
      {replaced(good, "plumb_bob", "odd"), "c.yaml:9:1: lens model, found \"odd\""},
      {replaced(good, "plumb_bob", "rational_polynomial"), "coefficients of rational_polynomial"},
      {"width: 2\nheight: 2\nk: [1, 0, 1, 0, 1, 1, 0, 0, 1]\ndistortion: plumb\n",
       "lens coefficients, found \"distortion\", expected distortion_coefficients"},
      {replaced(good, "distortion_coefficients", "dist_coeffs"),
       "lens coefficients, found \"dist_coeffs\", expected distortion_coefficients"},
      {"width: 2\nheight: 2\nk: [1, 0, 1, 0, 1, 1, 0, 0, 1]\ndistortion_model: fov\n",
       "c.yaml:4:1: lens model, found \"fov\""},
      {"{\"width\": 640, \"depth_scale\": -2}", "c.yaml:1:31: depth_scale, found -2"},
      {"{\"width\": 640, \"depth_scale\": 0}", "c.yaml:1:31: depth_scale, found 0"},
      {replaced(good, "1]  #", "1  #"), "not a number, found \"distortion_model: plumb_bob\""},
      {good + "more: [1, 2", "list without an end"},
      {good + "more: [1,, 2]\n", "empty element of a list"},
      {good + "more: &a 2\n", "anchor or alias"},
      {good + "more: {a: 2,\n", "mapping in braces"},
      {good + "more: [1, 2] 3\n", "text after a list, found \"3\""},
      {good + "\tmore: 2\n", "a tab before a key"},
      {"- 1\n", "c.yaml:1:1: list, found \"- 1\", expected a key before it"},
      {"", "c.yaml: no image_width"},
      {std::string("a\0b", 3), "not plain text"},
      {std::string(2 << 20, ' '), "found 2097152 bytes, expected at most 1048576"},
      {"{\"width\": 640}", "not a camera, found no intrinsic_matrix, cam_K or fx"},
      {"{\"intrinsic_matrix\": [9, 0, 0, 0, 9, 0, 4, 4, 1]}",
       "not an Open3D camera, found no width"},
      {"{\"width\": 640, \"height\": 480, \"intrinsic_matrix\": [1, 0, 3, 0, 1, 3, 0, 0, 1]}",
       "c.yaml:1:51: intrinsic_matrix, found [1, 0, 3"},
  };
  for (const auto& [text, message] : faults) {
    const std::string found = bad_data([&, t = text] { camera_of(t); });
    EXPECT_TRUE(contains(found, message)) << found;
  }
}

TEST(CameraFiles, ReadsFilesOfOtherPrograms) {
  const struct {
    const char* text;
    double fx, cx;
    Index width;
    double scale;
  } cases[] = {
      {R"({"fx": 525.5, "fy": 525, "ppx": 319.5, "ppy": 239.5, "height": 480, "width": 640,
           "depth_scale": 0.001, "model": "distortion.inverse_brown_conrady",
           "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0]})",
       525.5, 319.5, 640, 1000},
      {R"({"cx": 312.75, "cy": 241.25, "depth_scale": 0.1, "fx": 1066.75, "fy": 1067.5,
           "height": 480, "width": 640})",
       1066.75, 312.75, 640, 10000},
      {R"({"fx": 600, "fy": 600, "cx": 320, "cy": 240, "depth_scale": 5000})", 600, 320, 0, 5000},
      {R"({"0": {"cam_K": [572.5, 0.0, 325.25, 0.0, 573.5, 242, 0.0, 0.0, 1.0],
                 "depth_scale": 1.0, "cam_R_w2c": [1, 0, 0]},
           "1": {"cam_K": [572.5, 0, 325.25, 0, 573.5, 242, 0, 0, 1], "depth_scale": 1.0}})",
       572.5, 325.25, 0, 1000},
      {"525.5 0 319.5\n0 525 239.5\n0 0 1\n", 525.5, 319.5, 0, 0},
      {"[[525.5, 0., 319.5],\n [0., 525., 239.5],\n [0., 0., 1.]]\n", 525.5, 319.5, 0, 0},
      {"525.5 0 319.5 0\n0 525 239.5 0\n0 0 1 0\n0 0 0 1\n", 525.5, 319.5, 0, 0},
  };
  for (const auto& [text, fx, cx, width, scale] : cases) {
    const Camera c = camera_of(text);
    EXPECT_EQ(c.intrinsics.fx, fx) << text;
    EXPECT_EQ(c.intrinsics.cx, cx) << text;
    EXPECT_EQ(c.width, width) << text;
    EXPECT_DOUBLE_EQ(c.depth_scale, scale) << text;
    EXPECT_EQ(c.lens.model, Lens::Model::none) << text;
  }
  const Camera bent = camera_of(
      R"({"fx": 9, "fy": 9, "ppx": 4, "ppy": 4, "model": "Brown Conrady",
          "coeffs": [0.5, 0.25, 0.125, 0.0625, 2]})");
  EXPECT_EQ(bent.lens.model, Lens::Model::polynomial);
  EXPECT_EQ(bent.lens.coefficients[4], 2);
}

TEST(CameraFiles, ReadsCamerasWithNames) {
  const struct {
    const char* text;
    double fx, cx;
    Index width;
    double scale;
  } cases[] = {
      // RealSense, a camera under the name of its stream.
      {R"({"color": {"fx": 615.5, "fy": 615, "ppx": 312.5, "ppy": 239.5, "width": 640,
                     "height": 480}, "depth_scale": 0.001, "serial": {"fw": [1]}})",
       615.5, 312.5, 640, 1000},
      {R"({"serial": "7", "depth": {"intrinsics": {"fx": 600.5, "fy": 600, "ppx": 320.5,
           "ppy": 240, "width": 640, "height": 480, "model": "none", "coeffs": [0, 0]},
           "depth_scale": 0.00025}})",
       600.5, 320.5, 640, 4000},
      {R"({"color": {"fx": 9.5, "fy": 9, "cx": 4.5, "cy": 4},
           "depth": {"fx": 9.5, "fy": 9, "cx": 4.5, "cy": 4}, "width": 9, "height": 8})",
       9.5, 4.5, 9, 0},
      // The objects in a camera are not cameras.
      {R"({"fx": 9.5, "fy": 9, "cx": 4.5, "cy": 4, "crop": {"fx": 1, "width": "all"}})", 9.5, 4.5,
       0, 0},
      // BOP, the entry of one picture.
      {R"({"cam_K": [572.5, 0, 325.25, 0, 573.5, 242, 0, 0, 1], "depth_scale": 0.1})", 572.5,
       325.25, 0, 10000},
      {R"({"cam_K": [572.5, 0, 325.25, 0, 573.5, 242, 0, 0, 1], "width": 640, "height": 480})",
       572.5, 325.25, 640, 0},
      {"fx: 1066.5\nfy: 1067\ncx: 312.5  # of the colour camera\ncy: 241\n", 1066.5, 312.5, 0, 0},
      {"color:\n  fx: 615.5\n  fy: 615\n  ppx: 312.5\n  ppy: 239\n  width: 640\n  height: 480\n"
       "depth:\n  scale: 1\n",
       615.5, 312.5, 640, 0},
      {"color: {fx: 615.5, fy: 615, ppx: 312.5, ppy: 239, width: 640, height: 480}\n"
       "depth_scale: 0.001\n",
       615.5, 312.5, 640, 1000},
      {"%YAML:1.0\nCamera.type: \"PinHole\"\nCamera.fx: 535.5\nCamera.fy: 539\nCamera.cx: 320.5\n"
       "Camera.cy: 247\nCamera.k1: 0.0\nCamera.p2: 0\nDepthMapFactor: 5000.0\n",
       535.5, 320.5, 0, 5000},
  };
  for (const auto& [text, fx, cx, width, scale] : cases) {
    const Camera c = camera_of(text);
    EXPECT_EQ(c.intrinsics.fx, fx) << text;
    EXPECT_EQ(c.intrinsics.cx, cx) << text;
    EXPECT_EQ(c.width, width) << text;
    EXPECT_DOUBLE_EQ(c.depth_scale, scale) << text;
  }
  const std::pair<const char*, const char*> faults[] = {
      {R"({"color": {"fx": 9, "fy": 9, "cx": 4, "cy": 4}, "depth": {"fx": 8, "fy": 9, "cx": 4,
           "cy": 4}})",
       "several cameras, found color and depth with different ones, expected one camera"},
      {R"({"a": {"cam_K": [9, 0, 4, 0, 9, 4, 0, 0, 1], "width": 8, "height": 8},
           "b": {"cam_K": [9, 0, 4, 0, 9, 4, 0, 0, 1]}})",
       "several cameras, found a and b"},
      {R"({"color": {"fx": 9, "fy": 9, "ppx": 4}})", "not a camera, found no ppy"},
      {R"({"color": {"width": 9, "height": 9}})", "not a camera, found no intrinsic_matrix, cam_K"},
      {R"({"color": {"fx": 9, "fy": 9, "ppx": 4, "ppy": 4}, "depth_scale": 0})",
       "c.yaml:1:66: depth_scale, found 0"},
      {"color:\n  fx: 9\n  fy: 9\n  cx: 4\n  cy: 4\ndepth:\n  fx: 8\n  fy: 9\n  cx: 4\n  cy: 4\n",
       "several cameras, found color and depth"},
      {"fx: 9\nfy: 9\ncx: 4\n", "not a camera, found no cy"},
      {"fx: 9\nfy: nine\ncx: 4\ncy: 4\n", "c.yaml:2:5: not a number, found \"nine\""},
      {"fx: [9, 8]\nfy: 9\ncx: 4\ncy: 4\n", "c.yaml:1:9: more than one number, found \"8\""},
      {"fx: 9\nfy: 9\ncx: 4\ncy: 4\nwidth: 8\n", "found no height"},
      {"fx: 9\nfy: 9\ncx: 4\ncy: 4\ndepth_scale: -1\n", "c.yaml:5:14: depth_scale, found -1"},
      {"Camera.fx: 9\nCamera.fy: 9\nCamera.cx: 4\nCamera.cy: 4\nCamera.k1: 0.1\n",
       "c.yaml:5:1: lens coefficients, found \"camera.k1\", expected none"},
      {"fx: 9\nfy: 9\ncx: 4\ncy: 4\ndistortion_coefficients:\n  data: [0, 0.5]\n",
       "c.yaml:6:3: lens coefficients, found \"distortion_coefficients\""},
      {"a: {fx: 9, fy: 9}\nb: {fx: 9, fx: 8}\n", "c.yaml:2:12: a repeated key, found b.fx"},
  };
  for (const auto& [text, message] : faults) {
    const std::string found = bad_data([&, t = text] { camera_of(t); });
    EXPECT_TRUE(contains(found, message)) << found;
  }
}

TEST(CameraFiles, RefusalsNameTheIntrinsics) {
  const std::vector<std::pair<const char*, const char*>> faults{
      {R"({"fx": 9, "fy": 9, "ppx": 4})", "not a camera, found no ppy"},
      {R"({"fx": 9, "fx": 8})", "c.yaml:1:17: fx, found a second one"},
      {R"({"fx": 9, "fy": 0, "cx": 4, "cy": 4})", "focal lengths, found 9 and 0"},
      {R"({"fx": 9, "fy": 9, "cx": 4, "cy": 4, "width": 8})", "found no height"},
      {R"({"0": {"cam_K": [1, 0, 3, 0, 1, 3, 0, 0]}})", "cam_K, found [1, 0, 3"},
      {R"({"0": {"cam_K": [1, 0, 3, 0, 1, 3, 0, 0, 1]}, "7": {"cam_K": [2, 0, 3, 0, 1, 3, 0, 0, 1]}})",
       "several cameras, found pictures 0 and 7"},
      {"525 0 319.5 0 525 239.5 0 0", "camera matrix, found 8 numbers, expected 9"},
      {"525 0 319.5\n0 525 239.5\n0 1 1\n", "c.yaml:1:1: camera matrix, found 525, 0"},
      {"1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17", "more than 16 numbers"},
      {"1 0 3 0 0 1 3 0 0 0 1 0 0 0 0 2", "camera matrix of 4 x 4"},
      {"{\"a\": 1}", "not a camera, found no intrinsic_matrix, cam_K or fx"},
      {"a: 1\n", "no image_width"},
  };
  for (const auto& [text, message] : faults) {
    const std::string found = bad_data([&, t = text] { camera_of(t); });
    EXPECT_TRUE(contains(found, message)) << found;
    const bool is_misprint = contains(message, "second") || contains(message, "height");
    EXPECT_EQ(contains(found, "intrinsics FX,FY,CX,CY"), !is_misprint) << found;
  }
  for (const char* text : {R"({"fx": 9, "fy": 9, "cx": 4, "cy": 4, "depth_scale": 10})",
                           R"({"fx": 9, "fy": 9, "cx": 4, "cy": 4, "depth_scale": 0})",
                           R"({"fx": 9, "fy": 9, "ppx": 4, "ppy": 4, "depth_scale": -1})"})
    EXPECT_TRUE(contains(bad_data([&] { camera_of(text); }), "depth_scale, found")) << text;
  EXPECT_TRUE(contains(bad_data([] {
                         camera_of(R"({"fx": 9, "fy": 9, "ppx": 4, "ppy": 4,
                           "model": "distortion.inverse_brown_conrady", "coeffs": [0.1, 0, 0, 0, 0]})");
                       }),
                       "lens model, found 5 coefficients of \"distortion.inverse_brown_conrady\""));
}

/// The lens models as defined in the original papers and in OpenCV's documentation.
std::array<double, 2> by_the_book(const Lens& lens, double x, double y) {
  const auto& c = lens.coefficients;
  const double r = std::sqrt(x * x + y * y);
  if (lens.model == Lens::Model::equidistant) {
    const double t = std::atan(r);
    const double shown = t + c[0] * std::pow(t, 3) + c[1] * std::pow(t, 5) + c[2] * std::pow(t, 7) +
                         c[3] * std::pow(t, 9);
    return r == 0 ? std::array{0.0, 0.0} : std::array{shown * x / r, shown * y / r};
  }
  const double factor =
      (1 + c[0] * std::pow(r, 2) + c[1] * std::pow(r, 4) + c[4] * std::pow(r, 6)) /
      (1 + c[5] * std::pow(r, 2) + c[6] * std::pow(r, 4) + c[7] * std::pow(r, 6));
  return {x * factor + 2 * c[2] * x * y + c[3] * (r * r + 2 * x * x),
          y * factor + c[2] * (r * r + 2 * y * y) + 2 * c[3] * x * y};
}

TEST(Lens, IsStraightenedAgain) {
  const Lens lenses[] = {
      {},
      {Lens::Model::polynomial, {-0.28, 0.07, 0.0002, -0.0001, 0}},
      {Lens::Model::polynomial, {0.25, -0.8, -0.0003, 0.0025, 0.92}},
      {Lens::Model::polynomial, {0.1, 0, 0.003, -0.002, 0}},
      {Lens::Model::polynomial, {0.52, -2.6, 0.0006, -0.0002, 1.48, 0.4, -2.43, 1.41}},
      {Lens::Model::equidistant, {-0.01, 0.004, -0.002, 0.0001}},
  };
  for (const Lens& lens : lenses) {
    for (double x = -0.62; x <= 0.63; x += 0.04) {
      for (double y = -0.47; y <= 0.48; y += 0.05) {
        const auto bent = lens.bent(x, y);
        const auto expected =
            lens.model == Lens::Model::none ? std::array{x, y} : by_the_book(lens, x, y);
        ASSERT_NEAR(bent[0], expected[0], 1e-12);
        ASSERT_NEAR(bent[1], expected[1], 1e-12);
        const auto again = lens.straightened(bent[0], bent[1], lens.reach());
        ASSERT_TRUE(again) << x << ' ' << y << ' ' << lens.coefficients[0];
        EXPECT_NEAR((*again)[0], x, 1e-9);
        EXPECT_NEAR((*again)[1], y, 1e-9);
      }
    }
  }
}

TEST(Lens, ShowsNothingBeyondItsEdge) {
  // The largest value of r (1 - 0.3 r^2) is 0.7027.
  const Lens barrel{Lens::Model::polynomial, {-0.3}};
  EXPECT_TRUE(barrel.straightened(0.6, 0, barrel.reach()));
  EXPECT_FALSE(barrel.straightened(0.75, 0, barrel.reach()));
  EXPECT_FALSE(barrel.straightened(0.6, 0.6, barrel.reach()));
  // r (1 - 0.3 r^2 + 0.03 r^4) rises up to r = 1.2135, falls, and rises again: beyond 1.2135, there
  // are no rays.
  const Lens wide{Lens::Model::polynomial, {-0.3, 0.03}};
  const double edge = wide.bent(1.2135, 0)[0];
  EXPECT_NEAR((*wide.straightened(edge - 0.01, 0, wide.reach()))[0], 1.2135, 0.2);
  for (double u = edge + 0.001; u < 8; u *= 1.01)
    for (const double turn : {0.0, 0.5, 1.1})
      EXPECT_FALSE(wide.straightened(u * std::cos(turn), u * std::sin(turn), wide.reach())) << u;
  const Lens fisheye{Lens::Model::equidistant, {}};
  EXPECT_TRUE(fisheye.straightened(1.5, 0, fisheye.reach()));
  EXPECT_FALSE(fisheye.straightened(1.6, 0, fisheye.reach())) << "behind the camera";
}

TEST(Camera, ScalesToImagesOfItsShape) {
  const Camera camera{{600, 602, 319.5, 240}, 640, 480};
  const Camera half = camera.scaled_to(320, 240);
  EXPECT_EQ(half.intrinsics.fx, 300);
  EXPECT_EQ(half.intrinsics.fy, 301);
  EXPECT_EQ(half.intrinsics.cx, 159.5);  // the centre of the image stays in place
  EXPECT_EQ(half.intrinsics.cy, 119.75);
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { camera.scaled_to(640, 360); }));
  const Camera any{{1, 2, 3, 4}};
  EXPECT_EQ(any.scaled_to(7, 5).intrinsics.cx, 3);
}

TEST(Camera, PresetsHaveTheFieldsOfViewThatArePublished) {
  const auto degrees = [](Index pixels, double focal) {
    return 2 * std::atan(static_cast<double>(pixels) / 2 / focal) * 180 / 3.14159265358979;
  };
  for (const auto& [name, camera, images] : camera_presets()) {
    const Intrinsics& k = camera.intrinsics;
    EXPECT_FALSE(images.empty()) << name;
    // For Kinect v1 and Xtion, the focal length is the 525 pixels of the colour camera, because
    // their depth images are registered to this camera.
    const bool realsense = name.starts_with("realsense"), second = name == "kinect-v2";
    EXPECT_NEAR(degrees(camera.width, k.fx), realsense ? 69.4 : second ? 70.6 : 62.7, 0.7) << name;
    EXPECT_NEAR(degrees(camera.height, k.fy), realsense ? 42.5 : second ? 60 : 49.1, 0.3) << name;
    if (!realsense) continue;
    const Camera cropped = camera.scaled_to(640, 480);
    EXPECT_EQ(cropped.intrinsics.fx, 616);
    EXPECT_EQ(cropped.intrinsics.cx, 319.5);
    EXPECT_EQ(cropped.intrinsics.cy, 239.5);
  }
}

}  // namespace
}  // namespace ph::test
