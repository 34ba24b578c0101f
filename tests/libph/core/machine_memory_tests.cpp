// SPDX-License-Identifier: MIT
#include "ph/detail/core/machine_memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ph {
namespace {

// Creates a tree of control groups in the form in which the kernel shows it.
class ControlGroups : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() / std::to_string(getpid());
    put("memory.max", "max\n");
    put("a/memory.max", "5000\n");
    put("a/b/memory.max", "9000\n");
    put("memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("memory/c/memory.limit_in_bytes", "7000\n");
  }
  void TearDown() override { std::filesystem::remove_all(root_); }
  void put(const std::string& name, const std::string& content) {
    std::filesystem::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << content;
  }
  std::optional<std::uint64_t> limit(const std::string& memberships) const {
    std::istringstream lines(memberships);
    return control_group_limit(lines, root_.string());
  }
  std::filesystem::path root_;
};

TEST_F(ControlGroups, TheLeastLimitAroundAProcessCounts) {
  EXPECT_EQ(limit("0::/a/b\n"), 5000u);
  EXPECT_EQ(limit("0::/\n"), std::nullopt) << "no limit";
  EXPECT_EQ(limit("0::/nowhere\n"), std::nullopt);
  EXPECT_EQ(limit("5:cpu,cpuacct:/c\n4:hugetlb,memory:/c\n"), 7000u);
  EXPECT_EQ(limit("4:memory:/c/d\n0::/a\n"), 5000u);
  EXPECT_EQ(limit("4:memory:/other\n"), 9223372036854771712u);
  EXPECT_EQ(limit("garbage\n\n"), std::nullopt);
}

TEST(Status, SaysWhatTheProcessHas) {
  EXPECT_GE(status_bytes("VmHWM:").value_or(0), status_bytes("RssAnon:").value_or(1));
  EXPECT_EQ(status_bytes("NoSuchLine:"), std::nullopt);
}

}  // namespace
}  // namespace ph
