// SPDX-License-Identifier: MIT
// Tests the parsing of command lines: numbers, choices, files.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "apps/common/arguments/foreign_options.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/option_text.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/format_size.hpp"
#include "tests/apps/common/kind_of.hpp"

namespace ph::app {
namespace {

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
  EXPECT_EQ(format_size(999), "999 B");
  EXPECT_EQ(format_size(1000), "1000 B");
  EXPECT_EQ(format_size(1023.9 * 1024), "1024 KiB");
  EXPECT_EQ(format_size(1010.0 * 1024 * 1024), "1010 MiB");
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

TEST(Choices, DoNotSuggestTheOpposite) {
  constexpr std::array<std::string_view, 3> kNames{"--min-persistence", "--max-range",
                                                   "lower-distance"};
  EXPECT_EQ(nearest_name("--max-persistence", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("--min-range", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("upper-distance", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("--min-persistance", kNames), "--min-persistence");
}

TEST(ForeignOptions, StandForOptionsThatTheProgramHas) {
  constexpr std::array<std::string_view, 3> kNames{"--voxel", "--size", "--superlevel"};
  EXPECT_EQ(hint_for_foreign_option("--voxel-size", kNames), "did you mean '--voxel'?");
  EXPECT_EQ(hint_for_foreign_option("--sublevel", kNames),
            "sublevel sets are the default, --superlevel takes superlevel sets");
  EXPECT_EQ(hint_for_foreign_option("--thresh", kNames), "");
  EXPECT_EQ(hint_for_foreign_option("--", kNames), "");
}

TEST(Placeholders, SayWhatAValueMayBe) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(values_of("auto|kinect-v1|2").words, (Words{"auto", "kinect-v1", "2"}));
  EXPECT_EQ(values_of("cosine|minkowski:P").words, (Words{"cosine", "minkowski:"}));
  EXPECT_EQ(values_of("N|exact").words, Words{"exact"});
  EXPECT_FALSE(values_of("on|off").is_file);
  for (const char* text : {"FILE", "FILE FILE", "FILE|xtion"}) {
    EXPECT_TRUE(values_of(text).is_file) << text;
    EXPECT_TRUE(values_of(text).extensions.empty()) << text;
  }
  EXPECT_EQ(values_of("FILE.svg|.png").extensions, (Words{".svg", ".png"}));
  EXPECT_TRUE(values_of("FILE.svg|.png").words.empty());
  for (const char* text : {"", "N", "LO,HI", "WxH", "D,…", "[TOPIC]", "X,Y,Z", "-"}) {
    const Values values = values_of(text);
    EXPECT_TRUE(values.words.empty() && values.extensions.empty() && !values.is_file) << text;
  }
}

TEST(Descriptions, AreCutBehindWhatMatters) {
  const auto brief = [](const std::string& text) {
    OptionText option;
    option.description = text;
    return option.brief();
  };
  EXPECT_EQ(brief("format of the input (default auto: by content)"), "format of the input");
  EXPECT_EQ(brief("one page; needs no network"), "one page");
  EXPECT_EQ(brief("least persistence. surface: 0.01"), "least persistence");
  EXPECT_EQ(brief("a label a point (csv: one a line; png: 16 bits)"),
            "a label a point (csv: one a line; png: 16 bits)");
  EXPECT_EQ(brief("an error (default), or a hole"), "an error (default), or a hole");
}

TEST(Lines, AreBrokenAtBlanksAndBars) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrapped("a bc  def", 4), (Lines{"a bc", "def"}));
  EXPECT_EQ(wrapped("… … …", 3), (Lines{"… …", "…"}));
  EXPECT_EQ(wrapped("longer than that", 3), (Lines{"longer", "than", "that"}));
  EXPECT_EQ(wrapped("", 3), Lines{});
  EXPECT_EQ(wrapped_list("--o ab|cd|ef", 7), (Lines{"--o ab|", "cd|ef"}));
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
}

// Creates a separate folder that contains one file, "input".
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
  // The outputs are in a folder that the batch will create.
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("new/b")}}), none);
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("new/deep/a")}}), none);
  EXPECT_EQ(kind({{"--output", at("new/a")}, {"--report", at("folder/../new/./a")}}),
            ErrorKind::usage);
  EXPECT_EQ(kind({{"--output", "-"}, {"--report", "-"}}), ErrorKind::usage);
  EXPECT_EQ(kind({{"--output", "/dev/null"}, {"--report", "/dev/null"}}), none);
}

}  // namespace
}  // namespace ph::app
