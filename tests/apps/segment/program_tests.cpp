// SPDX-License-Identifier: MIT
// Runs ph-segment as users do: options, stored trees, exit codes, messages.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/segment/program_fixture.hpp"

namespace ph::segment {
namespace {

namespace fs = std::filesystem;
using test::Program;

TEST_F(Program, UsageErrors) {
  for (const char* arguments : {"",
                                "scene.pcd --voxel 0",
                                "scene.pcd --voxel nan",
                                "scene.pcd --distance -1",
                                "scene.pcd --steps 0",
                                "scene.pcd --steps many",
                                "scene.pcd --min-size 0",
                                "scene.pcd --min-part 0",
                                "scene.pcd --min-persistence -1",
                                "scene.pcd --crop 1,2,3",
                                "scene.pcd --crop 1,0,0,1,0,1",
                                "scene.pcd --plane maybe",
                                "scene.pcd --method none",
                                "scene.pcd --max-range -1",
                                "scene.pcd --viewpoint 1,2",
                                "scene.pcd --no-such-option",
                                "scene.pcd -o out.txt",
                                "scene.pcd --labels l.txt",
                                "scene.pcd --plot p.gif",
                                "scene.pcd --plot ''",
                                "scene.pcd --plot p.svg --plot-kind clouds",
                                "scene.pcd --plot-kind tree",
                                "scene.pcd --plot-view 1",
                                "scene.pcd --plot-view 0,91",
                                "scene.pcd --plot-view nan,0",
                                "scene.pcd --barcode b.xyz",
                                "scene.pcd --depth d.png",
                                "--depth d.png",
                                "scene.pcd --color c.png",
                                "--depth d.png --intrinsics 1,2,3",
                                "scene.pcd scene.pcd",
                                "scene.pcd --supervoxels 0.03 --method surface",
                                "scene.pcd --method paper --supervoxels 0.03",
                                "scene.pcd --supervoxels 0.001",
                                "scene.pcd --parts --objects",
                                "scene.pcd --cut 0.1 --min-persistence 0.1",
                                "scene.pcd --plane-noise -1",
                                "scene.pcd --plane-noise inf",
                                "scene.pcd --voxel 1e-17",
                                "scene.pcd --voxel 1e308",
                                "scene.pcd --labels ''",
                                "scene.pcd -o ''",
                                "scene.pcd --json=",
                                "--depth ''",
                                "--frames-from '' --json -",
                                "scene.pcd --voxel"}) {
    EXPECT_EQ(run(arguments), 64) << arguments;
    const std::string message = err();
    EXPECT_EQ(std::ranges::count(message, '\n'), 1) << arguments << '\n' << message;
  }
}

TEST_F(Program, ExplainsWhereSegmentsJoin) {
  const test::TableScene scene(
      {{{-0.15, -0.1, 0}, {0.15, 0.15, 0.08}}, {{-0.06, 0.0, 0.08}, {0.06, 0.1, 0.2}}});
  std::ofstream file(at("stack.pcd"), std::ios::binary);
  write_pcd(file, scene.cloud());
  file.close();
  ASSERT_EQ(run("stack.pcd --explain 1,2"), 0) << err();
  EXPECT_EQ(out().substr(0, 25), "segments 1 and 2 join at ") << out();
  ASSERT_EQ(run("stack.pcd --explain 2,1 --json s.json"), 0) << err();
  EXPECT_EQ(out().substr(0, 25), "segments 2 and 1 join at ") << out();
  ASSERT_EQ(run("scene.pcd --explain 1,2"), 0) << err();
  EXPECT_NE(out().find("never join"), std::string::npos) << out();
  EXPECT_EQ(run("scene.pcd --explain 1,3 -o none.pcd"), 64);
  EXPECT_FALSE(fs::exists(at("none.pcd")));
  for (const char* bad : {"1,3", "0,1", "1", "1,1", "a,b", "1,2 --json -"})
    EXPECT_EQ(run(std::string("scene.pcd --explain ") + bad), 64) << bad;
}

TEST_F(Program, SupervoxelsAndSignatures) {
  ASSERT_EQ(run("scene.pcd --supervoxels 0.03 --json s.json --tree s.tree --labels a.npy"), 0)
      << err();
  const std::string summary = contents(at("s.json"));
  EXPECT_NE(summary.find("\"method\": \"supervoxels\""), std::string::npos);
  EXPECT_NE(summary.find("\"label\": 10,"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\"signature\": null"), std::string::npos);
  EXPECT_EQ(run("s.tree --cut 0 --objects --labels b.npy"), 64);
  ASSERT_EQ(run("s.tree --cut 0 --labels b.npy"), 0) << err();
  EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
  ASSERT_EQ(run("scene.pcd --signatures --json s.json"), 0) << err();
  EXPECT_NE(
      contents(at("s.json")).find("\"signature\": {\"h0\": [[0, null]], \"h1\": [], \"h2\": []}"),
      std::string::npos);
  for (const char* bad : {"--supervoxels 0", "--supervoxels x", "--signatures"})
    EXPECT_EQ(run(std::string("scene.pcd ") + bad), 64) << bad;
}

TEST_F(Program, OptionsThatSayTheSameAreNoContradiction) {
  EXPECT_EQ(run("scene.pcd --method supervoxels --supervoxels 0.03 --labels a.npy"), 0) << err();
  EXPECT_EQ(run("scene.pcd --supervoxels 0.03 --labels b.npy"), 0) << err();
  EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
}

TEST_F(Program, ASignatureWithoutMemoryIsNullAndTheRestIsThere) {
  // There are specks in the corners of a large cube. Grouped by distance, they form a single
  // segment, whose box is far too large.
  std::ofstream points(at("corners.xyz"));
  for (int i = 0; i < 400; ++i)
    points << 2.0 * (i % 2) << ' ' << 2.0 * (i / 2 % 2) << ' ' << 2.0 * (i / 4 % 2) + 1e-4 * i
           << '\n';
  for (int i = 0; i < 40; ++i) points << -3 << ' ' << 1e-3 * i << " 0\n";
  points.close();
  ASSERT_EQ(run("corners.xyz --method paper --plane off --max-range 10 --distance 2.5 --voxel 0.01 "
                "--min-size 2 --signatures --json s.json --labels l.npy --memory-limit 60MB"),
            0)
      << err();
  EXPECT_NE(err().find("segment 1: no signature: "), std::string::npos) << err();
  const std::string json = contents(at("s.json"));
  EXPECT_NE(json.find("\"signature\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"signature\": {\"h0\": "), std::string::npos) << json;
  EXPECT_TRUE(fs::exists(at("l.npy")));
}

TEST_F(Program, SaysWhyVoxelsAreLarger) {
  std::ofstream points(at("sparse.xyz"));
  for (int i = 0; i < 1600; ++i) points << 0.009 * (i % 40) << ' ' << 0.009 * (i / 40) << " 0.7\n";
  points.close();
  EXPECT_EQ(run("sparse.xyz --plane off --verbose"), 0);
  EXPECT_NE(err().find(" instead of 0.005 m"), std::string::npos) << err();
  EXPECT_EQ(run("scene.pcd --verbose"), 0);
  EXPECT_EQ(err().find(" instead of "), std::string::npos) << err();
}

TEST_F(Program, AStoredTreeIsAnInput) {
  ASSERT_EQ(run("scene.pcd --tree s.tree --labels a.npy --barcode a.csv"), 0) << err();
  ASSERT_EQ(run("s.tree --labels b.npy --barcode b.csv --json b.json"), 0) << err();
  EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
  EXPECT_EQ(contents(at("a.csv")), contents(at("b.csv")));
  EXPECT_NE(contents(at("b.json")).find("\"cut\": {\"value\": 1,"), std::string::npos);
  ASSERT_EQ(run("s.tree --cut 1 --labels b.npy --tree again.tree"), 0) << err();
  EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
  EXPECT_EQ(contents(at("s.tree")), contents(at("again.tree")));
  ASSERT_EQ(run("- --explain 1,2 <s.tree"), 0) << err();
  EXPECT_NE(out().find("never join"), std::string::npos) << out();
  ASSERT_EQ(run("s.tree --min-size 100000 --tree s.json"), 0) << err();
  EXPECT_NE(err().find("0 segments"), std::string::npos) << err();
  EXPECT_TRUE(contents(at("s.json")).starts_with("{\n  \"format\": \"ph-segment-tree\""));
}

TEST_F(Program, WhatAStoredTreeCannotDo) {
  ASSERT_EQ(run("scene.pcd --tree s.tree"), 0) << err();
  for (const char* arguments :
       {"-o o.pcd", "--coloured c.pcd", "--picture p.png", "--voxel 0.01", "--method paper",
        "--distance 0.01", "--plane off", "--plane-noise 0.01", "--min-persistence 0.1", "--cut -1",
        "--tree t.txt"}) {
    EXPECT_EQ(run(std::string("s.tree ") + arguments), 64) << arguments;
    EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << err();
  }
  const std::string whole = contents(at("s.tree"));
  std::ofstream(at("half.tree"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(run("half.tree --labels l.npy"), 65);
  EXPECT_NE(err().find("truncated"), std::string::npos) << err();
  EXPECT_FALSE(fs::exists(at("l.npy")));
}

TEST_F(Program, ACutOfACloudIsThatOfItsTree) {
  for (const char* method : {"--method surface --cut 30", "--method paper --cut 0.015"}) {
    ASSERT_EQ(run(std::string("scene.pcd --labels a.npy --tree s.tree ") + method), 0) << err();
    ASSERT_EQ(run("s.tree --labels b.npy"), 0) << err();
    EXPECT_EQ(contents(at("a.npy")), contents(at("b.npy")));
  }
  EXPECT_EQ(run("scene.pcd --method paper --cut 0.03"), 64);
}

TEST_F(Program, InputErrors) {
  EXPECT_EQ(run("missing.pcd"), 66);
  EXPECT_EQ(run("."), 66);
  const std::string whole = contents(at("scene.pcd"));
  std::ofstream(at("cut.pcd"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(run("cut.pcd -o out.pcd"), 65);
  EXPECT_FALSE(fs::exists(at("out.pcd")));
  std::ofstream(at("empty.pcd"));
  EXPECT_EQ(run("empty.pcd"), 65);
  EXPECT_EQ(run("scene.pcd -o no/such/folder/out.pcd"), 73);
  EXPECT_EQ(
      run("scene.pcd --method paper --plane off --distance 2 --memory-limit 50MB --json s.json"),
      75);
  EXPECT_NE(err().find("lower --distance"), std::string::npos) << err();
  EXPECT_FALSE(fs::exists(at("s.json")));
}

TEST_F(Program, HelpAndVersion) {
  EXPECT_EQ(run("--help all"), 0);
  for (const char* option :
       {"--method",      "--max-range", "--crop",      "--plane",           "--plane-distance",
        "--plane-noise", "--voxel",     "--min-part",  "--min-persistence", "--distance",
        "--steps",       "--min-size",  "--viewpoint", "--no-check",        "--output",
        "--labels",      "--barcode",   "--plot",      "--plot-kind",       "--plot-view",
        "--json",        "--depth",     "--color",     "--intrinsics",      "--depth-scale",
        "--coloured",    "--picture",   "--threads",   "--memory-limit",    "--progress",
        "--quiet",       "--verbose",   "--version",   "--objects",         "--parts",
        "--cut",         "--tree",      "--explain",   "--report"}) {
    EXPECT_NE(out().find(option), std::string::npos) << option;
  }
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(out().substr(0, 11), "ph-segment ");
}

TEST_F(Program, NoCheckSkipsTheCheck) {
  EXPECT_EQ(run("scene.pcd --no-check"), 0);
  EXPECT_EQ(err().find("checked"), std::string::npos);
}

}  // namespace
}  // namespace ph::segment
