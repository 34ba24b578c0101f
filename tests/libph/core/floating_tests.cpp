// SPDX-License-Identifier: MIT
// Tests the functions that use strtod in place of std::from_chars. If the C++ library has
// from_chars, the results are compared with it.
#include "ph/detail/core/floating.hpp"

#include <gtest/gtest.h>

#include <climits>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

struct Known {
  std::string_view text;
  std::size_t used;
  double value;
  std::errc error = {};
};

constexpr double kUntouched = 7;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Floating, KnownTexts) {
  const auto nothing = std::errc::invalid_argument, out = std::errc::result_out_of_range;
  for (const Known& known : std::initializer_list<Known>{
           {"", 0, kUntouched, nothing},
           {"-", 0, kUntouched, nothing},
           {"+1", 0, kUntouched, nothing},
           {" 1", 0, kUntouched, nothing},
           {".", 0, kUntouched, nothing},
           {"-.", 0, kUntouched, nothing},
           {"e5", 0, kUntouched, nothing},
           {"1", 1, 1},
           {"-0.5", 4, -0.5},
           {".5", 2, 0.5},
           {"1.", 2, 1},
           {"1.e2", 4, 100},
           {"1e", 1, 1},
           {"1.5e-", 3, 1.5},
           {"1..2", 2, 1},
           {"1,5", 1, 1},
           {"0x1p3", 1, 0},
           {"inf", 3, kInf},
           {"-INF", 4, -kInf},
           {"infinity", 8, kInf},
           {"infinit", 3, kInf},
           {"in", 0, kUntouched, nothing},
           {"NaN", 3, kNan},
           {"nan(a_1)", 8, kNan},
           {"nan(a", 3, kNan},
           {"1e400", 5, kUntouched, out},
           {"-1e-400", 7, kUntouched, out},
           {"5e-324", 6, 5e-324},
           {"2e-324", 6, kUntouched, out},
           {"1e-310", 6, 1e-310},
           {"0e999999999999", 14, 0},
           {"0.000e-99999999999999999999", 27, 0},
           {"1e99999999999999999999", 22, kUntouched, out},
       }) {
    double value = kUntouched;
    const char* const first = known.text.data();
    const auto [stop, error] = floating_by_strtod(first, first + known.text.size(), value);
    EXPECT_EQ(stop, first + known.used) << known.text;
    EXPECT_EQ(error, known.error) << known.text;
    EXPECT_TRUE(std::isnan(known.value) ? std::isnan(value) : value == known.value) << known.text;
  }
}

TEST(Floating, LongNumbersAndWhatFollows) {
  const std::string digits = "0." + std::string(300, '3') + ";9";
  double value = 0;
  const auto [stop, error] =
      floating_by_strtod(digits.data(), digits.data() + digits.size(), value);
  EXPECT_EQ(error, std::errc{});
  EXPECT_EQ(std::string_view(stop), ";9");
  EXPECT_EQ(value, 1.0 / 3);
}

TEST(Floating, FloatsAreRoundedOnce) {
  // The text is slightly more than 1 plus half a unit in the last place of a float. If it is
  // rounded to a double first, it is exactly 1 plus this half unit.
  const std::string_view text = "1.00000005960464477539062500000000001";
  float value = 0;
  floating_by_strtod(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(value, std::nextafter(1.0F, 2.0F));
}

TEST(Floating, TheLocaleOfTheProgramDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no locale de_DE.UTF-8";
  const std::string_view text = "1.5";
  double value = 0;
  const auto [stop, error] = floating_by_strtod(text.data(), text.data() + text.size(), value);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(error, std::errc{});
  EXPECT_EQ(stop, text.data() + text.size());
  EXPECT_EQ(value, 1.5);
}

template <class T>
constexpr bool kHasFromChars = requires(T& value) {
  std::from_chars("", "", value);
};

/// Compares with from_chars: both functions stop at the same place, report the same error and read
/// the same bits.
template <class T>
void compare(const std::string& text) {
  if constexpr (kHasFromChars<T>) {
    T ours = 7, expected = 7;
    const char* const last = text.data() + text.size();
    const auto mine = floating_by_strtod(text.data(), last, ours);
    const auto theirs = std::from_chars(text.data(), last, expected);
    EXPECT_EQ(mine.ec, theirs.ec) << text;
    EXPECT_EQ(mine.ptr, theirs.ptr) << text;
    EXPECT_EQ(std::isnan(ours), std::isnan(expected)) << text;
    EXPECT_TRUE(std::isnan(ours) || std::memcmp(&ours, &expected, sizeof ours) == 0) << text;
  }
}

TEST(Floating, RandomTextsAsFromCharsReadsThem) {
  if (!kHasFromChars<double>) GTEST_SKIP() << "this C++ library has no std::from_chars of a double";
  for_each_seed(20000, [](Generator& random, bool, std::int64_t) {
    // Concatenates random pieces of numbers. Most of the results begin with a number.
    constexpr std::string_view pieces[] = {
        "-",   "+",        ".", "e", "E-", "e+3",  "0",   "1", "7",   "12",  "99999999", "inf",
        "nan", "infinity", " ", ",", "x",  "e-32", "e30", "(", "ab)", "000", "5e-324"};
    std::string text;
    for (int count = random.integer(0, 6); count > 0; --count)
      text += pieces[random.integer(0, int{std::size(pieces)} - 1)];
    compare<double>(text);
    compare<float>(text);
    // Any double, printed with as many digits as needed or with fewer.
    std::uint64_t bits = 0;
    for (int half = 0; half < 2; ++half)
      bits = bits << 32 | static_cast<unsigned>(random.integer(INT_MIN, INT_MAX));
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.*g", random.integer(1, 17), number);
    compare<double>(digits);
    compare<float>(digits);
  });
}

}  // namespace
}  // namespace ph::test
