// SPDX-License-Identifier: MIT
#include "ph/detail/io/output_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace ph {
namespace {

class OutputFiles : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / info->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "out").string(); }
  bool is_empty() const { return std::filesystem::is_empty(folder_); }

 private:
  std::filesystem::path folder_;
};

using OutputFilesDeathTest = OutputFiles;

TEST_F(OutputFilesDeathTest, ACallerThatForgetsCommitIsStopped) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto forgets = [&] {
    OutputFile file(path());
    file.write("1");
  };
  EXPECT_DEATH(forgets(), "out: found an OutputFile .* not committed, expected commit\\(\\)");
  EXPECT_TRUE(is_empty());
  const auto replaces = [&] {
    OutputFile file(path());
    file.write("1");
    file = OutputFile("/dev/null");
  };
  EXPECT_DEATH(replaces(), "out: found an OutputFile .* not committed, expected commit\\(\\)");
}

TEST_F(OutputFiles, LeaveNothingWithoutCommit) {
  { const OutputFile file(path()); }
  EXPECT_TRUE(is_empty()) << "nothing was written";
  {
    OutputFile file(path());
    file.write("1");
    file.discard();
  }
  EXPECT_TRUE(is_empty());
  const auto fails = [&] {
    OutputFile file(path());
    file.write("1");
    throw std::runtime_error("a computation failed");
  };
  EXPECT_THROW(fails(), std::runtime_error);
  EXPECT_TRUE(is_empty());
}

TEST_F(OutputFiles, MayBeMovedBeforeCommit) {
  std::optional<OutputFile> moved;
  {
    OutputFile file(path());
    file.write("1");
    moved = std::move(file);
  }
  EXPECT_TRUE(!std::filesystem::exists(path()));
  moved->commit();
  EXPECT_EQ(std::filesystem::file_size(path()), 1U);
}

TEST_F(OutputFiles, AFailureToWriteIsEnoughOfAMessage) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  OutputFile file("/dev/full");
  file.write("1");
  EXPECT_THROW(file.commit(), Error);
}

}  // namespace
}  // namespace ph
