// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/arguments/choices.hpp"
#include "common/arguments/numbers.hpp"
#include "common/files/file_identity.hpp"
#include "common/run/memory_limit.hpp"
#include "common/run/progress.hpp"
#include "common/run/session.hpp"
#include "common/terminal/exit_code.hpp"
#include "common/terminal/messages.hpp"

namespace ph::app {
namespace {

/// The kind of the error that `act` throws; internal if it throws none.
template <class Act>
ErrorKind kind_of(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.kind();
  }
  return ErrorKind::internal;
}

TEST(Numbers, AreStrict) {
  EXPECT_EQ(parse_number("--x", "1.5"), 1.5);
  EXPECT_EQ(parse_number("--x", "+1e-3"), 1e-3);
  EXPECT_EQ(parse_number("--x", "inf"), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(std::signbit(parse_number("--x", "-0")));
  for (const char* text : {"", "nan", "1,5", "0x10", "1e400", "1.0abc", " 1", "1 ", "1_000", "+-1"})
    EXPECT_EQ(kind_of([&] { parse_number("--x", text); }), ErrorKind::usage) << text;
}

TEST(Numbers, WholeNumbersKeepTheirBounds) {
  EXPECT_EQ(parse_integer("--n", "-3", -5, 5), -3);
  for (const char* text : {"6", "-6", "1.5", "", "0x1", "9999999999999999999", "+1", "1 "})
    EXPECT_EQ(kind_of([&] { parse_integer("--n", text, -5, 5); }), ErrorKind::usage) << text;
}

TEST(Numbers, Lists) {
  EXPECT_EQ(parse_numbers("--v", "1,-2.5,3e2"), (std::vector<double>{1, -2.5, 300}));
  for (const char* text : {"1,2", "1,2,3,4", "1,,3", "1,2,", "", "1;2;3"})
    EXPECT_EQ(kind_of([&] { parse_numbers("--v", text, 3); }), ErrorKind::usage) << text;
}

TEST(Numbers, Sizes) {
  EXPECT_EQ(parse_size("--m", "4GiB"), 4ull << 30);
  EXPECT_EQ(parse_size("--m", "500MB"), 500'000'000u);
  EXPECT_EQ(parse_size("--m", "1e9"), 1'000'000'000u);
  EXPECT_EQ(parse_size("--m", "1.5 kib"), 1536u);
  EXPECT_EQ(parse_size("--m", "64k"), 64'000u);
  for (const char* text : {"", "GiB", "4XB", "-1GiB", "0", "inf", "nan", "1e30", "4GiBs"})
    EXPECT_EQ(kind_of([&] { parse_size("--m", text); }), ErrorKind::usage) << text;
  EXPECT_EQ(format_size(1536), "1.5 KiB");
  EXPECT_EQ(format_size(12), "12 B");
}

TEST(Numbers, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  int tried = 0;
  for (const char* name : {"de_DE.UTF-8", "tr_TR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    ++tried;
    EXPECT_EQ(parse_number("--x", "1.5"), 1.5);
    EXPECT_EQ(parse_size("--m", "1MIB"), 1u << 20);
    EXPECT_EQ(format_size(1536), "1.5 KiB");
  }
  std::setlocale(LC_ALL, before.c_str());
  if (tried == 0) GTEST_SKIP() << "no locale de_DE.UTF-8 or tr_TR.UTF-8";
}

TEST(Choices, SuggestWhatIsNear) {
  constexpr std::array<std::string_view, 4> kNames{"--threshold", "--threads", "--max-dim",
                                                   "--metric"};
  EXPECT_EQ(nearest_name("--treshold", kNames), "--threshold");
  EXPECT_EQ(nearest_name("--max", kNames), "--max-dim");
  EXPECT_EQ(nearest_name("--metirc", kNames), "--metric");
  EXPECT_EQ(nearest_name("--completely-different", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100'000, 'x'), kNames), std::nullopt);
  EXPECT_EQ(choose("--o", "--metric", kNames), 3u);
  EXPECT_EQ(kind_of([&] { choose("--o", "metric", kNames); }), ErrorKind::usage);
}

TEST(Choices, SuggestNothingThatIsFar) {
  constexpr std::array<std::string_view, 4> kNames{"--plot-kind", "--plot", "--title", "--max-dim"};
  EXPECT_EQ(nearest_name("--plot-title", kNames), "--title");
  EXPECT_EQ(nearest_name("--plot-size", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("--tilte", kNames), "--title");
  EXPECT_EQ(nearest_name("---", kNames), std::nullopt);
}

// A folder of its own with one file, "input".
class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "ph_files_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::ofstream(at("input")) << "x";
    inputs_.add(at("input"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string at(const std::string& name) const { return folder_ + "/" + name; }
  bool is_input(const std::string& name) const { return inputs_.replaced_by(at(name)) != nullptr; }

  std::string folder_;
  InputFiles inputs_;
};

TEST_F(Files, AnInputIsKnownByAnyOfItsNames) {
  std::filesystem::create_symlink(at("input"), at("link"));
  std::filesystem::create_hard_link(at("input"), at("hard"));
  std::filesystem::create_directory(at("folder"));
  std::ofstream(at("other")) << "x";
  for (const char* name : {"input", "./input", "folder/../input", "link", "hard"}) {
    EXPECT_TRUE(is_input(name)) << name;
    const Written output{"--output", at(name)};
    EXPECT_EQ(kind_of([&] { require_separate(inputs_, std::span(&output, 1), false); }),
              ErrorKind::usage);
    EXPECT_TRUE(require_separate(inputs_, std::span(&output, 1), true));
  }
  for (const char* name : {"other", "new", "folder", "folder/input", "missing/input"})
    EXPECT_FALSE(is_input(name)) << name;
  const Written null{"--output", "/dev/null"};
  EXPECT_FALSE(require_separate(inputs_, std::span(&null, 1), false));
}

TEST_F(Files, APartOfAnInputIsTheInput) {
  std::ofstream(at("scan.npz")) << "x";
  std::ofstream(at("whole.npz:a")) << "x";
  inputs_.add(at("scan.npz:image"));
  inputs_.add(at("whole.npz:a"));
  EXPECT_TRUE(is_input("scan.npz"));
  EXPECT_TRUE(is_input("whole.npz:a"));
  EXPECT_FALSE(is_input("whole.npz"));
}

TEST_F(Files, TwoOutputsAreTwoFiles) {
  std::filesystem::create_directory(at("folder"));
  const auto kind = [](const std::vector<Written>& outputs) {
    return kind_of([&] { require_distinct(outputs); });
  };
  const ErrorKind none = ErrorKind::internal;
  EXPECT_EQ(kind({{"--output", at("a")}, {"--report", at("b")}}), none);
  EXPECT_EQ(kind({{"--output", at("a")}, {"--report", at("folder/a")}}), none);
  EXPECT_EQ(kind({{"--output", at("a")}, {"--report", at("folder/../a")}}), ErrorKind::usage);
  // A folder that a batch will create.
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("new/b")}}), none);
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("new/deep/a")}}), none);
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("folder/../new/./a")}}),
            ErrorKind::usage);
  EXPECT_EQ(kind({{"--output", "-"}, {"--report", "-"}}), ErrorKind::usage);
  EXPECT_EQ(kind({{"--output", "/dev/null"}, {"--report", "/dev/null"}}), none);
}

TEST(ExitCodes, AreThoseOfSysexits) {
  EXPECT_EQ(exit_code(ErrorKind::usage), 64);
  EXPECT_EQ(exit_code(ErrorKind::bad_data), 65);
  EXPECT_EQ(exit_code(ErrorKind::no_input), 66);
  EXPECT_EQ(exit_code(ErrorKind::not_built_in), 69);
  EXPECT_EQ(exit_code(ErrorKind::internal), 70);
  EXPECT_EQ(exit_code(ErrorKind::cannot_create), 73);
  EXPECT_EQ(exit_code(ErrorKind::io), 74);
  EXPECT_EQ(exit_code(ErrorKind::resource), 75);
  EXPECT_EQ(exit_code(ErrorKind::cancelled), 130);
}

// A tree of control groups as the kernel shows it.
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

TEST(Session, PassesOptionsOn) {
  CommonOptions options;
  options.threads = 3;
  options.memory_limit = 1000;
  options.quiet = true;
  std::stop_source stop;
  const Session session("test", options, stop.get_token());
  EXPECT_EQ(session.context().threads, 3);
  EXPECT_EQ(session.context().memory.limit(), 1000u);
  EXPECT_NO_THROW(session.context().poll());
  stop.request_stop();
  EXPECT_EQ(kind_of([&] { session.context().poll(); }), ErrorKind::cancelled);
}

// ---- the bar, and what must not meet it on its line

constexpr std::string_view kWipe = "\r\x1b[K";
constexpr auto kBarIsThere = std::chrono::milliseconds(600);       // after the start
constexpr auto kTooLongSilence = std::chrono::milliseconds(1000);  // of a computation

/// What goes to stderr while `act` runs.
template <class Act>
std::string stderr_of(Act&& act) {
  testing::internal::CaptureStderr();
  act();
  return testing::internal::GetCapturedStderr();
}

std::size_t count_of(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Progress, ABarIsHeardEverySecondOnceSomethingWasReported) {
  std::size_t before = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere + kTooLongSilence);
    before = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"read", 1, 4});
    std::this_thread::sleep_for(kTooLongSilence);
  });
  EXPECT_EQ(before, 0U) << "nothing is drawn before the first report";
  EXPECT_EQ(count_of("read [", text), 2U) << text;
  EXPECT_TRUE(text.ends_with(kWipe)) << "it is gone in the end";
}

TEST(Progress, ABarIsHeldBack) {
  std::size_t before = 0, after = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere);
    progress.report({"old", 1, 4});
    progress.hold();
    before = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"held", 1, 4});
    std::this_thread::sleep_for(kTooLongSilence);
    progress.release();
    std::this_thread::sleep_for(kTooLongSilence);
    after = static_cast<std::size_t>(lseek(STDERR_FILENO, 0, SEEK_CUR));
    progress.report({"new", 1, 4});
  });
  EXPECT_EQ(count_of("old [", text), 1U);
  EXPECT_TRUE(std::string_view(text).substr(0, before).ends_with(kWipe));
  EXPECT_EQ(after, before) << "until the next report";
  EXPECT_EQ(count_of("held", text), 0U);
  EXPECT_EQ(count_of("new [", text), 1U);
}

TEST(Progress, LinesOfJsonAreNeverHeldBack) {
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::json, true);
    progress.hold();
    std::this_thread::sleep_for(kTooLongSilence);
    progress.report({"reduce", 2, 3});
  });
  EXPECT_EQ(count_of("{\"stage\": \"start\"", text), 1U) << text;
  EXPECT_EQ(count_of("{\"stage\": \"reduce\", \"done\": 2, \"total\": 3", text), 1U) << text;
  EXPECT_EQ(count_of("\x1b", text), 0U);
}

TEST(Progress, MessagesNeverShareALineWithABar) {
  constexpr auto long_enough = std::chrono::milliseconds(300);
  std::size_t written = 0;
  const std::string text = stderr_of([&] {
    ProgressReporter progress(ProgressMode::bar, true);
    std::this_thread::sleep_for(kBarIsThere);
    std::jthread other([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) progress.report({"stage", 1, 2});
    });
    const auto end = std::chrono::steady_clock::now() + long_enough;
    for (; std::chrono::steady_clock::now() < end; written += 2) {
      print_line("message");
      print_without_memory("prefix", "message");
    }
  });
  std::size_t messages = 0, bars = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (lines.eof()) break;  // a bar that the end wiped
    ++messages;
    const std::size_t wiped = line.rfind(kWipe);
    bars += wiped != line.npos;
    const std::string message = wiped == line.npos ? line : line.substr(wiped + kWipe.size());
    ASSERT_TRUE(message == "message" || message == "prefix: message") << message;
  }
  EXPECT_EQ(messages, written);
  EXPECT_GT(bars, 0U) << "the two never met";
}

// ---- the bound of the heap

std::uint64_t data_limit() {
  rlimit data{};
  getrlimit(RLIMIT_DATA, &data);
  return data.rlim_cur;
}

class HeapBounds : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers map far more than the program asks for";
#endif
    getrlimit(RLIMIT_DATA, &at_start_);
  }
  void TearDown() override { setrlimit(RLIMIT_DATA, &at_start_); }
  void set_limit(std::uint64_t bytes) {
    rlimit data = at_start_;
    data.rlim_cur = bytes;
    setrlimit(RLIMIT_DATA, &data);
  }
  static constexpr std::uint64_t kMiB = 1 << 20;
  rlimit at_start_{};
};

TEST_F(HeapBounds, AreLoosenedOnce) {
  {
    HeapBound heap;
    heap.loosen();
    EXPECT_EQ(data_limit(), at_start_.rlim_cur) << "there is no bound yet";
    heap.bound(512 * kMiB);
    const std::uint64_t bound = data_limit();
    ASSERT_LT(bound, at_start_.rlim_cur);
    EXPECT_GE(bound, 512 * kMiB);
    heap.loosen();
    const std::uint64_t loosened = data_limit();
    EXPECT_GT(loosened, bound);
    EXPECT_LE(loosened, bound + 8 * kMiB);
    for (int failure = 0; failure < 100; ++failure) heap.loosen();
    EXPECT_EQ(data_limit(), loosened);
  }
  EXPECT_EQ(data_limit(), at_start_.rlim_cur);
}

TEST_F(HeapBounds, LeaveALimitOfTheUserAlone) {
  const std::uint64_t of_the_user = 4096 * kMiB;
  if (at_start_.rlim_cur < of_the_user) GTEST_SKIP() << "the limit here is lower";
  set_limit(of_the_user);
  HeapBound heap;
  heap.bound(std::size_t{1} << 40);
  heap.loosen();
  EXPECT_EQ(data_limit(), of_the_user) << "no bound below it was set";
}

TEST_F(HeapBounds, AreNotLoosenedBeyondALimitOfTheUser) {
  std::uint64_t bound = 0;
  {
    HeapBound heap;
    heap.bound(512 * kMiB);
    bound = data_limit();
  }
  if (at_start_.rlim_cur < bound + kMiB) GTEST_SKIP() << "the limit here is lower";
  set_limit(bound + kMiB);
  HeapBound heap;
  heap.bound(512 * kMiB);
  ASSERT_LT(data_limit(), bound + kMiB);
  heap.loosen();
  EXPECT_EQ(data_limit(), bound + kMiB);
}

}  // namespace
}  // namespace ph::app
