// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "ph/io/cloud.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment::test {

/// Runs ph-segment in a temporary folder with `scene.pcd`: two boxes on a table.
class Program : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/ph_segment_XXXXXX";
    folder_ = mkdtemp(name);
    write_cloud(at("scene.pcd"), scene_.cloud());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& file) const { return (folder_ / file).string(); }
  static std::string contents(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  static void write_cloud(const std::string& path, const Cloud& cloud) {
    std::ofstream out(path, std::ios::binary);
    write_pcd(out, cloud);
  }
  /// Runs ph-segment in the test's folder, and returns the exit code.
  int run(const std::string& arguments) {
    const std::string command =
        "cd " + folder_.string() + " && " PH_SEGMENT_PROGRAM " " + arguments + " >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return contents(at("stdout")); }
  std::string err() const { return contents(at("stderr")); }

  TableScene scene_ = TableScene::two_boxes();
  std::filesystem::path folder_;
};

}  // namespace ph::segment::test
