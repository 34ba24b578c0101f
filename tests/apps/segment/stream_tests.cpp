// SPDX-License-Identifier: MIT
// Runs ph-segment on streams of frames.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "tests/apps/segment/program_fixture.hpp"

namespace ph::segment {
namespace {

namespace fs = std::filesystem;

class Stream : public test::Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    fs::create_directory(at("in"));
    // The right box grows until it has more points than the left one.
    for (int frame = 0; frame < 4; ++frame) {
      const test::TableScene scene({{{-0.22, -0.05, 0}, {-0.10, 0.07, 0.12}},
                                    {{0.10, -0.05, 0}, {0.2 + 0.03 * frame, 0.05, 0.1}}});
      write_cloud(at("in/" + std::to_string(frame) + ".pcd"), scene.cloud());
    }
  }
  std::vector<std::string> lines(const std::string& text) const {
    std::vector<std::string> result;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) result.push_back(line);
    return result;
  }
};

TEST_F(Stream, AFolderOfFrames) {
  ASSERT_EQ(run("in --labels out/ --json all.json"), 0) << err();
  ASSERT_EQ(run("in/2.pcd --labels two.npy"), 0) << err();
  EXPECT_EQ(contents(at("out/2.npy")), contents(at("two.npy")));
  EXPECT_EQ(std::distance(fs::directory_iterator(at("out")), {}), 4);
  const auto json = lines(contents(at("all.json")));
  ASSERT_EQ(json.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(json[i].starts_with("{\"format\": \"ph-segment\", \"version\": 1, ")) << json[i];
    EXPECT_NE(json[i].find("in/" + std::to_string(i) + ".pcd"), std::string::npos);
    EXPECT_TRUE(json[i].ends_with("}"));
  }
}

TEST_F(Stream, SaysItsThroughput) {
  ASSERT_EQ(run("in --labels out/"), 0);
  const auto messages = lines(err());
  ASSERT_EQ(messages.size(), 5U) << err();
  EXPECT_NE(messages.back().find("4 frames in "), std::string::npos);
  EXPECT_NE(messages.back().find(" frames/s, "), std::string::npos);
  EXPECT_NE(messages.back().find(" ms CPU per frame"), std::string::npos);
  ASSERT_EQ(run("in --labels out/ --quiet"), 0);
  EXPECT_EQ(err(), "");
}

TEST_F(Stream, InputsListsAndPatterns) {
  ASSERT_EQ(run("in/0.pcd in/1.pcd -o out/ --labels 'out/labels-*.csv' --tree trees/"), 0) << err();
  for (const char* file : {"out/0.pcd", "out/1.pcd", "out/labels-0.csv", "trees/1.tree"})
    EXPECT_TRUE(fs::exists(at(file))) << file;
  ASSERT_EQ(run("trees --labels 'again/*.csv'"), 0) << err();  // this folder holds stored trees
  EXPECT_EQ(contents(at("again/1.csv")), contents(at("out/labels-1.csv")));
  std::ofstream(at("list.txt")) << "in/3.pcd\r\n\nin/1.pcd\n";
  ASSERT_EQ(run("--frames-from - --json - <list.txt"), 0) << err();
  const auto json = lines(out());
  ASSERT_EQ(json.size(), 2U);
  EXPECT_NE(json[0].find("in/3.pcd"), std::string::npos);
  ASSERT_EQ(run("--frames-from list.txt --labels out/"), 0) << err();
  EXPECT_TRUE(fs::exists(at("out/3.npy")));
}

TEST_F(Stream, AListThatCannotBeReadIsNoEmptyOne) {
  EXPECT_EQ(run("--frames-from - --json all.json <in"), 66) << "a folder";
  EXPECT_NE(err().find("cannot read the list of frames"), std::string::npos) << err();
  EXPECT_EQ(run("--frames-from - --json all.json <&-"), 74) << "closed";
  EXPECT_NE(err().find("standard input: cannot read the list of frames"), std::string::npos);
  EXPECT_EQ(run("--frames-from missing.txt --json all.json"), 66);
  EXPECT_FALSE(fs::exists(at("all.json")));
  EXPECT_EQ(run("--frames-from - --json all.json </dev/null"), 0) << err();
  EXPECT_EQ(contents(at("all.json")), "");
}

TEST_F(Stream, APipeThatDoesNotWaitHasNoEndYet) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  // Without this flag, the program would inherit this end of the pipe and keep it open.
  fcntl(ends[1], F_SETFD, FD_CLOEXEC);
  std::thread writer([&] {
    for (const std::string_view some : {"in/0.p", "cd\nin/", "1.pcd\nin/2.pcd"}) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      EXPECT_EQ(write(ends[1], some.data(), some.size()), static_cast<ssize_t>(some.size()));
    }
    close(ends[1]);
  });
  EXPECT_EQ(run("--frames-from - --json - <&" + std::to_string(ends[0])), 0) << err();
  writer.join();
  close(ends[0]);
  EXPECT_EQ(lines(out()).size(), 3U) << err();
}

TEST_F(Stream, NoFileIsThatOfTwoFrames) {
  fs::copy(at("in/1.pcd"), at("in/0-b.pcd"));
  EXPECT_EQ(run("in/0.pcd in/0-b.pcd --labels 'out/*.npy' --json all.json "
                "--surfaces 'out/*-b.npy'"),
            64);
  EXPECT_NE(err().find("--labels: out/0-b.npy would be written for two frames"), std::string::npos)
      << err();
  EXPECT_FALSE(fs::exists(at("out/0.npy")));
  std::ofstream(at("list.txt")) << "in/0.pcd\nin/0-b.pcd\n";
  EXPECT_EQ(run("--frames-from list.txt --labels 'out/*.npy' --surfaces 'out/*-b.npy'"), 64);
  EXPECT_EQ(run("in/0.pcd in/0-b.pcd --labels 'out/*.npy' --surfaces 'out/*-c.npy'"), 0) << err();
}

TEST_F(Stream, AFailureDoesNotStopTheOthers) {
  const std::string whole = contents(at("in/1.pcd"));
  std::ofstream(at("in/1.pcd"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  std::ofstream(at("in/2.pcd")) << "";
  EXPECT_EQ(run("in missing.pcd --labels out/ --json all.json"), 65);
  EXPECT_TRUE(fs::exists(at("out/0.npy")));
  EXPECT_FALSE(fs::exists(at("out/1.npy")));
  EXPECT_TRUE(fs::exists(at("out/3.npy")));
  EXPECT_NE(err().find("3 of 5 frames failed"), std::string::npos) << err();
  const auto json = lines(contents(at("all.json")));
  ASSERT_EQ(json.size(), 5U);
  EXPECT_NE(json[1].find("\"exit_code\": 65"), std::string::npos) << json[1];
  EXPECT_NE(json[4].find("\"exit_code\": 66"), std::string::npos) << json[4];
}

TEST_F(Stream, StableLabels) {
  // The label of the first segment, which is the segment with the most points.
  const auto first_label = [](const std::string& line) {
    const std::string before = "\"segments\": [{\"label\": ";
    return line[line.find(before) + before.size()];
  };
  ASSERT_EQ(run("in --json plain.json"), 0) << err();
  ASSERT_EQ(run("in --json stable.json --labels 'out/*.csv' --stable-labels"), 0) << err();
  const auto plain = lines(contents(at("plain.json")));
  const auto stable = lines(contents(at("stable.json")));
  EXPECT_EQ(first_label(plain[3]), '1');
  EXPECT_EQ(first_label(stable[0]), '1');
  EXPECT_EQ(first_label(stable[3]), '2') << "the box that grew was the second one";
  ASSERT_EQ(run("in/3.pcd --labels plain.csv"), 0);
  std::string swapped = contents(at("plain.csv"));
  for (char& c : swapped) c = c == '1' ? '2' : c == '2' ? '1' : c;
  EXPECT_EQ(contents(at("out/3.csv")), swapped);
}

TEST_F(Stream, FramesOfOneNameAreNumbered) {
  fs::create_directory(at("other"));
  fs::copy_file(at("in/0.pcd"), at("other/0.pcd"));
  fs::copy_file(at("in/0.pcd"), at("other/0-2.pcd"));
  std::ofstream list(at("list.txt"));
  for (const char* frame : {"in/0.pcd", "other/0-2.pcd", "other/0.pcd", "in/0.pcd", "other/0.pcd"})
    list << frame << '\n';
  list.close();
  ASSERT_EQ(run("--frames-from list.txt --labels out/"), 0) << err();
  for (const char* name : {"0", "0-2", "0-3", "0-4", "0-5"})
    EXPECT_TRUE(fs::exists(at("out/" + std::string(name) + ".npy"))) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(at("out")), {}), 5);
  // If there is no output file per frame, several inputs may have the same name.
  EXPECT_EQ(run("in/0.pcd other/0.pcd in/0.pcd --json all.json"), 0) << err();
}

TEST_F(Stream, AThousandFramesTakeNoMoreMemoryThanSome) {
  const test::TableScene small(std::vector<test::Block>{{{-0.22, -0.05, 0}, {-0.10, 0.07, 0.12}}},
                               0.2);
  const Cloud cloud = test::cloud_of(small.xyz(), 64, 48);
  write_cloud(at("s.pcd"), cloud);
  std::ofstream list(at("list.txt"));
  constexpr std::size_t frames = 1200;
  for (std::size_t i = 0; i < frames; ++i) {
    std::string path(2 * 500, '/');  // a long name of the same file, made of "./"
    for (std::size_t k = 0; k < path.size(); k += 2) path[k] = '.';
    list << path << "s.pcd" << '\n';
  }
  list.close();
  ASSERT_EQ(run("--frames-from list.txt --stable-labels --no-check --json all.json --quiet"), 0)
      << err();
  const auto json = lines(contents(at("all.json")));
  ASSERT_EQ(json.size(), frames);
  const auto peak = [](const std::string& line) {
    const std::string key = "\"peak_memory\": ";
    return std::stod(line.substr(line.find(key) + key.size()));
  };
  EXPECT_GT(peak(json[300]), 1e6);
  EXPECT_LT(peak(json.back()) - peak(json[300]), 512 * 1024) << "names of 1 MB were kept";
}

TEST_F(Stream, UsageErrors) {
  fs::create_directory(at("empty"));
  EXPECT_EQ(run("empty --labels out/"), 66);
  EXPECT_EQ(run("in"), 66);  // the results of several frames need more than one file
  EXPECT_EQ(run("in --labels l.npy"), 66);
  EXPECT_EQ(run("--frames-from missing.txt --labels out/"), 66);
  for (const char* arguments :
       {"in/0.pcd in/1.pcd --labels l.npy", "in/0.pcd in/1.pcd", "in --labels out/ --explain 1,2",
        "in/0.pcd --stable-labels", "in/0.pcd in/0.pcd --labels out/", "- - --labels out/"}) {
    EXPECT_EQ(run(arguments), 64) << arguments;
    EXPECT_EQ(std::ranges::count(err(), '\n'), 1) << arguments << '\n' << err();
  }
}

}  // namespace
}  // namespace ph::segment
